#include "services/calibration/adjustment/robot_prior.hpp"

namespace arcstart::calibration {

ValidatedAdjustment held_by_validation(const Target& plate, const std::vector<View>& views,
                                       const ValidatedAdjustment& estimated, bool camera_free,
                                       const std::function<double(const LeaveOneOut&)>& figure) {
  ValidatedAdjustment best = estimated;
  for (const double share : {1.0 / 3, 1.0 / 10, 1.0 / 30}) {
    Deviations held = estimated.adjustment.deviations;
    held.robot_mm *= share;
    held.robot_rad *= share;
    Adjustment tried = adjust(plate, views, estimated.adjustment.state, held, {camera_free, false});
    const LeaveOneOut left_one_out = leave_one_out(plate, views, [&](std::size_t view) {
      return adjusted_without(plate, views, tried, camera_free, view);
    });
    if (figure(left_one_out) >= figure(best.left_one_out)) continue;
    tried.deviations = estimated.adjustment.deviations;
    tried.covariance = estimated.adjustment.covariance;
    tried.converged = estimated.adjustment.converged;
    best = {tried, left_one_out, share};
  }
  return best;
}

}  // namespace arcstart::calibration
