// What to believe the robot where its errors are no chance.
#pragma once

#include <functional>

#include "services/calibration/adjustment/leave_one_out.hpp"

namespace arcstart::calibration {

struct ValidatedAdjustment {
  Adjustment adjustment;
  LeaveOneOut left_one_out;
  double share = 1;  // of the robot's estimated deviations with which the poses were held
};

// The estimated deviations are right where errors are drawn anew for each pose. A plate of another
// size or a bent mount errs alike in all poses; the estimate takes that for a bad robot, and with
// poses so loosely held nothing is learnt from them. So the robot is held by a third, a tenth, a
// thirtieth of the estimate too, and what tells poses best that it never saw is kept. Deviations
// and covariance stay those of the estimate: the errors are there. `figure` is what to compare.
ValidatedAdjustment held_by_validation(const Target& plate, const std::vector<View>& views,
                                       const ValidatedAdjustment& estimated, bool camera_free,
                                       const std::function<double(const LeaveOneOut&)>& figure);

}  // namespace arcstart::calibration
