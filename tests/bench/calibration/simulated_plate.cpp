#include "tests/bench/calibration/simulated_plate.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/geometry.hpp"
#include "services/calibration/files/view_detection.hpp"
#include "services/cell_simulator/base/random_stream.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;
namespace {

Eigen::Matrix3d turn(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(degrees * kDegree, axis).toRotationMatrix();
}

}  // namespace

calibration::Target plate_of(const cell_simulator::PrintedPlate& printed) {
  calibration::Target plate;
  plate.pattern = printed.staggered ? calibration::TargetPattern::asymmetric_circles
                                    : calibration::TargetPattern::circles;
  plate.columns = printed.columns;
  plate.rows = printed.rows;
  plate.pitch_mm = printed.pitch_mm;
  plate.radius_mm = printed.dot_radius_mm;
  return plate;
}

std::vector<RigidTransform> draw_poses(const cell_simulator::PlateImages& images,
                                       const cell_simulator::PrintedPlate& plate,
                                       const PoseRange& range, int count, std::uint64_t seed) {
  constexpr double kStandOff = 300, kAside = 8;  // mm
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const auto all = cell_simulator::dots(plate);
  for (const Eigen::Vector3d& dot : all) middle += dot / static_cast<double>(all.size());
  cell_simulator::RandomStream random(seed, 31);
  std::vector<RigidTransform> poses;
  while (static_cast<int>(poses.size()) < count) {
    const double azimuth = 360.0 / count * (static_cast<double>(poses.size()) + random.uniform());
    const double tilt = random.uniform(range.least_tilt_deg, range.most_tilt_deg);
    const double roll = random.uniform(-range.roll_deg, range.roll_deg);
    const double distance = kStandOff * random.uniform(range.nearest, range.farthest);
    const Eigen::Vector3d axis = turn(azimuth, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d::UnitX();
    RigidTransform pose = RigidTransform::Identity();
    pose.linear() = turn(tilt, axis) * turn(roll, Eigen::Vector3d::UnitZ());
    pose.translation() = Eigen::Vector3d(random.uniform(-kAside, kAside),
                                         random.uniform(-kAside, kAside), distance) -
                         pose.linear() * middle;
    if (images.shows_all(pose)) poses.push_back(pose);
  }
  return poses;
}

RigidTransform true_T_base_plate() {
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = turn(180, Eigen::Vector3d::UnitX()) * turn(17, Eigen::Vector3d::UnitZ());
  pose.translation() = Eigen::Vector3d(905, 60, 12);
  return pose;
}

RigidTransform said_pose(const RigidTransform& T_base_tool, double error_mm, double error_deg,
                         std::uint64_t seed, int pose) {
  cell_simulator::RandomStream random(seed, 1000 + static_cast<std::uint64_t>(pose));
  Eigen::Vector3d shift, twist;
  for (double& value : shift) value = error_mm * random.normal();
  for (double& value : twist) value = error_deg * kDegree * random.normal();
  RigidTransform said = T_base_tool;
  said.translation() += shift;
  if (twist.norm() > 0)
    said.linear() =
        Eigen::AngleAxisd(twist.norm(), twist.normalized()).toRotationMatrix() * said.linear();
  return said;
}

RigidTransform tool_pose(const cell_simulator::TrueSensor& sensor,
                         const RigidTransform& T_camera_plate) {
  return true_T_base_plate() * T_camera_plate.inverse() * sensor.T_tool_camera.inverse();
}

std::vector<calibration::View> rendered_views(cell_simulator::PlateImages& images,
                                              const cell_simulator::PrintedPlate& plate,
                                              const std::vector<RigidTransform>& T_camera_plate,
                                              std::uint64_t seed) {
  const cell_simulator::TrueSensor& sensor = images.sensor();
  std::vector<calibration::View> views;
  for (std::size_t i = 0; i < T_camera_plate.size(); ++i) {
    std::vector<std::uint8_t> grid = images.grid(T_camera_plate[i], seed * 100 + i),
                              laser = images.laser(T_camera_plate[i], seed * 100 + i);
    calibration::CalibrationPose pose;
    pose.index = static_cast<int>(i) + 1;
    pose.T_base_tool = tool_pose(sensor, T_camera_plate[i]);
    views.push_back(calibration::detect_view(
        pose, plate_of(plate), cv::Mat(sensor.height, sensor.width, CV_8U, grid.data()),
        cv::Mat(sensor.height, sensor.width, CV_8U, laser.data())));
  }
  return views;
}

void write_folder(const std::string& folder, cell_simulator::PlateImages& images,
                  const cell_simulator::PrintedPlate& plate,
                  const std::vector<RigidTransform>& T_camera_plate, double error_mm,
                  double error_deg, std::uint64_t seed) {
  const std::filesystem::path root(folder);
  const cell_simulator::TrueSensor& sensor = images.sensor();
  for (const char* name : {"grid", "laser"}) std::filesystem::create_directories(root / name);
  std::ofstream(root / "plate.yaml")
      << fmt::format("pattern: {}\ncolumns: {}\nrows: {}\npitch_mm: {}\nradius_mm: {}\n",
                     plate.staggered ? "asymmetric_circles" : "circles", plate.columns, plate.rows,
                     plate.pitch_mm, plate.dot_radius_mm);
  std::ofstream poses(root / "poses.csv");
  poses << "index,x,y,z,qw,qx,qy,qz\n";
  for (std::size_t i = 0; i < T_camera_plate.size(); ++i) {
    const int index = static_cast<int>(i) + 1;
    double p[3], q[4];
    transform_to_arrays(
        said_pose(tool_pose(sensor, T_camera_plate[i]), error_mm, error_deg, seed, index), p, q);
    poses << fmt::format("{},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f}\n", index, p[0], p[1],
                         p[2], q[0], q[1], q[2], q[3]);
    const auto write = [&](const char* name, std::vector<std::uint8_t> grey) {
      cv::imwrite((root / name / fmt::format("{:04}.png", index)).string(),
                  cv::Mat(sensor.height, sensor.width, CV_8U, grey.data()));
    };
    write("grid", images.grid(T_camera_plate[i], seed * 100 + i));
    write("laser", images.laser(T_camera_plate[i], seed * 100 + i));
  }
}

std::vector<ProbePoint> probe_points(const cell_simulator::TrueSensor& sensor) {
  std::vector<ProbePoint> points;
  for (const double z : {270.0, 285.0, 300.0, 315.0, 330.0})
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double x = (share * sensor.width - sensor.cx) / sensor.fx * z;
      const Eigen::Vector3d& n = sensor.laser_normal;
      const double y = -(sensor.laser_offset + n.x() * x + n.z() * z) / n.y();
      const Eigen::Vector3d point(x, y, z);
      points.push_back(
          {cell_simulator::see(sensor, point).value(), point, sensor.T_tool_camera * point});
    }
  return points;
}

double end_to_end(const SensorModel& model, const RigidTransform& T_tool_camera,
                  const std::vector<ProbePoint>& probes) {
  double sum = 0;
  for (const ProbePoint& probe : probes) {
    const auto point = camera_point(model, probe.pixel.x(), probe.pixel.y());
    if (!point) return 1e9;
    sum += (T_tool_camera * *point - probe.tool).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(probes.size()));
}

}  // namespace arcstart::test
