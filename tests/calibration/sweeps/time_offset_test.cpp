// The time offset, from sweeps in closed form and from the simulated sensor's.
#include "services/calibration/sweeps/time_offset.hpp"

#include <catch2/catch.hpp>

#include "services/cell_simulator/base/random_stream.hpp"
#include "tests/bench/calibration/simulated_sweeps.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::cell_simulator;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

constexpr std::int64_t kBegin = 1'700'000'000'000'000;  // us

Calibration plain_sensor() {
  Calibration calibration;
  calibration.sensor_model = {1000, 1000, 1000, 1000, 500, 500, {}, {}};
  calibration.sensor_model.laser_plane = {Eigen::Vector3d(-0.8, 0, 0.6), -180};  // z = 300 at x = 0
  calibration.origin = "drawn";
  return calibration;
}

// A camera that looks straight down and runs to and fro, what it sees of the plane z = slope * x in
// closed form. late: of an image's stamp; s. Each run goes on for 0.3 s at its ends, at rest.
struct DrawnSweeps {
  double slope = 0.5, rise = 0, late = 0.02, play = 0, noise_mm = 0;
  std::vector<double> speeds{40, -40, 100, -100};  // mm/s; below 0 back

  SweepData record(double length = 100) const {
    SweepData record;
    RandomStream noise(1);
    std::int64_t time = kBegin;
    for (const double speed : speeds) {
      const double duration = length / std::abs(speed);
      const auto end = static_cast<std::int64_t>(1e6 * (duration + 0.6));
      for (std::int64_t t = 0; t < end; t += 10'000) {
        RigidTransform said = pose(speed, length, t);
        for (double& value : said.translation()) value += noise_mm * noise.normal();
        record.trajectory.insert(time + t, said);
      }
      for (std::int64_t t = 331'000; t < end - 331'000; t += 50'000)
        record.stripes.push_back({time + t + static_cast<std::int64_t>(std::llround(1e6 * late)),
                                  kBegin,
                                  {stripe(pose(speed, length, t), speed)}});
      time += end;
    }
    return record;
  }

 private:
  RigidTransform pose(double speed, double length, std::int64_t t) const {
    const double way =
        std::clamp(std::abs(speed) * (static_cast<double>(t) * 1e-6 - 0.3), 0.0, length);
    const double x = speed > 0 ? way : length - way;
    RigidTransform T = RigidTransform::Identity();
    T.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
    T.translation() = Eigen::Vector3d(x, 0, 300 + rise * x);
    return T;
  }
  // The laser plane's cut with the face: the line along the camera's ray that meets both.
  std::vector<Eigen::Vector2d> stripe(RigidTransform T, double speed) const {
    const Eigen::Vector3d way(1, 0, rise);
    T.translation() -= std::copysign(play, speed) * way.normalized();
    const Calibration sensor = plain_sensor();
    const Plane& laser = sensor.sensor_model.laser_plane;
    const Eigen::Vector3d face = Eigen::Vector3d(-slope, 0, 1);  // face . p = 0 in base
    const Eigen::Vector3d normal = T.linear().transpose() * face;
    const double offset = face.dot(T.translation());
    const Eigen::Vector3d along = normal.cross(laser.normal).normalized();
    Eigen::Matrix3d rows;
    rows << normal.transpose(), laser.normal.transpose(), along.transpose();
    const Eigen::Vector3d middle =
        rows.inverse() *
        Eigen::Vector3d(-offset, -laser.offset, along.dot(Eigen::Vector3d(0, 0, 300)));
    std::vector<Eigen::Vector2d> pixels;
    for (double s = -30; s <= 30; s += 0.5)
      pixels.push_back(project(sensor.sensor_model, middle + s * along));
    return pixels;
  }
};

SimulatedSweepsSettings rising_sweeps() {
  SimulatedSweepsSettings settings;
  settings.sensor.image_width_px = 800;
  settings.sensor.image_height_px = 600;
  settings.scene.search_rise_mm = 100;
  return settings;
}

}  // namespace

TEST_CASE("exact sweeps over a tilted face give back the time offset and the play") {
  for (const double late : {0.0, 0.02, -0.05, 0.12}) {
    DrawnSweeps drawn;
    drawn.late = late;
    const TimeOffset found = find_time_offset(drawn.record(), plain_sensor());
    INFO(found.refused);
    REQUIRE(found.refused.empty());
    CHECK(found.offset_s == Approx(-late).margin(2e-5));
    CHECK(found.play_mm == Approx(0).margin(2e-3));
    CHECK(found.residual_mm < 0.01);
    CHECK((late == 0 || found.unmended_mm > 0.3));
    CHECK(found.warnings.empty());
  }
  DrawnSweeps drawn;
  drawn.play = 0.2;
  const TimeOffset found = find_time_offset(drawn.record(), plain_sensor());
  CHECK(found.offset_s == Approx(-0.02).margin(1e-4));
  CHECK(found.play_mm == Approx(-0.2).margin(0.01));
  REQUIRE(found.warnings.size() == 1);
  CHECK_THAT(found.warnings[0], Contains("play"));
}

