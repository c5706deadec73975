// The answer: a seam with all that is known of it, or why there is none.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/reason.hpp"
#include "services/seam_finding/model/seam_end.hpp"

namespace arcstart::seam_finding {

struct SeamMeasurement {
  double along = 0;          // on the seam's line; mm
  int stripe = -1;           // index, -1 in a cloud without stripes
  Eigen::Vector3d position;  // of the seam there, in base; mm
  double residual = -1;      // from the line; mm, -1 where a plate was not seen beside the seam
  bool tack = false;         // metal stands before both plates there
  double gap = -1, gap_deviation = -1;  // between the plates; mm, -1 where not measured
};

// A plate as the answer claims it, beside the seam.
struct SeamPlate {
  Plane plane;                                     // normal out of the metal
  Eigen::Vector3d away = Eigen::Vector3d::Zero();  // in the plate, away from the seam; unit
  double inset = 0;  // from the seam to where the plate begins: half a gap or groove; mm
};

// Where else an end may be.
struct SecondPlace {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // in base; mm
  double weight = 0;                                // probability, 0: there is none
};

// The seam as it was held against the stripes.
struct SeamCheck {
  int stripes = -1;       // near it; -1: not done
  double explained = -1;  // share of what is seen where the plates are claimed that is on them
  double worst = -1;      // mm along the seam between an end and where the stripes bound it
};

struct Polyline {
  std::vector<Eigen::Vector3d> points;
  double deviation = -1;  // largest residual from it, averaged likewise; mm, -1 where not measured
};

struct SeamAccuracy {
  Eigen::Matrix3d start, end;  // covariances in base, random part; mm2
  double direction = -1;       // standard deviations; rad
  std::array<double, 2> normals = {-1, -1};
  double angle = -1;
};

// The tool's z runs along the wire into the joint, its x ahead along the seam as far as z lets it.
struct TorchPose {
  Eigen::Vector3d position;  // of the wire's tip, in base: the start; mm
  Eigen::Quaterniond orientation;
  Eigen::Vector3d
      approach;  // of the wire's tip before it comes to the start, clear of both plates; mm
};

struct SeamResult {
  enum class Verdict { kFound, kAmbiguous, kRefused };
  Verdict verdict = Verdict::kRefused;
  Reason reason;                // why, where not found
  std::vector<Reason> remarks;  // what a person should know of a found one

  // Where found. In base, mm and rad.
  std::string joint_type;
  Eigen::Vector3d start = Eigen::Vector3d::Zero(), end = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit, start to end
  std::array<Eigen::Vector3d, 2> normals = {Eigen::Vector3d::Zero(),
                                            Eigen::Vector3d::Zero()};  // out of the metal
  std::array<SeamPlate, 2> faces;  // the plates' tops; normals says the same of their planes
  double angle = 0;  // between the plates' open sides; of a groove, between its slants
  double gap = -1, gap_deviation = -1;  // mean along the seam; of a groove, its width at the top
  double thickness = -1;                // of a lap's upper plate; mm
  double groove_angle = -1;             // included angle of a V-groove; rad
  double mismatch = -1;  // of a butt joint's or a groove's tops in height, mid-seam; mm
  EndVisibility start_visibility = EndVisibility::kNotDetermined;
  EndVisibility end_visibility = EndVisibility::kNotDetermined;
  SecondPlace start_second, end_second;
  std::optional<SeamAccuracy> accuracy;  // nothing where it was not determined
  Polyline polyline;
  std::vector<SeamMeasurement> stations;  // along counts from the start
  std::optional<TorchPose> torch;
  // Out of the metal, of the two faces between which the torch stands.
  std::array<Eigen::Vector3d, 2> torch_faces = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<std::vector<int>, 2> plates;  // indices of the plates' points

  // Other seams, and where ambiguous all of them, best first.
  struct Alternative {
    std::string joint_type;
    double score = 0;
    Eigen::Vector3d start, end;
    Reason reason;  // why it is not the answer
  };
  std::vector<Alternative> alternatives;

  SeamCheck checked;
  std::vector<int> background;  // indices of the points taken for background
};

}  // namespace arcstart::seam_finding
