// The adjustment as Ceres sees it: parameters, residuals, one solution, and what the residuals'
// redundancy tells.
#pragma once

#include <ceres/problem.h>

#include <array>
#include <vector>

#include "services/calibration/adjustment/adjustment_model.hpp"
#include "services/calibration/target/target.hpp"
#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

// Sum of squares of a group of residuals (in their standard deviations), and how many of them are
// redundant: sum / redundancy is 1 where the standard deviation was right.
struct Group {
  double squares = 0, redundancy = 0;
  double factor() const;  // on the standard deviation
};

struct Redundancy {
  Group pixel, laser, robot_translation, robot_rotation;
  std::vector<double> view_translation, view_rotation;  // redundancy of each view
  SetCovariance covariance;
};

class AdjustmentProblem {
 public:
  // All that is given must outlive the problem.
  AdjustmentProblem(const Target& plate, const std::vector<View>& views,
                    const AdjustmentState& start, const Deviations& deviations, bool camera_free);

  bool solve();
  AdjustmentState state() const;
  Redundancy redundancy();  // with the camera free

 private:
  void add_view(const Target& plate, const View& view, std::size_t number);
  void hold_camera(bool hold);

  const std::vector<View>& views_;
  const AdjustmentState& start_;
  Deviations deviations_;
  bool camera_free_;
  std::array<double, 4> camera_;
  std::array<double, 5> distortion_;
  std::array<double, 3> plane_;
  std::array<double, 6> hand_eye_, plate_;
  std::vector<std::array<double, 6>> poses_;
  std::vector<ceres::ResidualBlockId> target_, laser_, robot_;
  ceres::Problem problem_;
};

}  // namespace arcstart::calibration
