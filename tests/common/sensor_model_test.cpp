#include "common/sensor_model.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

using namespace arcstart;

namespace {

SensorModel sensor() {
  SensorModel model;
  model.width = 1600;
  model.height = 1200;
  model.fx = 2400.5;
  model.fy = 2398.25;
  model.cx = 811.3;
  model.cy = 588.7;
  model.distortion = {-0.1, 0.03, 4e-4, -6e-4, -0.01};
  // The plane of a sheet of light 22 degrees from the optical axis that cuts it at 300 mm.
  model.laser_plane.normal = Eigen::Vector3d{0.1, 0.9, 0.4}.normalized();
  model.laser_plane.offset = -300 * model.laser_plane.normal.z();
  return model;
}

cv::Mat camera_matrix(const SensorModel& model) {
  return (cv::Mat_<double>(3, 3) << model.fx, 0, model.cx, 0, model.fy, model.cy, 0, 0, 1);
}

// OpenCV's own inversion by fixed-point iteration, run until it no longer moves.
cv::Point2d opencv_undistorted(const SensorModel& model, double u, double v) {
  std::vector<cv::Point2d> seen{{u, v}}, undistorted;
  const std::vector<double> distortion(model.distortion.begin(), model.distortion.end());
  cv::undistortPoints(
      seen, undistorted, camera_matrix(model), distortion, cv::noArray(), cv::noArray(),
      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 1000, 1e-15));
  return undistorted[0];
}

}  // namespace

TEST_CASE("undistortion agrees with OpenCV's over the whole image") {
  SensorModel model = sensor();
  for (const auto& distortion : {std::array<double, 5>{-0.1, 0.03, 4e-4, -6e-4, -0.01},
                                 {-0.25, 0.12, -2e-3, 1e-3, 0},
                                 {0.2, -0.1, 1e-3, 2e-3, 0.05},
                                 {0, 0, 0, 0, 0}}) {
    model.distortion = distortion;
    for (double u = 0; u <= 1599; u += 123)
      for (double v = 0; v <= 1199; v += 109.0) {
        const auto ray = undistorted_ray(model, u, v);
        REQUIRE(ray);
        const cv::Point2d expected = opencv_undistorted(model, u, v);
        CHECK(std::abs(ray->x() - expected.x) < 1e-12);
        CHECK(std::abs(ray->y() - expected.y) < 1e-12);
        CHECK(ray->z() == 1);
        const auto pixel = undistorted_pixel(model, u, v);
        REQUIRE(pixel);
        CHECK(pixel->x() == Approx(model.fx * expected.x + model.cx).epsilon(0).margin(1e-8));
        CHECK(pixel->y() == Approx(model.fy * expected.y + model.cy).epsilon(0).margin(1e-8));
      }
  }
}

TEST_CASE("projection agrees with OpenCV's and undoes undistortion") {
  const SensorModel model = sensor();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 200; ++i) {
    const double z = 300 + 50 * share(random);
    points.emplace_back(0.33 * z * share(random), 0.25 * z * share(random), z);
  }
  std::vector<cv::Point2d> pixels;
  const std::vector<double> distortion(model.distortion.begin(), model.distortion.end());
  cv::projectPoints(points, cv::Vec3d{}, cv::Vec3d{}, camera_matrix(model), distortion, pixels);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point{points[i].x, points[i].y, points[i].z};
    const Eigen::Vector2d pixel = project(model, point);
    CHECK(std::abs(pixel.x() - pixels[i].x) < 1e-9);
    CHECK(std::abs(pixel.y() - pixels[i].y) < 1e-9);
    const auto ray = undistorted_ray(model, pixel.x(), pixel.y());
    REQUIRE(ray);
    CHECK((*ray - point / point.z()).norm() < 1e-12);
  }
}

TEST_CASE("a point of the laser plane is found again from its pixel") {
  const SensorModel model = sensor();
  for (double x = -90; x <= 90; x += 15)
    for (double z = 250; z <= 350; z += 10) {
      const auto& n = model.laser_plane.normal;
      const Eigen::Vector3d point{x, -(n.x() * x + n.z() * z + model.laser_plane.offset) / n.y(),
                                  z};
      const Eigen::Vector2d pixel = project(model, point);
      const auto found = camera_point(model, pixel.x(), pixel.y());
      REQUIRE(found);
      CHECK((*found - point).norm() < 1e-8);
    }
}

