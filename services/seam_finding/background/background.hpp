// What is part of the empty cell: the rule that says whether a point belongs to the background.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace arcstart::seam_finding {

class Background {
 public:
  virtual ~Background() = default;
  virtual bool contains(const Eigen::Vector3d& point) const = 0;

  // Appends for each of the points whether it is contained. Fast where neighbouring points follow
  // each other.
  virtual void classify(std::span<const Eigen::Vector3d> points, std::vector<char>& inside) const {
    for (const Eigen::Vector3d& point : points) inside.push_back(contains(point));
  }
};

// Takes nothing for background.
class NoBackground : public Background {
 public:
  bool contains(const Eigen::Vector3d&) const override { return false; }
};

}  // namespace arcstart::seam_finding
