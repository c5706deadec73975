// The honest figure: each view judged by a calibration that never saw it.
#pragma once

#include <functional>
#include <vector>

#include "services/calibration/adjustment/adjustment.hpp"

namespace arcstart::calibration {

struct LeaveOneOut {
  // Of the left-out views' stripe points, carried to base with the pose the robot said, from the
  // plate's plane as the other views place it; mm. Of its target points from theirs, likewise.
  double laser_rms_mm = 0, laser_median_mm = 0, laser_95_mm = 0, target_rms_mm = 0;
  std::vector<double> view_laser_rms_mm;  // of each view; 0 without a stripe
};

// Calibrates without the view of this number; its T_camera_plate need not hold it.
using CalibrateWithout = std::function<AdjustmentState(std::size_t left_out)>;

LeaveOneOut leave_one_out(const Target& plate, const std::vector<View>& views,
                          const CalibrateWithout& calibrate);

// The adjustment again without a view, from its solution, with its standard deviations.
AdjustmentState adjusted_without(const Target& plate, const std::vector<View>& views,
                                 const Adjustment& adjustment, bool camera_free,
                                 std::size_t left_out);

// The plain way without a view: camera, Park's hand-eye, plate's mean, laser plane, each apart.
AdjustmentState plain_without(const Target& plate, const std::vector<View>& views,
                              const SensorModel& guess, std::size_t left_out);

}  // namespace arcstart::calibration