TEST_CASE("a level face serves where the robot rises on its way") {
  DrawnSweeps drawn;
  drawn.slope = 0;
  drawn.rise = 0.4;
  const TimeOffset found = find_time_offset(drawn.record(), plain_sensor());
  REQUIRE(found.refused.empty());
  CHECK(found.offset_s == Approx(-0.02).margin(2e-5));
}

TEST_CASE("what tells nothing of the offset is refused with what is missing") {
  const auto refusal = [](const DrawnSweeps& drawn) {
    return find_time_offset(drawn.record(), plain_sensor()).refused;
  };
  DrawnSweeps level;
  level.slope = 0;
  CHECK_THAT(refusal(level), Contains("parallel to the motion"));
  DrawnSweeps one_way;
  one_way.speeds = {50};
  one_way.noise_mm = 0.02;
  CHECK_THAT(refusal(one_way), Contains("one direction and speed"));
  CHECK_THAT(find_time_offset({}, plain_sensor()).refused, Contains("no sweep"));
  SweepData dark = DrawnSweeps{}.record();
  for (SweepProfile& stripe : dark.stripes) stripe.segments = {{{500, 500}}};
  CHECK_THAT(find_time_offset(dark, plain_sensor()).refused, Contains("no flat face"));
}

TEST_CASE("speeds that are too alike are said, and the deviation bears the play they may hide") {
  DrawnSweeps alike;
  alike.speeds = {100, -100, 110, -110};
  alike.noise_mm = 0.02;
  const TimeOffset found = find_time_offset(alike.record(), plain_sensor());
  REQUIRE(found.refused.empty());
  REQUIRE_FALSE(found.warnings.empty());
  CHECK_THAT(found.warnings[0], Contains("too alike"));
  CHECK(found.deviation_s > 0.3e-3);
  CHECK(found.deviation_s < 0.1 / 105);  // 0.1 mm at this speed is all that play may be
  alike.speeds = {50, -50, 100, -100};
  CHECK(find_time_offset(alike.record(), plain_sensor()).deviation_s < found.deviation_s / 2);
}

TEST_CASE("a corner's two faces and a hand-eye that is off do not move the offset") {
  SimulatedSweepsSettings settings = rising_sweeps();
  settings.kind = SceneKind::workpiece;
  SweepData record;
  append_sweeps(record, settings, 701);
  Calibration calibration = true_calibration(settings);
  calibration.time_offset = 0;
  const TimeOffset found = find_time_offset(record, calibration);
  REQUIRE(found.refused.empty());
  CHECK(found.faces.size() >= 2);
  CHECK(found.offset_s == Approx(-0.02732).margin(5 * found.deviation_s));
  CHECK(found.deviation_s < 0.5e-3);

  calibration.T_tool_camera.translation() += Eigen::Vector3d(0.7, -0.7, 0.7);
  calibration.T_tool_camera.rotate(Eigen::AngleAxisd(0.005, Eigen::Vector3d::UnitX()));
  const TimeOffset off = find_time_offset(record, calibration);
  REQUIRE(off.refused.empty());
  CHECK(off.offset_s == Approx(found.offset_s).margin(0.3e-3));
}

TEST_CASE("the offset of a simulated sensor is found from rough table and jittering stamps",
          "[figures]") {
  for (const std::uint64_t seed : {702, 703}) {
    const SimulatedSweepsSettings settings = rising_sweeps();
    SweepData record;
    append_sweeps(record, settings, seed);
    Calibration calibration = true_calibration(settings);
    calibration.time_offset = 0;
    calibration.covariance.assign(19 * 19, 0);
    const TimeOffset found = find_time_offset(record, calibration);
    REQUIRE(found.refused.empty());
    CHECK(found.deviation_s < 0.4e-3);
    CHECK(found.offset_s == Approx(-0.02732).margin(4 * found.deviation_s));
    const Calibration changed = with_time_offset(with_time_offset(calibration, found), found);
    CHECK(changed.time_offset == found.offset_s);
    CHECK(changed.covariance.back() == found.deviation_s * found.deviation_s);
    CHECK(changed.origin.find("time offset") == changed.origin.rfind("time offset"));
    CHECK(changed.id.empty());
  }
}
