#include "services/seam_finding/scan/scan_answer.hpp"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "common/bus/message_checks.hpp"
#include "tests/seam_finding/support/synthetic_messages.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

CollectedScan collected(const ScanMessages& messages) {
  CollectedScan scan;
  scan.state = messages.ended;
  scan.profiles = messages.profiles;
  return scan;
}

// Background and workpiece scan of one scene.
struct Scans {
  Scene scene = make_scene({.tool = true}, 11);
  CollectedScan empty, work;

  Scans() {
    Scene cell = scene;
    cell.boxes.clear();
    ScanIdentity identity;
    work = collected(to_messages(make_scan(scene, {}, 1).cloud, identity));
    identity.scan_id -= 60'000'000;
    identity.kind = scan_t::BACKGROUND;
    empty = collected(to_messages(make_scan(cell, {}, 2).cloud, identity));
  }
  seam_t answer(const SeamFindingSettings& settings = {}) const {
    const StoredBackground background(empty, settings);
    return answer_workpiece(work, &background, settings);
  }
  void lose(CollectedScan& scan, std::size_t from, std::size_t count) {
    scan.profiles.erase(scan.profiles.begin() + static_cast<std::ptrdiff_t>(from),
                        scan.profiles.begin() + static_cast<std::ptrdiff_t>(from + count));
    scan.profiles_lost += static_cast<int>(count);
  }
  double start_error(const seam_t& seam) const {
    return (Eigen::Map<const Eigen::Vector3d>(seam.start) - scene.start).norm();
  }
};

// What reconstruction would say in words is nobody's business here.
void without_points(profile_t& profile, std::int8_t why) {
  profile.count = 0;
  for (auto* list :
       {&profile.x, &profile.y, &profile.z, &profile.u, &profile.v, &profile.deviation})
    list->clear();
  profile.segment.clear();
  profile.segment_end.clear();
  profile.why = why;
}

}  // namespace

