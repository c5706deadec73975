// What is part of the empty cell: the rule that says whether a point belongs to the background.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace arcstart::seam_finding {

// What the background's own scan says of a point.
enum class Belonging : char {
  kBackground,
  kUnknown,  // the background's surface is not known there
  kOff       // it is known there, and the point is not on it
};

class Background {
 public:
  virtual ~Background() = default;
  virtual bool contains(const Eigen::Vector3d& point) const = 0;

  // Appends one for each of the points. Fast where neighbouring points follow each other.
  virtual void classify(std::span<const Eigen::Vector3d> points,
                        std::vector<Belonging>& belonging) const {
    for (const Eigen::Vector3d& point : points)
      belonging.push_back(contains(point) ? Belonging::kBackground : Belonging::kUnknown);
  }
};

// Takes nothing for background.
class NoBackground : public Background {
 public:
  bool contains(const Eigen::Vector3d&) const override { return false; }
};

}  // namespace arcstart::seam_finding
