#include "services/reconstruction/carry_to_base.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "services/reconstruction/down_sampling.hpp"
#include "tests/reconstruction/synthetic_cell.hpp"

using namespace arcstart;
using namespace arcstart::reconstruction;
using namespace arcstart::test;

namespace {

constexpr WorkingRange kWide{50, 1000};

RigidTransform from_opencv(const cv::Matx44d& matrix) {
  RigidTransform transform = RigidTransform::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      transform.matrix()(row, column) = matrix(row, column);
  return transform;
}

std::vector<ReceivedCentre> centres_of(const stripe_t& message) {
  std::vector<ReceivedCentre> centres;
  for (std::size_t i = 0; i < message.u.size(); ++i)
    centres.push_back({message.u[i], message.v[i], message.deviation[i], message.segment[i]});
  return centres;
}

}  // namespace

TEST_CASE("points seen through OpenCV's camera are found again in base") {
  for (const std::int64_t time : {0, 700'000, 3'000'000}) {
    const TrueStripe stripe = stripe_at(time, 0, 1);
    REQUIRE(stripe.points.size() > 500);
    const auto points =
        carry_to_base(centres_of(stripe.message), true_calibration(),
                      from_opencv(tool_at(static_cast<double>(time) * 1e-6)), kWide);
    REQUIRE(points.size() == stripe.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [position, centre, deviation] = points[i];
      const cv::Vec3d error =
          cv::Vec3d(position.x(), position.y(), position.z()) - stripe.points[i];
      CHECK(cv::norm(error) < 1e-4);  // pixels are floats: 6e-5 px
      CHECK(centre.u == stripe.message.u[i]);
      CHECK(centre.segment == stripe.message.segment[i]);
    }
  }
}

TEST_CASE("a centre's deviation is carried by the derivative across the stripe") {
  Calibration calibration = true_calibration();
  calibration.sensor_model.distortion = {};
  const SensorModel& model = calibration.sensor_model;
  // A straight stripe in the image, with sigma 0.2 px across it.
  const Eigen::Vector2d along = Eigen::Vector2d(5, 2).normalized(), across(-along.y(), along.x());
  std::vector<ReceivedCentre> centres;
  for (int i = 0; i < 20; ++i)
    centres.push_back({static_cast<float>(700 + 10 * i * along.x()),
                       static_cast<float>(600 + 10 * i * along.y()), 0.2f, 3});
  const auto points = carry_to_base(centres, calibration, RigidTransform::Identity(), kWide);
  REQUIRE(points.size() == centres.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // p = s r with s = -d / n.r, so dp = s (I - r n' / n.r) dr.
    const Eigen::Vector3d ray((centres[i].u - model.cx) / model.fx,
                              (centres[i].v - model.cy) / model.fy, 1);
    const Eigen::Vector3d change(0.2 * across.x() / model.fx, 0.2 * across.y() / model.fy, 0);
    const auto& n = model.laser_plane.normal;
    const double scale = -model.laser_plane.offset / n.dot(ray);
    const double expected = (scale * (change - ray * n.dot(change) / n.dot(ray))).norm();
    CHECK(points[i].deviation == Approx(expected).epsilon(1e-3));
    CHECK(expected > 0.02);
  }
}

TEST_CASE("deviation is 0 where it was not measured, and safe for a lone centre") {
  Calibration calibration = true_calibration();
  const auto deviation = [&](ReceivedCentre centre) {
    const auto points = carry_to_base({centre}, calibration, RigidTransform::Identity(), kWide);
    REQUIRE(points.size() == 1);
    return points[0].deviation;
  };
  CHECK(deviation({800, 600, 0, 0}) == 0);
  // The plane stands nearly along the rows, so that a step of a row moves the point most: no
  // direction is worse.
  const auto here = camera_point(calibration.sensor_model, 800, 599.5),
             there = camera_point(calibration.sensor_model, 800, 600.5);
  CHECK(deviation({800, 600, 0.5f, 0}) == Approx((*here - *there).norm() / 2).epsilon(1e-3));
}

TEST_CASE("centres that see no laser plane, or see it out of range, give no points") {
  const Calibration calibration = true_calibration();
  const std::vector<ReceivedCentre> centres = {
      {800, 600, 0.1f, 0}, {800, 300, 0.1f, 0}, {800, 1100, 0.1f, 0}};
  // Depths by the closed form for the pixel column near the principal point.
  const auto depth = [&](const ReceivedCentre& centre) {
    return camera_point(calibration.sensor_model, centre.u, centre.v)->z();
  };
  const double middle = depth(centres[0]), upper = depth(centres[1]), lower = depth(centres[2]);
  REQUIRE(upper < middle);
  REQUIRE(middle < lower);
  const auto kept = [&](double nearest, double farthest) {
    std::vector<float> rows;
    for (const auto& point :
         carry_to_base(centres, calibration, RigidTransform::Identity(), {nearest, farthest}))
      rows.push_back(point.centre.v);
    return rows;
  };
  CHECK(kept(50, 1000) == std::vector<float>{600, 300, 1100});
  CHECK(kept(middle - 1, 1000) == std::vector<float>{600, 1100});
  CHECK(kept(50, middle + 1) == std::vector<float>{600, 300});
  CHECK(kept(1, 2).empty());

  Calibration steep = calibration;  // seen only below row 400
  steep.sensor_model.laser_plane = {Eigen::Vector3d(0, 1, 0.08).normalized(), -20};
  const auto points = carry_to_base(centres, steep, RigidTransform::Identity(), kWide);
  for (const auto& point : points) CHECK(point.centre.v != 300);
  CHECK(points.size() == 2);
}