TEST_CASE("an answer has a meaning, its counts and its identity") {
  const Scans scans;
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
  const seam_t seam = Scans().answer();
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

TEST_CASE("course, stations and torch are told") {
  const seam_t seam = Scans().answer();
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

TEST_CASE("systematic deviations come from the covariance of the scan's calibration") {
  const Scans scans;
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
  const seam_t seam = Scans().answer();
  CHECK(seam.end_systematic[0][0] == -1);
  CHECK(seam.gap == -1);
  CHECK(seam.gap_deviation == -1);
  for (const auto& station : seam.stations) {
    CHECK(station.gap == -1);
    CHECK(station.gap_deviation == -1);
  }
  CHECK_THAT(seam.remark, Catch::Contains("not determined"));
}

TEST_CASE("stripes in the scan's order, with a gap where one is lost") {
  Scans scans;
  scans.lose(scans.work, 10, 2);
  without_points(scans.work.profiles[20], profile_t::NO_STRIPE);
  without_points(scans.work.profiles[21], profile_t::NO_POSITION);
  const ScanCloud cloud = cloud_of(scans.work);
  const auto seen = [&](int k) { return cloud.stripes[k].seen; };
  CHECK(static_cast<int>(cloud.stripes.size()) == scans.work.state.images);
  CHECK(seen(9) == ScanStripe::Seen::kSeen);
  CHECK(seen(10) == ScanStripe::Seen::kMissing);
  CHECK(seen(11) == ScanStripe::Seen::kMissing);
  CHECK(seen(12) == ScanStripe::Seen::kSeen);
  CHECK(seen(22) == ScanStripe::Seen::kEmpty);
  CHECK(seen(23) == ScanStripe::Seen::kMissing);
  const ScanBalance balance = balance_of(scans.work);
  CHECK(balance.profiles_lost == 2);
  CHECK(balance.empty == 1);
  CHECK(balance.without_pose == 1);
}

TEST_CASE("an incomplete image tells nothing, one without a stripe tells that nothing was there") {
  Scans scans;
  const auto seen = [&](std::int8_t why) {
    without_points(scans.work.profiles[3], why);
    return cloud_of(scans.work).stripes[3].seen;
  };
  for (const std::int8_t nothing :
       {profile_t::NO_STRIPE, profile_t::NONE_CHOSEN, profile_t::OUT_OF_RANGE})
    CHECK(seen(nothing) == ScanStripe::Seen::kEmpty);
  for (const std::int8_t unknown :
       {profile_t::TOO_MUCH_LIGHT, profile_t::INCOMPLETE_IMAGE, profile_t::LASER_OFF,
        profile_t::UNREADABLE_IMAGE, profile_t::UNKNOWN_ENCODING, profile_t::NO_POSITION,
        profile_t::NO_CALIBRATION, profile_t::CALIBRATION_CHANGED, profile_t::OTHER_SENSOR,
        profile_t::WRONG_TIME})
    CHECK(seen(unknown) == ScanStripe::Seen::kMissing);
}

TEST_CASE("every image of a scan is counted once, by why it gave no points") {
  Scans scans;
  auto& profiles = scans.work.profiles;
  const int all = static_cast<int>(profiles.size());
  without_points(profiles[1], profile_t::NO_STRIPE);
  without_points(profiles[2], profile_t::OUT_OF_RANGE);
  without_points(profiles[4], profile_t::TOO_MUCH_LIGHT);
  without_points(profiles[6], profile_t::INCOMPLETE_IMAGE);
  without_points(profiles[8], profile_t::LASER_OFF);
  without_points(profiles[10], profile_t::UNREADABLE_IMAGE);
  without_points(profiles[12], profile_t::NO_POSITION);
  scans.work.state.lost = 1;  // sensor_capture counts the incomplete one as well
  scans.lose(scans.work, 14, 1);
  const ScanBalance balance = balance_of(scans.work);
  CHECK(balance.empty == 2);
  CHECK(balance.overlit == 1);
  CHECK(balance.unusable == 2);
  CHECK(balance.without_pose == 1);
  CHECK(balance.images_lost == 1);
  CHECK(balance.profiles_lost == 1);
  CHECK(balance.stripes + balance.empty + balance.overlit + balance.unusable +
            balance.without_pose + balance.images_lost + balance.profiles_lost ==
        all);
  CHECK(balance.losses() ==
        "1 images lost at the camera, 1 of them incomplete; 1 images with too much light; 2 images "
        "without laser, or unreadable; 1 stripes lost on their way; 1 stripes without position; ");
}

TEST_CASE("a scan that is refused for too much light says so") {
  Scans scans;
  for (std::size_t k = 0; k < 20; ++k)
    without_points(scans.work.profiles[k], profile_t::TOO_MUCH_LIGHT);
  const seam_t seam = scans.answer();
  REQUIRE(seam.verdict == seam_t::REFUSED);
  CHECK(seam.refusal == seam_t::TOO_MUCH_LIGHT);
  CHECK_THAT(seam.reason, Catch::Contains("20 images with too much light"));
  CHECK(seam.stripes_overlit == 20);
  CHECK(seam.stripes_empty == 0);
  for (std::size_t k = 0; k < 20; ++k)
    without_points(scans.empty.profiles[k], profile_t::TOO_MUCH_LIGHT);
  CHECK(background_error(scans.empty).code == seam_t::BACKGROUND_OVERLIT);
}

TEST_CASE("losses are flagged, and refused where they are many") {
  Scans scans;
  SECTION("a few within the seam") {
    scans.lose(scans.work, 30, 2);
    without_points(scans.work.profiles[25], profile_t::NO_POSITION);
    scans.work.state.lost = 1;
    const seam_t seam = scans.answer();
    REQUIRE(seam.verdict == seam_t::FOUND);
    CHECK_THAT(seam.remark, Catch::Contains("2 stripes lost on their way") &&
                                Catch::Contains("1 stripes without position") &&
                                Catch::Contains("1 images lost at the camera"));
    CHECK(seam.profiles_lost == 2);
    CHECK(seam.stripes_without_pose == 1);
    CHECK(seam.images_lost == 1);
    CHECK(scans.start_error(seam) < 3.6);
  }
  SECTION("more than a quarter") {
    scans.lose(scans.work, 0, 15);
    const seam_t seam = scans.answer();
    CHECK(seam.verdict == seam_t::REFUSED);
    CHECK(seam.refusal == seam_t::TOO_LITTLE_KNOWN);
    CHECK_THAT(seam.reason, Catch::Contains("too little of the scan is known"));
  }
  SECTION("all") {
    scans.lose(scans.work, 0, scans.work.profiles.size());
    const seam_t seam = scans.answer();
    CHECK(seam.verdict == seam_t::REFUSED);
    CHECK(seam.points == 0);
  }
}

TEST_CASE("a scan that cannot be evaluated is refused with its reason") {
  Scans scans;
  const auto reason = [&](const seam_t& seam, std::int16_t code) {
    CHECK(seam.verdict == seam_t::REFUSED);
    CHECK(seam.refusal == code);
    CHECK(meaning_error(seam).empty());
    return seam.reason;
  };
  SECTION("no background") {
    CHECK_THAT(reason(answer_workpiece(scans.work, nullptr, {}), seam_t::NO_BACKGROUND),
               Catch::Contains("no background"));
  }
  SECTION("another calibration within it") {
    scans.work.profiles[30].calibration_id = "calibration-2";
    CHECK_THAT(reason(scans.answer(), seam_t::CALIBRATION_CHANGED),
               Catch::Contains("calibration changed"));
  }
  SECTION("reconstruction says so") {
    without_points(scans.work.profiles[30], profile_t::CALIBRATION_CHANGED);
    CHECK_THAT(reason(scans.answer(), seam_t::CALIBRATION_CHANGED),
               Catch::Contains("calibration changed"));
  }
  SECTION("no images") {
    scans.work.profiles.clear();
    scans.work.state.images = 0;
    CHECK_THAT(reason(scans.answer(), seam_t::NO_IMAGES), Catch::Contains("no images"));
  }
  SECTION("no stripes") {
    for (auto& profile : scans.work.profiles) without_points(profile, profile_t::NO_STRIPE);
    CHECK_THAT(reason(scans.answer(), seam_t::NO_STRIPE),
               Catch::Contains("no stripe in any image"));
  }
  SECTION("no work in the cell") {
    scans.work.profiles = scans.empty.profiles;
    for (auto& profile : scans.work.profiles) profile.scan_id = scans.work.state.scan_id;
    const seam_t seam = scans.answer();
    CHECK(seam.refusal > seam_t::SCAN_AGAIN);
    CHECK_THAT(reason(seam, seam.refusal), Catch::Contains("no workpiece"));
  }
}

TEST_CASE("a background must be complete") {
  Scans scans;
  CHECK(background_error(scans.empty).empty());
  SECTION("single stripes may be missing") {
    scans.lose(scans.empty, 20, 1);
    CHECK(background_error(scans.empty).empty());
    CHECK_THAT(answer_background(scans.empty, {}).remark, Catch::Contains("1 stripes lost"));
  }
  SECTION("not two in a row") {
    scans.lose(scans.empty, 20, 2);
    CHECK_THAT(background_error(scans.empty).words, Catch::Contains("not complete"));
  }
  SECTION("not many") {
    for (int i : {40, 30, 20, 10}) scans.lose(scans.empty, i, 1);
    CHECK_THAT(background_error(scans.empty).words, Catch::Contains("not complete"));
  }
  SECTION("not with the camera lost in it") {
    scans.empty.state.end_cause = scan_t::CAMERA_LOST;
    CHECK(background_error(scans.empty).code == seam_t::CAMERA_LOST);
    CHECK_THAT(background_error(scans.empty).words, Catch::Contains("camera was lost"));
  }
  SECTION("not without points") {
    scans.empty.profiles.clear();
    CHECK_THAT(background_error(scans.empty).words, Catch::Contains("no points"));
  }
  const ScanRefusal error = background_error(scans.empty);
  const seam_t receipt = answer_background(scans.empty, error);
  CHECK(meaning_error(receipt).empty());
  CHECK(receipt.verdict == (error.empty() ? seam_t::BACKGROUND_STORED : seam_t::REFUSED));
  CHECK(receipt.refusal == error.code);
  CHECK(receipt.reason == error.words);
}

TEST_CASE("numbers that no cell holds are left out") {
  Scans scans;
  for (auto& profile : scans.work.profiles)
    if (profile.count > 4) profile.x[3] = 9e6f;
  scans.work.state.last_seq += 1'000'000'000'000;  // damage: bounded in time and memory
  const ScanCloud cloud = cloud_of(scans.work);
  for (const auto& point : cloud.points) CHECK(point.norm() < 1e4);
  CHECK(cloud.stripes.size() < 200'000);
  CHECK(scans.answer().verdict == seam_t::REFUSED);
}
