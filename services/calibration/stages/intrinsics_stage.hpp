// The camera alone: Zhang's calibration from a planar target, with circles' images taken for what
// they are.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/sensor_model.hpp"
#include "services/calibration/target/target.hpp"
#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

struct IntrinsicsStage {
  SensorModel model;  // camera and distortion, k3 = 0; the laser plane is not known here
  std::vector<RigidTransform> T_camera_plate;  // of each view
  std::vector<double> view_rms;                // reprojection; px
  double rms = 0;                              // of all; px
};

// Zhang (2000) as OpenCV has it; circles' centres are moved by the difference between the ellipse's
// centre and the centre's image, which depends on the result, three times over. `guess` begins it
// where given. Throws std::runtime_error where OpenCV finds no camera.
IntrinsicsStage calibrate_camera(const Target& plate, const std::vector<View>& views, int width,
                                 int height, const SensorModel* guess = nullptr);

// The plate's pose seen in one view, camera known.
RigidTransform locate_plate(const SensorModel& model, const Target& plate, const View& view);

// Distances between what is seen and what the model says; px.
std::vector<Eigen::Vector2d> reprojection(const SensorModel& model, const Target& plate,
                                          const RigidTransform& T_camera_plate, const View& view);

double root_mean_square(const std::vector<Eigen::Vector2d>& residuals);

}  // namespace arcstart::calibration
