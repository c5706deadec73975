// Scans in, answers out.
#include <catch2/catch.hpp>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/scan/answer_mark.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"
#include "tests/seam_finding/scan/service_life.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

TEST_CASE("background, then workpiece, then the seam") {
  Life life;
  life.scan(scans().empty);
  REQUIRE(life.seams.size() == 1);
  CHECK(life.seams[0].verdict == seam_t::BACKGROUND_STORED);
  CHECK(life.seams[0].scan_id == scans().empty.ended.scan_id);
  life.scan(scans().work);
  REQUIRE(life.seams.size() == 2);
  REQUIRE(life.seams[1].verdict == seam_t::FOUND);
  CHECK(life.seams[1].background_scan_id == scans().empty.ended.scan_id);
  CHECK(scans().start_error(life.seams[1]) < 3.6);
  life.scan(scans().second);
  REQUIRE(life.seams.size() == 3);
  CHECK(life.seams[2].verdict == seam_t::FOUND);
  CHECK(scans().start_error(life.seams[2]) < 3.6);
  CHECK(life.app->health().state == service_status_t::RUNNING);
  CHECK(life.app->health().lost == 0);
}

TEST_CASE("the same messages give the same bytes, whatever the order of the channels") {
  Life judge;
  judge.scan(scans().empty);
  judge.scan(scans().work);
  REQUIRE(judge.bytes.size() == 2);
  for (const std::size_t shift : {std::size_t{1}, std::size_t{4}, std::size_t{1000}}) {
    // The states come before or behind the profiles by so many messages.
    for (const bool states_lead : {true, false}) {
      Life life;
      for (const ScanMessages* messages : {&scans().empty, &scans().work}) {
        const std::size_t count = messages->profiles.size();
        const std::size_t at =
            states_lead ? (shift < count ? count - shift : 0) : std::min(shift, count);
        if (states_lead) life.state(messages->scanning);
        for (std::size_t i = 0; i < count; ++i) {
          if (states_lead && i == at) life.state(messages->ended);
          if (!states_lead && i == at) life.state(messages->scanning);
          life.profile(messages->profiles[i]);
        }
        if (!states_lead) life.state(messages->scanning), life.state(messages->ended);
      }
      REQUIRE(life.bytes.size() == 2);
      CHECK(life.bytes == judge.bytes);
    }
  }
}

TEST_CASE("the answer is repeated, byte for byte, until the next scan starts") {
  Life life;
  life.scan(scans().empty);
  life.live(2.2);
  REQUIRE(life.bytes.size() >= 3);
  CHECK(std::all_of(life.bytes.begin(), life.bytes.end(),
                    [&](const auto& one) { return one == life.bytes[0]; }));
  life.state(scans().work.scanning);
  const std::size_t sent = life.bytes.size();
  life.live(1.3);
  CHECK(life.bytes.size() == sent);
}

TEST_CASE(
    "STATUS names the answer by its digest, of a repeated one too, until the next scan starts") {
  Folder folder;
  std::string told;
  {
    Life life(folder.path);
    CHECK(life.app->health().notice.empty());
    life.scan(scans().work);
    told = life.app->health().notice;
    CHECK(told == answer_mark(life.seams.at(0)));
    seam_t other = life.seams.at(0);
    other.start[2] = 1e-9;
    CHECK(told != answer_mark(other));
    life.state(scans().second.scanning);
    CHECK(life.app->health().notice.empty());
  }
  CHECK(Life(folder.path).app->health().notice == told);
}

TEST_CASE("no background is a reason, and one of another calibration is none") {
  Life life;
  life.scan(scans().work);
  REQUIRE(life.seams.size() == 1);
  CHECK(life.seams[0].verdict == seam_t::REFUSED);
  CHECK_THAT(life.seams[0].reason, Catch::Contains("no background"));
  CHECK_THAT(life.app->health().last_error, Catch::Contains("no background"));

  ScanMessages other = scans().empty;
  for (auto& profile : other.profiles) profile.calibration_id = "calibration-2";
  life.scan(other);
  life.scan(scans().second);
  REQUIRE(life.seams.size() == 3);
  CHECK(life.seams[1].verdict == seam_t::BACKGROUND_STORED);
  CHECK_THAT(life.seams[2].reason, Catch::Contains("no background"));
}

