#include <catch2/catch.hpp>

#include "common/bus/message_checks.hpp"
#include "services/seam_finding/scan/scan_answer.hpp"
#include "tests/seam_finding/scan/answered_scans.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

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

TEST_CASE("stripes in the scan's order, with a gap where one is lost") {
  AnsweredScans scans;
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
  AnsweredScans scans;
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
  AnsweredScans scans;
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
  AnsweredScans scans;
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
  CHECK(background_error(scans.empty, {}).code == seam_t::BACKGROUND_OVERLIT);
}

TEST_CASE("losses are flagged, and refused where they are many") {
  AnsweredScans scans;
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
  AnsweredScans scans;
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
  AnsweredScans scans;
  CHECK(background_error(scans.empty, {}).empty());
  SECTION("single stripes may be missing") {
    scans.lose(scans.empty, 20, 1);
    CHECK(background_error(scans.empty, {}).empty());
    CHECK_THAT(answer_background(scans.empty, {}).remark, Catch::Contains("1 stripes lost"));
  }
  SECTION("not two in a row") {
    scans.lose(scans.empty, 20, 2);
    CHECK_THAT(background_error(scans.empty, {}).words, Catch::Contains("not complete"));
  }
  SECTION("not many") {
    for (int i : {40, 30, 20, 10}) scans.lose(scans.empty, i, 1);
    CHECK_THAT(background_error(scans.empty, {}).words, Catch::Contains("not complete"));
  }
  SECTION("not with the camera lost in it") {
    scans.empty.state.end_cause = scan_t::CAMERA_LOST;
    CHECK(background_error(scans.empty, {}).code == seam_t::CAMERA_LOST);
    CHECK_THAT(background_error(scans.empty, {}).words, Catch::Contains("camera was lost"));
  }
  SECTION("not without points") {
    for (auto& profile : scans.empty.profiles) without_points(profile, profile_t::NO_STRIPE);
    CHECK_THAT(background_error(scans.empty, {}).words, Catch::Contains("is the laser on"));
  }
  SECTION("images that never came say nothing of the laser") {
    if (GENERATE(true, false)) {
      for (auto& profile : scans.empty.profiles)
        without_points(profile, profile_t::INCOMPLETE_IMAGE);
      scans.empty.state.lost = scans.empty.state.images;
    } else {
      scans.lose(scans.empty, 0, scans.empty.profiles.size());
    }
    CHECK(background_error(scans.empty, {}).code == seam_t::BACKGROUND_INCOMPLETE);
    CHECK_THAT(background_error(scans.empty, {}).words,
               Catch::Contains("lost") && !Catch::Contains("is the laser on"));
  }
  const ScanRefusal error = background_error(scans.empty, {});
  const seam_t receipt = answer_background(scans.empty, error);
  CHECK(meaning_error(receipt).empty());
  CHECK(receipt.verdict == (error.empty() ? seam_t::BACKGROUND_STORED : seam_t::REFUSED));
  CHECK(receipt.refusal == error.code);
  CHECK(receipt.reason == error.words);
}
