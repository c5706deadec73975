// Which end is the start, where the seam may lie, and how the torch stands there.
#include "services/seam_finding/answer/weld_order.hpp"

#include <catch2/catch.hpp>

#include "services/seam_finding/referee/ruling.hpp"
#include "tests/seam_finding/scan/answered_scans.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;
using Code = Reason::Code;
using Vector = Eigen::Vector3d;

namespace {

const AnsweredScans& scene() {
  static const AnsweredScans made;
  return made;
}

Vector vector(const double values[3]) { return Vector(values[0], values[1], values[2]); }

Vector axis(const double q[4], const Vector& of) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * of;
}

SeamResult drawn() {
  SeamResult seam;
  seam.verdict = SeamResult::Verdict::kFound;
  seam.joint_type = "tee";
  seam.start = {0, 0, 0}, seam.end = {80, 0, 0}, seam.direction = Vector::UnitX();
  seam.normals = seam.torch_faces = {Vector::UnitZ(), Vector::UnitY()};
  seam.start_visibility = seam.end_visibility = EndVisibility::kSeen;
  return seam;
}

}  // namespace

TEST_CASE("a weld from the far end starts at the true far end, with what is known of it") {
  const seam_t near = scene().answer();
  SeamFindingSettings settings;
  settings.weld_start = WeldStart::kFar;
  const seam_t far = scene().answer(settings);
  REQUIRE(near.verdict == seam_t::FOUND);
  REQUIRE(far.verdict == seam_t::FOUND);
  CHECK((vector(far.start) - scene().scene.end).norm() < 3.6);
  CHECK((vector(far.end) - scene().scene.start).norm() < 3.6);
  const Vector truth = (scene().scene.start - scene().scene.end).normalized();
  CHECK(angle_between(vector(far.direction), truth) < 0.5 * kDegree);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      CHECK(far.start_covariance[row][column] == near.end_covariance[row][column]);
      CHECK(far.end_covariance[row][column] == near.start_covariance[row][column]);
    }
  CHECK(far.start_visibility == near.end_visibility);
  CHECK(far.end_visibility == near.start_visibility);
  CHECK(far.polyline.front() == near.polyline.back());
  REQUIRE(far.station_count == near.station_count);
  REQUIRE(far.station_count > 1);
  for (int i = 0; i < far.station_count; ++i)
    CHECK(far.stations[i].distance ==
          Approx((vector(far.stations[i].position) - vector(far.start)).dot(truth)).margin(0.1));

  // The torch stands over the new start, leans back from the new direction, and comes from outside.
  REQUIRE(far.torch_determined);
  CHECK((vector(far.torch_position) - vector(far.start)).norm() < 1e-9);
  CHECK(axis(far.torch_quaternion, Vector::UnitX()).dot(truth) > 0.9);
  CHECK(axis(far.torch_quaternion, Vector::UnitZ()).dot(truth) ==
        Approx(std::sin(10 * kDegree)).margin(0.02));
  for (const Vector& normal : scene().scene.normals)
    CHECK((vector(far.approach_position) - vector(far.start)).dot(normal) > 50);
}

TEST_CASE("with a search direction near and far do not hang on which way the robot scanned") {
  const Vector along = (scene().scene.end - scene().scene.start).normalized();
  const auto start_of = [&](const Vector& direction, WeldStart start) {
    SeamFindingSettings settings;
    settings.search_direction = {direction.x(), direction.y(), direction.z()};
    settings.weld_start = start;
    return vector(scene().answer(settings).start);
  };
  CHECK((start_of(along, WeldStart::kNear) - scene().scene.start).norm() < 3.6);
  CHECK((start_of(-3 * along, WeldStart::kNear) - scene().scene.end).norm() < 3.6);
  CHECK((start_of(-along, WeldStart::kFar) - scene().scene.start).norm() < 3.6);

  const Vector across = along.cross(Vector::UnitZ()) + 0.3 * along;
  SeamFindingSettings settings;
  settings.search_direction = {across.x(), across.y(), across.z()};
  const seam_t refused = scene().answer(settings);
  CHECK(refused.verdict == seam_t::REFUSED);
  CHECK(refused.refusal == seam_t::CALL);
  CHECK_THAT(refused.reason, Catch::Contains("search direction that is set"));
}

