// A calibration from its begin to its end: what each stage found, and what is said of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "services/calibration/adjustment/adjustment.hpp"
#include "services/calibration/adjustment/error_prediction.hpp"
#include "services/calibration/adjustment/leave_one_out.hpp"
#include "services/calibration/adjustment/target_flatness.hpp"
#include "services/calibration/stages/hand_eye.hpp"
#include "services/calibration/stages/intrinsics_stage.hpp"
#include "services/calibration/stages/laser_plane_stage.hpp"
#include "services/calibration/stages/pose_diversity.hpp"
#include "services/calibration/stages/scale_consistency.hpp"

namespace arcstart::calibration {

struct LeftOutView {
  int index = 0;    // of the pose
  std::string why;  // for people
};

struct CalibrationRun {
  std::string refused;  // why there is no result, and what is missing; empty where there is one
  std::vector<std::string> warnings, advice;
  std::vector<LeftOutView> left_out;
  std::vector<View> views;  // that the result rests on, stripes reduced to their straight line

  IntrinsicsStage camera;
  PoseDiversity spread;
  bool camera_held = false;
  bool has_laser = false;
  LaserPlaneFit laser_apart;           // fitted for itself, before the adjustment
  int crossings = 0;                   // of stripe and grid lines
  double crossing_rms_mm = 0;          // between where they put the stripe and where rays do
  std::vector<HandEyeMethod> methods;  // closed forms, on the same views
  ScaleConsistency scale;              // of the plate against the robot
  Adjustment adjustment;
  double hand_eye_residual_mm = 0;  // RMS of the plate's points, as the robot's word carries
                                    // them to base, from where the set puts them
  LeaveOneOut left_one_out, plain_left_one_out;  // of the adjustment; of the plain way with Park
  TargetFlatness flatness;
  std::vector<PredictedError> field;
};

struct CalibrateOptions {
  bool leave_one_out = true;
  // Told what is being done, for a person who waits.
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

}  // namespace arcstart::calibration
