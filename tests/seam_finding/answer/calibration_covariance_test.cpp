#include "services/seam_finding/answer/calibration_covariance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "services/seam_finding/find_seam.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

constexpr double kSpeed = 50;  // mm/s

// The sensor of the simulated profiles: leaning 38 deg, its laser 22 deg ahead; the tool frame is
// level and moves along x.
Calibration sensor_of(const ScanCloud& cloud, const ScanStripe& stripe) {
  Calibration calibration;
  calibration.sensor_model = {1600, 1200, 2400, 2400, 799.5, 599.5, {-0.1, 0, 0, 0, 0}, {}};
  const Eigen::Vector3d eye = stripe.camera_centre - stripe.tool_position;
  const double lean = 38 * M_PI / 180;
  const Eigen::Vector3d axis(0, -std::sin(lean), -std::cos(lean));
  const Eigen::Vector3d lateral = axis.cross(Eigen::Vector3d::UnitX()).normalized();
  Eigen::Matrix3d rotation;
  rotation << lateral, axis.cross(lateral), axis;
  calibration.T_tool_camera = RigidTransform::Identity();
  calibration.T_tool_camera.linear() = rotation;
  calibration.T_tool_camera.translation() = eye;
  // The laser's plane through three of the stripe's points, in camera.
  const auto in_camera = [&](int i) -> Eigen::Vector3d {
    return rotation.transpose() * (cloud.points[i] - stripe.camera_centre);
  };
  const Eigen::Vector3d a = in_camera(stripe.first), b = in_camera(stripe.first + stripe.count - 1),
                        along = rotation.transpose() *
                                (Eigen::AngleAxisd(22 * M_PI / 180, lateral) * axis);
  const Eigen::Vector3d normal = (b - a).cross(along).normalized();
  calibration.sensor_model.laser_plane = {normal, -normal.dot(a)};
  return calibration;
}

// Standard deviations of the size that a calibration run reaches, some of them correlated.
Eigen::MatrixXd covariance() {
  Eigen::VectorXd deviations(Calibration::kParameters);
  deviations << 0.6, 0.6, 0.8, 0.8, 5e-4, 1e-6, 1e-5, 1e-5, 1e-6, 2e-4, 2e-4, 0.05, 3e-4, 3e-4,
      3e-4, 0.05, 0.05, 0.05, 1e-3;
  Eigen::MatrixXd correlation =
      Eigen::MatrixXd::Identity(Calibration::kParameters, Calibration::kParameters);
  const auto correlate = [&](int i, int j, double value) {
    correlation(i, j) = correlation(j, i) = value;
  };
  correlate(0, 1, 0.8), correlate(2, 13, 0.5), correlate(11, 17, -0.6), correlate(9, 12, 0.4);
  return deviations.asDiagonal() * correlation * deviations.asDiagonal();
}

struct Perturbed {
  SensorModel model;
  RigidTransform T_tool_camera;
  double delay = 0;  // s
};
Perturbed perturbed(const Calibration& truth, const Eigen::VectorXd& change) {
  Perturbed set{truth.sensor_model, truth.T_tool_camera, change[18]};
  set.model.fx += change[0], set.model.fy += change[1];
  set.model.cx += change[2], set.model.cy += change[3];
  for (std::size_t i = 0; i < 5; ++i)
    set.model.distortion[i] += change[static_cast<Eigen::Index>(4 + i)];
  const Eigen::Vector3d n = truth.sensor_model.laser_plane.normal;
  const Eigen::Vector3d e1 = (Eigen::Vector3d::UnitX() - n.x() * n).normalized();
  set.model.laser_plane.normal = (n + change[9] * e1 + change[10] * n.cross(e1)).normalized();
  set.model.laser_plane.offset += change[11];
  const Eigen::Vector3d turn = change.segment<3>(12);
  set.T_tool_camera.linear() =
      Eigen::AngleAxisd(turn.norm(), turn.normalized()) * truth.T_tool_camera.linear();
  set.T_tool_camera.translation() += change.segment<3>(15);
  return set;
}

}  // namespace