TEST_CASE("remarks, second places and what the referee said follow their ends") {
  SeamResult seam = drawn();
  seam.end_visibility = EndVisibility::kHidden;
  seam.end_second = {{90, 0, 0}, 0.2};
  seam.remarks = {
      {Code::kEndHidden}, {Code::kStartBounded, 0.4}, {Code::kEndOutside}, {Code::kNoGap}};
  exchange_ends({}, seam);
  CHECK(seam.start_visibility == EndVisibility::kHidden);
  CHECK(seam.start_second.place == Vector(90, 0, 0));
  CHECK(seam.end_second.weight == 0);
  CHECK(seam.remarks[0].code == Code::kStartHidden);
  CHECK(seam.remarks[1].code == Code::kEndBounded);
  CHECK(seam.remarks[2].code == Code::kEndOutside);  // the end of the scan
  CHECK(seam.remarks[3].code == Code::kNoGap);
}

TEST_CASE("a seam that leaves the search box is refused, one within it is not") {
  SeamFindingSettings settings;
  const Vector low = scene().scene.start.cwiseMin(scene().scene.end) - Vector::Constant(8);
  const Vector high = scene().scene.start.cwiseMax(scene().scene.end) + Vector::Constant(8);
  settings.search_box_mm = {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
  CHECK(scene().answer(settings).verdict == seam_t::FOUND);
  // Only the end lies outside.
  const int longest = [&] {
    int axis = 0;
    (scene().scene.end - scene().scene.start).cwiseAbs().maxCoeff(&axis);
    return axis;
  }();
  const bool rises = scene().scene.end[longest] > scene().scene.start[longest];
  settings.search_box_mm[longest + (rises ? 3 : 0)] =
      scene().scene.end[longest] + (rises ? -10 : 10);
  const seam_t short_box = scene().answer(settings);
  CHECK(short_box.verdict == seam_t::REFUSED);
  CHECK(short_box.refusal == seam_t::CLEAN);
  CHECK_THAT(short_box.reason, Catch::Contains("outside the search box, by 1"));
  settings.search_box_mm = {high.x() + 200, low.y(), low.z(), high.x() + 300, high.y(), high.z()};
  CHECK(scene().answer(settings).refusal == seam_t::CLEAN);
}

TEST_CASE("the taught orientation and the bias place the torch, and never through a plate") {
  SeamFindingSettings settings;
  SeamResult seam = drawn();
  // Wire down and forward into the corner: W turns z from up to down, by 135 deg from base z.
  settings.torch_wpr_deg = {135, 0, 0};
  settings.bias_mm = {1, 2, 3};
  settings.approach_mm = 50;
  set_weld_order(settings, seam);
  REQUIRE_FALSE(seam.torch);  // nothing places it but find_seam and an exchange
  settings.weld_start = WeldStart::kFar;
  set_weld_order(settings, seam);
  REQUIRE(seam.torch);
  const double half = std::sqrt(0.5);
  CHECK((seam.torch->orientation * Vector::UnitZ() - Vector(0, -half, -half)).norm() < 1e-12);
  // Axes of the weld, which runs along -x: z (0, 1, 1), y = z x x.
  const Vector x(-1, 0, 0), z(0, half, half);
  const Vector tip = Vector(80, 0, 0) + 1 * x + 2 * z.cross(x) + 3 * z;
  CHECK((seam.torch->position - tip).norm() < 1e-12);
  CHECK((seam.torch->approach - (tip + 50 * z)).norm() < 1e-12);

  settings.torch_wpr_deg = {0, 0, 0};  // from below
  exchange_ends(settings, seam);
  CHECK_FALSE(seam.torch);
  CHECK(seam.remarks.back().code == Code::kTorchThroughPlate);
}

TEST_CASE("an end that is known less well than the job allows is not determined") {
  SeamFindingSettings settings;
  settings.end_deviation_max_mm = 0.5;
  SeamResult seam = drawn();
  seam.accuracy =
      SeamAccuracy{Vector(0.01, 0.04, 0.09).asDiagonal(), Vector(0.01, 0.36, 0.09).asDiagonal()};
  set_weld_order(settings, seam);
  CHECK(seam.start_visibility == EndVisibility::kSeen);
  CHECK(seam.end_visibility == EndVisibility::kNotDetermined);
  CHECK(seam.remarks.back().code == Code::kEndDeviationLarge);
  CHECK(seam.remarks.back().number == Approx(0.6));
  SeamResult unknown = drawn();
  set_weld_order(settings, unknown);
  CHECK(unknown.start_visibility == EndVisibility::kNotDetermined);
}
