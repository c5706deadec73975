#include "services/seam_finding/scan/scan_answer.hpp"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>

#include "common/bus/message_checks.hpp"
#include "tests/seam_finding/scan/answered_scans.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

TEST_CASE("an answer has a meaning, its counts and its identity") {
  const AnsweredScans scans;
  const seam_t seam = scans.answer();
  REQUIRE(seam.verdict == seam_t::FOUND);
  CHECK(meaning_error(seam).empty());
  CHECK(seam.utime == scans.work.state.end_utime);
  CHECK(seam.run_id == scans.work.state.run_id);
  CHECK(seam.scan_id == scans.work.state.scan_id);
  CHECK(seam.background_scan_id == scans.empty.state.scan_id);
  CHECK(seam.calibration_id == "calibration-1");
  CHECK(seam.command_id == scans.work.state.start_command_id);
  CHECK(seam.request == 7);
  CHECK(seam.job == "job");
  CHECK(seam.part == "part");
  CHECK(seam.refusal == 0);
  CHECK(seam.usable == seam_t::USABLE);
  CHECK(scans.start_error(seam) < 3.6);
  int points = 0;
  for (const auto& profile : scans.work.profiles) points += profile.count;
  CHECK(seam.points == points);
  CHECK(seam.stripes == static_cast<int>(scans.work.profiles.size()));
  CHECK(seam.background_points > points / 2);
  CHECK(seam.seam_points > 500);
  CHECK(seam.background_points + seam.seam_points <= points);
  CHECK(seam.reason.empty());
}

TEST_CASE("ends and deviations are told") {
  const seam_t seam = AnsweredScans().answer();
  CHECK(seam.start_visibility == seam_t::SEEN);
  CHECK(seam.end_visibility == seam_t::SEEN);
  const Eigen::Map<const Eigen::Matrix3d> start(&seam.start_covariance[0][0]);
  CHECK((start - start.transpose()).norm() < 1e-12);
  CHECK(start.ldlt().isPositive());
  CHECK(start.trace() < 4);
  CHECK(seam.direction_deviation > 0);
  CHECK(seam.direction_deviation < 0.002);
  CHECK(seam.normal_deviations[0] > 0);
  CHECK(seam.normal_deviations[1] > 0);
  CHECK(seam.angle_deviation > 0);
}

TEST_CASE("what the cell states of its robot's accuracy is contained in the deviations") {
  const AnsweredScans scans;
  const seam_t exact = scans.answer();
  SeamFindingSettings settings;
  settings.robot_accuracy_mm = 0.3;
  const seam_t stated = scans.answer(settings);
  REQUIRE(stated.verdict == seam_t::FOUND);
  const double length = (Eigen::Map<const Eigen::Vector3d>(stated.end) -
                         Eigen::Map<const Eigen::Vector3d>(stated.start))
                            .norm();
  const double turn = 0.3 * std::sqrt(2.0) / length;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double more = row == column ? 0.3 * 0.3 : 0;
      CHECK(std::abs(stated.start_covariance[row][column] - exact.start_covariance[row][column] -
                     more) < 1e-9);
      CHECK(std::abs(stated.end_covariance[row][column] - exact.end_covariance[row][column] -
                     more) < 1e-9);
    }
  CHECK(std::abs(stated.direction_deviation - std::hypot(exact.direction_deviation, turn)) < 1e-5);
}

TEST_CASE("that the answer was held against the stripes is told, and how well it stands") {
  const AnsweredScans scans;
  const seam_t seam = scans.answer();
  CHECK(seam.stripes_checked > 20);
  CHECK(seam.stripes_checked <= seam.stripes);
  CHECK(seam.explained_share > 0.9);
  CHECK(seam.explained_share <= 1);
  CHECK(seam.worst_contradiction >= 0);
  CHECK(seam.worst_contradiction < 0.5);
  CHECK(seam.start_second_weight == 0);
  CHECK(seam.end_second_weight == 0);

  SeamFindingSettings paper;
  paper.start_rule = StartRule::kStripe;
  CHECK(scans.answer(paper).stripes_checked == -1);
}

TEST_CASE("course, stations and torch are told") {
  const seam_t seam = AnsweredScans().answer();
  CHECK(seam.polyline_count == 2);
  CHECK(seam.polyline_deviation >= 0);
  CHECK(seam.polyline_deviation < 0.2);
  REQUIRE(seam.station_count > 15);
  for (int i = 0; i < seam.station_count; ++i) {
    CHECK(seam.stations[i].distance >= 0);
    if (i > 0) CHECK(seam.stations[i].distance > seam.stations[i - 1].distance);
    CHECK_FALSE(seam.stations[i].tack);
    CHECK(seam.stations[i].residual < 0.5);
  }
  CHECK(seam.torch_determined);
  CHECK(std::equal(std::begin(seam.start), std::end(seam.start), seam.torch_position));
}

