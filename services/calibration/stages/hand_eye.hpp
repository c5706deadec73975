// Hand-eye in closed form, the spread between methods, and the views that cannot belong.
#pragma once

#include <string>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::calibration {

struct HandEyeMethod {
  std::string name;  // Tsai, Park, Horaud, Daniilidis
  RigidTransform T_tool_camera;
  RigidTransform T_base_plate;  // mean over the views
  double consistency_mm = 0;    // RMS distance of the plate's points, carried to base by each
                                // view, from their mean; infinite where the method failed
};

// Tsai and Lenz (1989), Park and Martin (1994), Horaud and Dornaika (1995), Daniilidis (1999), as
// OpenCV has them. One entry a method. points: in plate; mm.
std::vector<HandEyeMethod> closed_form_hand_eye(const std::vector<RigidTransform>& T_base_tool,
                                                const std::vector<RigidTransform>& T_camera_plate,
                                                const std::vector<Eigen::Vector3d>& points);

// Park's where it works, else the most consistent.
const HandEyeMethod& best_method(const std::vector<HandEyeMethod>& methods);

// How far apart the methods place the camera, at most, of those that worked; mm. One that fits far
// worse than the best has failed by itself, as some do where views turn by nearly 180 deg.
double spread_of_methods(const std::vector<HandEyeMethod>& methods);

// The plate's pose in base as the mean of what each view says.
RigidTransform mean_plate(const std::vector<RigidTransform>& T_base_tool,
                          const RigidTransform& T_tool_camera,
                          const std::vector<RigidTransform>& T_camera_plate);

// Between each pair of views the robot and the camera must have turned by the same angle. The
// median over the others of how much they differ; rad, one a view.
std::vector<double> angle_disagreement(const std::vector<RigidTransform>& T_base_tool,
                                       const std::vector<RigidTransform>& T_camera_plate);

}  // namespace arcstart::calibration
