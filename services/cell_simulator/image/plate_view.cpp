#include "services/cell_simulator/image/plate_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "services/cell_simulator/base/random_stream.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr double degree = EIGEN_PI / 180;
constexpr int attempts = 300;
constexpr double golden_angle_deg = 137.508;  // successive azimuths fall between those before

Eigen::Matrix3d turn(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(degrees * degree, axis).toRotationMatrix();
}

Eigen::Vector3d middle_of(const PrintedPlate& plate) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto all = dots(plate);
  for (const Eigen::Vector3d& dot : all) sum += dot;
  return sum / static_cast<double>(all.size());
}

}  // namespace

PlateView::PlateView(const SensorSettings& sensor, const SceneSettings& scene, std::uint64_t seed)
    : settings_(sensor), images_(sensor, plate_), seed_(seed) {
  RandomStream random(seed, 41);
  const auto within = [&](double range) { return random.uniform(-range, range); };
  RigidTransform T_camera_plate = RigidTransform::Identity();
  T_camera_plate.linear() = turn(within(5), Eigen::Vector3d::UnitX()) *
                            turn(within(5), Eigen::Vector3d::UnitY()) *
                            turn(within(20), Eigen::Vector3d::UnitZ());
  T_camera_plate.translation() =
      Eigen::Vector3d(within(10), within(10), sensor.stand_off_mm + within(10)) -
      T_camera_plate.linear() * middle_of(plate_);
  T_base_plate_ =
      taught_tool_pose(sensor, scene, 0) * images_.sensor().T_tool_camera * T_camera_plate;
}

std::optional<RigidTransform> PlateView::pose(
    int number, const std::function<bool(const RigidTransform& T_base_tool)>& reaches) const {
  RandomStream random(seed_, 1000 + static_cast<std::uint64_t>(number));
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const double azimuth = golden_angle_deg * number + random.uniform(-20, 20);
    const double tilt = random.uniform(20, 40), roll = random.uniform(-90, 90);
    const Eigen::Vector3d axis = turn(azimuth, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d::UnitX();
    RigidTransform T_camera_plate = RigidTransform::Identity();
    T_camera_plate.linear() = turn(tilt, axis) * turn(roll, Eigen::Vector3d::UnitZ());
    T_camera_plate.translation() =
        Eigen::Vector3d(random.uniform(-8, 8), random.uniform(-8, 8),
                        settings_.stand_off_mm * random.uniform(0.8, 1.2)) -
        T_camera_plate.linear() * middle_of(plate_);
    const RigidTransform T_base_tool =
        T_base_plate_ * T_camera_plate.inverse() * images_.sensor().T_tool_camera.inverse();
    if (images_.shows_all(T_camera_plate) && reaches(T_base_tool)) return T_base_tool;
  }
  return {};
}

void PlateView::render(const RigidTransform& T_base_tool, bool moving, const Exposure& exposure,
                       const ImageRegion& region, std::uint8_t* grey) {
  const auto same = [&](const Exposure& other) {
    return exposure.exposure_us == other.exposure_us && exposure.gain_db == other.gain_db &&
           exposure.laser_on == other.laser_on;
  };
  if (last_.empty() ||
      (!moving && (!last_pose_.isApprox(T_base_tool, 1e-12) || !same(last_exposure_)))) {
    const RigidTransform T_camera_plate =
        (T_base_tool * images_.sensor().T_tool_camera).inverse() * T_base_plate_;
    const double exposure_us = exposure.exposure_us * std::pow(10, exposure.gain_db / 20);
    const std::uint64_t noise = RandomStream(seed_, 2000 + ++taken_).next();
    last_ = exposure.laser_on ? images_.laser(T_camera_plate, noise, exposure_us)
                              : images_.grid(T_camera_plate, noise, {}, exposure_us);
    last_pose_ = T_base_tool;
    last_exposure_ = exposure;
  }
  const int width = images_.sensor().width;
  for (int row = 0; row < region.height; ++row) {
    const auto begin = last_.begin() +
                       (static_cast<std::ptrdiff_t>(region.offset_y) + row) * width +
                       region.offset_x;
    std::copy(begin, begin + region.width, grey + static_cast<std::ptrdiff_t>(row) * region.width);
  }
}

}  // namespace arcstart::cell_simulator