TEST_CASE("the systematic deviation of a start is how calibrations that err scatter it") {
  Scene scene = make_scene({}, 3);
  scene.table = false;
  const ScanCloud cloud = make_scan(scene, {.noise = 0.02, .outliers = 0}, 3).cloud;
  const auto seen = std::find_if(cloud.stripes.begin(), cloud.stripes.end(),
                                 [](const ScanStripe& stripe) { return stripe.count > 20; });
  REQUIRE(seen != cloud.stripes.end());
  Calibration truth = sensor_of(cloud, *seen);
  std::vector<Eigen::Vector2d> pixels;
  for (int i = 0; i < cloud.size(); ++i) {
    const ScanStripe& stripe = cloud.stripes[cloud.origins[i].stripe];
    const Eigen::Vector3d in_camera =
        truth.T_tool_camera.inverse() * (cloud.points[i] - stripe.tool_position);
    REQUIRE(std::abs(truth.sensor_model.laser_plane.signed_distance(in_camera)) < 1e-6);
    pixels.push_back(project(truth.sensor_model, in_camera));
  }
  const auto start_with = [&](const Perturbed& set) {
    ScanCloud moved = cloud;
    const Eigen::Vector3d late = set.delay * kSpeed * Eigen::Vector3d::UnitX();
    for (int i = 0; i < cloud.size(); ++i) {
      const auto point = camera_point(set.model, pixels[i].x(), pixels[i].y());
      REQUIRE(point);
      moved.points[i] =
          set.T_tool_camera * *point + cloud.stripes[cloud.origins[i].stripe].tool_position + late;
    }
    for (ScanStripe& stripe : moved.stripes) {
      stripe.camera_centre = stripe.tool_position + set.T_tool_camera.translation() + late;
      stripe.tool_position += late;
    }
    const SeamResult result = find_seam(moved, NoBackground{}, SeamFindingSettings{}, 1);
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    return result.start;
  };
  const Eigen::Vector3d start = start_with({truth.sensor_model, truth.T_tool_camera, 0});
  REQUIRE((start - scene.start).norm() < 0.3);

  const Eigen::MatrixXd sigma = covariance();
  truth.covariance.assign(sigma.data(), sigma.data() + sigma.size());
  int nearest = 0;
  for (int i = 0; i < cloud.size(); ++i)
    if ((cloud.points[i] - start).norm() < (cloud.points[nearest] - start).norm()) nearest = i;
  SeenPoint point{pixels[nearest].x(), pixels[nearest].y(), RigidTransform::Identity(),
                  kSpeed * Eigen::Vector3d::UnitX()};
  point.T_base_tool.translation() = cloud.stripes[cloud.origins[nearest].stripe].tool_position;
  const auto predicted = calibration_covariance(truth, point);
  REQUIRE(predicted);

  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd root = sigma.llt().matrixL();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  constexpr int kDraws = 150;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd z(Calibration::kParameters);
    for (double& value : z) value = normal(engine);
    const Eigen::Vector3d off = start_with(perturbed(truth, root * z)) - start;
    scatter += off * off.transpose() / kDraws;
  }
  INFO("predicted\n" << *predicted << "\nscatter\n" << scatter);
  const Eigen::Vector3d t = (scene.end - scene.start).normalized();
  for (const Eigen::Vector3d& way : {t, scene.normals[0], scene.normals[1]})
    CHECK(std::sqrt(way.dot(scatter * way)) ==
          Approx(std::sqrt(way.dot(*predicted * way))).epsilon(0.2));
}

TEST_CASE("without the calibration's covariance nothing is said of systematic deviations") {
  CHECK_FALSE(calibration_covariance(Calibration{}, {}));
}