TEST_CASE("Huynh's M on undistorted pixels is the ray cut with the plane") {
  const SensorModel model = sensor();
  const auto matrix = pixel_to_camera(model);
  int compared = 0;
  for (double u = 0; u <= 1599; u += 41)
    for (double v = 0; v <= 1199; v += 37) {
      const auto expected = camera_point(model, u, v);
      if (!expected) continue;
      const cv::Point2d ray = opencv_undistorted(model, u, v);
      const Eigen::Vector4d point =
          matrix * Eigen::Vector3d{model.fx * ray.x + model.cx, model.fy * ray.y + model.cy, 1};
      CHECK((point.hnormalized() - *expected).norm() < 1e-9 * expected->norm());
      if (expected->z() < 600) CHECK((point.hnormalized() - *expected).norm() < 1e-9);
      ++compared;
    }
  CHECK(compared > 1000);
  CHECK(matrix(3, 0) == Approx(model.laser_plane.normal.x() / model.fx).epsilon(1e-15));
}

TEST_CASE("a ray away from the laser plane has no point") {
  SensorModel model = sensor();
  model.distortion = {};
  model.laser_plane = {Eigen::Vector3d{0, 1, 0.1}.normalized(), -30};
  // The plane is met in front of the camera only where y + 0.1 > 0.
  CHECK(camera_point(model, model.cx, model.cy - 0.099 * model.fy));
  CHECK_FALSE(camera_point(model, model.cx, model.cy - 0.101 * model.fy));
  CHECK_FALSE(camera_point(model, std::nan(""), 3));
  CHECK_FALSE(camera_point(model, 3, std::numeric_limits<double>::infinity()));
}

TEST_CASE("where the distortion has no inverse there is no ray") {
  SensorModel model = sensor();
  model.distortion = {-0.1, 0, 0, 0, 0};
  // r (1 - 0.1 r^2) has its maximum 2/3 sqrt(10/3) = 1.217 at r = sqrt(10/3): nothing is seen
  // farther out.
  const double largest = 2.0 / 3 * std::sqrt(10.0 / 3);
  const auto ray = undistorted_ray(model, model.cx + 0.999 * largest * model.fx, model.cy);
  REQUIRE(ray);
  CHECK(ray->x() < std::sqrt(10.0 / 3));
  CHECK(ray->x() * (1 - 0.1 * ray->x() * ray->x()) == Approx(0.999 * largest).epsilon(1e-12));
  CHECK_FALSE(undistorted_ray(model, model.cx + 1.001 * largest * model.fx, model.cy));
}

TEST_CASE("a sensor that cannot be is told why") {
  CHECK(sensor_model_error(sensor()) == "");
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const auto error = [](auto change) {
    SensorModel model = sensor();
    change(model);
    return sensor_model_error(model);
  };
  CHECK(error([](auto& m) { m.width = 0; }).find("image size") != std::string::npos);
  CHECK(error([](auto& m) { m.height = -1200; }).find("image size") != std::string::npos);
  for (double SensorModel::*number :
       {&SensorModel::fx, &SensorModel::fy, &SensorModel::cx, &SensorModel::cy})
    for (const double bad : {nan, infinite})
      CHECK(error([&](auto& m) { m.*number = bad; }).find("not finite") != std::string::npos);
  for (int i = 0; i < 5; ++i)
    CHECK(error([&](auto& m) { m.distortion[i] = nan; }).find("not finite") != std::string::npos);
  CHECK(error([&](auto& m) { m.laser_plane.normal.x() = nan; }).find("not finite") !=
        std::string::npos);
  CHECK(error([&](auto& m) { m.laser_plane.offset = infinite; }).find("not finite") !=
        std::string::npos);
  CHECK(error([](auto& m) { m.fx = 0; }).find("focal length") != std::string::npos);
  CHECK(error([](auto& m) { m.fy = -2400; }).find("focal length") != std::string::npos);
  CHECK(error([](auto& m) { m.laser_plane.normal *= 1.001; }).find("length 1") !=
        std::string::npos);
  CHECK(error([](auto& m) { m.laser_plane.offset = 0.5; }).find("camera centre") !=
        std::string::npos);
  // r (1 + k1 r^2) has its maximum 2/3 / sqrt(-3 k1), the image's farthest corner is seen at r =
  // 0.4234.
  CHECK(error([](auto& m) { m.distortion = {-0.80, 0, 0, 0, 0}; }).empty());
  CHECK(error([](auto& m) {
          m.distortion = {-0.85, 0, 0, 0, 0};
        }).find("folds") != std::string::npos);
  // Folded in a ring inside the image (0.138 < r < 0.362), though its border could be undistorted
  // again.
  CHECK(error([](auto& m) {
          m.distortion = {-20, 80, 0, 0, 0};
        }).find("folds") != std::string::npos);
  CHECK(error([](auto& m) {
          m.distortion = {0, 0, 0.5, 0, 0};
        }).find("folds") != std::string::npos);
  CHECK(error([](auto& m) {
          m.laser_plane = {{0, 0, 1}, 300};
        }).find("outside the image") != std::string::npos);
}
