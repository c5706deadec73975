// An answer held against the truth of a scene of the wild.
#pragma once

#include <arcstart/seam_t.hpp>
#include <string>
#include <vector>

#include "services/cell_simulator/wild/wild_truth.hpp"

namespace arcstart {

// One place of an answer and how far it is off; mm.
struct PlaceError {
  double along = 0;       // the true direction, signed; less what the truth leaves open
  double across = 0;      // in the first plate's plane, signed
  double height = 0;      // out of the first plate, signed; 0 where the plates are bent
  double deviation = -1;  // told, along the seam; -1: none
  double ratio = 0;  // error over deviation, the largest of along, across and height; 0 without any
  bool silent = false;

  double distance() const;
};

// What is off by more than three deviations that are told for it, and by more than matters: 1 mm
// along the seam, 0.5 mm across it, 1 degree of the direction, 2 degrees of a normal; or a joint
// that is none.
struct SilentError {
  enum class Where { kStart, kEnd, kElse };
  Where where = Where::kElse;
  std::string text;  // what and how far
};

struct WildJudgement {
  bool found = false;
  bool right = false;      // it is one of the truth's seams
  int seam = -1;           // which
  PlaceError start, end;   // of a right one
  double direction = 0;    // deg, likewise
  double worst_ratio = 0;  // error over deviation, of what is off by more than a third of the above
  std::vector<SilentError> silent;
  // All of these are within what the robot's positions are wrong, which no stripe shows.
  bool by_robot = false;

  bool silently(SilentError::Where where) const;
};

// Of plates that are bent the seam is judged across it alone, and along it at its ends.
// robot_mm: by so much an axis of what the robot says of its place is wrong, at most.
WildJudgement judge(const seam_t& seam, const cell_simulator::WildTruth& truth,
                    double robot_mm = 0);

// "SEEN"
const char* name_of_visibility(std::int8_t visibility);

}  // namespace arcstart