TEST_CASE("with a calibration that did not pass, or was never judged, no seam is usable") {
  using Passed = CalibrationVerdict::Passed;
  const AnsweredScans scans;
  const StoredBackground background(scans.empty, {});
  const PreparedScan prepared = prepare(scans.work, &background);
  Calibration calibration;
  calibration.id = ScanIdentity{}.calibration_id;
  const auto answer = [&](Passed passed, const std::string& forced_by) {
    calibration.verdict.passed = passed;
    calibration.verdict.forced_by = forced_by;
    return answer_workpiece(scans.work, prepared, &background, {}, &calibration);
  };
  CHECK(answer(Passed::kPassed, "").usable == seam_t::USABLE);
  const seam_t forced = answer(Passed::kFailed, "R. Meyer");
  CHECK(forced.verdict == seam_t::FOUND);
  CHECK(forced.usable == seam_t::CALIBRATION_FAILED);
  CHECK_THAT(forced.remark, Catch::Contains("forced into use by R. Meyer"));
  const seam_t unjudged = answer(Passed::kNotJudged, "");
  CHECK(unjudged.usable == seam_t::CALIBRATION_FAILED);
  CHECK_THAT(unjudged.remark, Catch::Contains("no verdict"));
}

TEST_CASE("systematic deviations come from the covariance of the scan's calibration") {
  const AnsweredScans scans;
  const StoredBackground background(scans.empty, {});
  Calibration calibration;
  calibration.id = ScanIdentity{}.calibration_id;
  calibration.sensor_model = {1600, 1200, 2400, 2400, 800, 600, {}, {{0, 0.4, -0.9165}, 275}};
  const auto answer = [&] { return answer_workpiece(scans.work, &background, {}, &calibration); };
  CHECK(answer().start_systematic[0][0] == -1);
  CHECK_THAT(answer().remark, Catch::Contains("the calibration has no covariance"));

  // The hand-eye's position alone: the start is as unsure as that.
  calibration.covariance.assign(Calibration::kParameters * Calibration::kParameters, 0);
  for (int i = 15; i < 18; ++i)
    calibration.covariance[static_cast<std::size_t>(i * (Calibration::kParameters + 1))] = 0.04;
  const seam_t seam = answer();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      CHECK(seam.start_systematic[row][column] == Approx(row == column ? 0.04 : 0).margin(1e-6));
      CHECK(seam.end_systematic[row][column] == Approx(row == column ? 0.04 : 0).margin(1e-6));
    }
  CHECK_THAT(seam.remark, !Catch::Contains("systematic"));

  // So late as the tool moves on in the time offset's deviation.
  std::fill(calibration.covariance.begin(), calibration.covariance.end(), 0);
  calibration.covariance.back() = 1e-6;  // 1 ms
  const double speed = 3.6 / 0.071;      // mm/s
  CHECK(answer().start_systematic[0][0] == Approx(std::pow(speed * 1e-3, 2)).epsilon(0.05));

  calibration.id = "another";
  CHECK(answer().start_systematic[0][0] == -1);
  CHECK_THAT(answer().remark, Catch::Contains("not heard of"));
}

TEST_CASE("what is not determined says so") {
  const seam_t seam = AnsweredScans().answer();
  CHECK(seam.end_systematic[0][0] == -1);
  CHECK(seam.gap == -1);
  CHECK(seam.gap_deviation == -1);
  for (const auto& station : seam.stations) {
    CHECK(station.gap == -1);
    CHECK(station.gap_deviation == -1);
  }
  CHECK_THAT(seam.remark, Catch::Contains("not determined"));
}

TEST_CASE("numbers that no cell holds are left out") {
  AnsweredScans scans;
  for (auto& profile : scans.work.profiles)
    if (profile.count > 4) profile.x[3] = 9e6f;
  scans.work.state.last_seq += 1'000'000'000'000;  // damage: bounded in time and memory
  const ScanCloud cloud = cloud_of(scans.work);
  for (const auto& point : cloud.points) CHECK(point.norm() < 1e4);
  CHECK(cloud.stripes.size() < 200'000);
  CHECK(scans.answer().verdict == seam_t::REFUSED);
}
