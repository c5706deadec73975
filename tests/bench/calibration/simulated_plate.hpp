// Calibration views as the simulated sensor would take them of a plate, with a robot that errs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/sensor_model.hpp"
#include "services/calibration/target/target.hpp"
#include "services/calibration/target/view.hpp"
#include "services/cell_simulator/image/plate_images.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;

// How the poses are spread: tilt from square, roll about the optical axis, distance as a share of
// the stand-off. Tilts go round in equal steps.
struct PoseRange {
  double least_tilt_deg = 20, most_tilt_deg = 40, roll_deg = 90;
  double nearest = 0.8, farthest = 1.2;
};

calibration::Target plate_of(const cell_simulator::PrintedPlate& printed);

// T_camera_plate of poses that show all dots and a stripe, drawn anew until they do.
std::vector<RigidTransform> draw_poses(const cell_simulator::PlateImages& images,
                                       const cell_simulator::PrintedPlate& plate,
                                       const PoseRange& range, int count, std::uint64_t seed);

// Where the plate lies in base.
RigidTransform true_T_base_plate();

// The true tool pose of a view.
RigidTransform tool_pose(const cell_simulator::TrueSensor& sensor,
                         const RigidTransform& T_camera_plate);

// What the robot says: the truth with a normal error per axis, translation in base, rotation about
// the tool centre point.
RigidTransform said_pose(const RigidTransform& T_base_tool, double error_mm, double error_deg,
                         std::uint64_t seed, int pose);

// Rendered, detected and with the true tool pose.
std::vector<calibration::View> rendered_views(cell_simulator::PlateImages& images,
                                              const cell_simulator::PrintedPlate& plate,
                                              const std::vector<RigidTransform>& T_camera_plate,
                                              std::uint64_t seed);

// The same as files: plate.yaml, poses.csv with what the robot says, grid/ and laser/.
void write_folder(const std::string& folder, cell_simulator::PlateImages& images,
                  const cell_simulator::PrintedPlate& plate,
                  const std::vector<RigidTransform>& T_camera_plate, double error_mm,
                  double error_deg, std::uint64_t seed);

// 25 points of the laser plane at 270 to 330 mm: where they are seen, and where they are in tool.
struct ProbePoint {
  Eigen::Vector2d pixel;
  Eigen::Vector3d camera, tool;
};
std::vector<ProbePoint> probe_points(const cell_simulator::TrueSensor& sensor);

// RMS over the probe points, pixel to tool, of a set; mm.
double end_to_end(const SensorModel& model, const RigidTransform& T_tool_camera,
                  const std::vector<ProbePoint>& probes);

}  // namespace arcstart::test