TEST_CASE("an incomplete background does not replace a complete one") {
  Life life;
  life.scan(scans().empty);
  ScanMessages poor = to_messages(ScanCloud{}, {});
  poor = scans().empty;
  for (scan_t* state : {&poor.scanning, &poor.ended}) state->scan_id += kSecond;
  for (auto& profile : poor.profiles) profile.scan_id += kSecond;
  poor.profiles.erase(poor.profiles.begin() + 5, poor.profiles.begin() + 12);
  life.scan(poor);
  life.scan(scans().work);
  REQUIRE(life.seams.size() == 3);
  CHECK_THAT(life.seams[1].reason, Catch::Contains("not complete"));
  REQUIRE(life.seams[2].verdict == seam_t::FOUND);
  CHECK(life.seams[2].background_scan_id == scans().empty.ended.scan_id);
}

TEST_CASE("a restart within a scan is never a wrong seam") {
  // seam_finding is killed at every tenth profile and started anew.
  for (std::size_t killed = 1; killed < scans().work.profiles.size(); killed += 8) {
    Folder folder;
    {
      Life before(folder.path);
      before.scan(scans().empty);
      before.state(scans().work.scanning);
      for (std::size_t i = 0; i < killed; ++i) before.profile(scans().work.profiles[i]);
    }
    Life after(folder.path);
    after.state(scans().work.scanning);
    for (std::size_t i = killed; i < scans().work.profiles.size(); ++i)
      after.profile(scans().work.profiles[i]);
    after.state(scans().work.ended);
    REQUIRE(after.seams.size() == 1);
    const seam_t& seam = after.seams[0];
    CHECK(seam.profiles_lost == static_cast<int>(killed));
    if (seam.verdict == seam_t::FOUND) {
      CHECK(scans().start_error(seam) < 5);
      CHECK_THAT(seam.remark, Catch::Contains("lost on their way"));
    }
    // The next scan is right: the background was found again.
    after.scan(scans().second);
    REQUIRE(after.seams.size() == 2);
    CHECK(after.seams[1].verdict == seam_t::FOUND);
  }
}

TEST_CASE("a restarted sensor_capture refuses the scan, the next is right") {
  Life life;
  life.scan(scans().empty);
  life.state(scans().work.scanning);
  for (int i = 0; i < 20; ++i) life.profile(scans().work.profiles[i]);
  scan_t idle = idle_state(scans().work.scanning.run_id + 30 * kSecond);
  life.state(idle);
  CHECK(life.seams.size() == 1);  // it may be a second one
  idle.utime += 200'000;
  life.state(idle);
  REQUIRE(life.seams.size() == 2);
  CHECK(life.seams[1].verdict == seam_t::REFUSED);
  CHECK_THAT(life.seams[1].reason, Catch::Contains("sensor_capture restarted"));
  CHECK(life.seams[1].scan_id == scans().work.ended.scan_id);
  ScanMessages next = scans().second;
  for (scan_t* state : {&next.scanning, &next.ended}) state->run_id += 30 * kSecond;
  for (auto& profile : next.profiles) profile.run_id += 30 * kSecond;
  life.scan(next);
  REQUIRE(life.seams.size() == 3);
  CHECK(life.seams[2].verdict == seam_t::FOUND);
}

TEST_CASE("a chain that dies ends in a refusal") {
  SeamFindingSettings settings;
  settings.dead_chain_s = 0.5;
  Life life("", settings);
  life.scan(scans().empty);
  SECTION("behind the camera: the scan ends, its profiles do not come") {
    life.state(scans().work.scanning);
    for (int i = 0; i < 10; ++i) life.profile(scans().work.profiles[i]);
    life.state(scans().work.ended);
    for (int i = 0; i < 10; ++i) {
      life.state(scans().work.ended);  // its end is told again and again
      life.live(0.1);
    }
    CHECK_THAT(life.seams.back().reason, Catch::Contains("chain dead: no profile"));
  }
  SECTION("at the camera: no word any more") {
    life.state(scans().work.scanning);
    for (int i = 0; i < 10; ++i) life.profile(scans().work.profiles[i]);
    life.live(1);
    CHECK_THAT(life.seams.back().reason, Catch::Contains("chain dead: no word"));
  }
  CHECK(life.seams.back().verdict == seam_t::REFUSED);
  CHECK(life.seams.back().scan_id == scans().work.ended.scan_id);
  // What comes late is not answered twice.
  const std::size_t sent = life.seams.size();
  for (const auto& profile : scans().work.profiles) life.profile(profile);
  life.state(scans().work.ended);
  CHECK(life.seams.size() == sent);
  life.scan(scans().second);
  CHECK(life.seams.back().verdict == seam_t::FOUND);
}

TEST_CASE("a scan that goes on keeps its chain alive") {
  SeamFindingSettings settings;
  settings.dead_chain_s = 0.5;
  Life life("", settings);
  for (int i = 0; i < 12; ++i) {
    life.state(scans().work.scanning);
    life.live(0.1);
  }
  CHECK(life.seams.empty());
}
