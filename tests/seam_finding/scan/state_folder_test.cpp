// What seam_finding keeps on disk: backgrounds and answers, over restarts, damage and a full disk.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "services/seam_finding/scan/scan_store.hpp"
#include "services/seam_finding/seam_finding_app.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"
#include "tests/seam_finding/scan/service_life.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

TEST_CASE("after a restart the answer is repeated and no scan answered twice") {
  Folder folder;
  Bus::Bytes first;
  {
    Life life(folder.path);
    life.scan(scans().empty);
    life.scan(scans().work);
    first = life.bytes.back();
  }
  Life life(folder.path);
  life.scan(scans().work);  // told again, for whatever reason
  CHECK(life.seams.empty());
  life.live(1.3);
  REQUIRE_FALSE(life.bytes.empty());
  CHECK(life.bytes.front() == first);
  // It does not speak over a scan that runs.
  Life other(folder.path);
  other.state(scans().second.scanning);
  other.live(1.3);
  CHECK(other.bytes.empty());
}

TEST_CASE("old backgrounds and answers go, the newest stay") {
  Folder folder;
  SeamFindingSettings settings;
  settings.backgrounds_kept = 2;
  settings.results_kept = 3;
  ScanMessages empty = scans().empty;
  Life life(folder.path, settings);
  for (int i = 0; i < 5; ++i) {
    life.scan(empty);
    for (scan_t* state : {&empty.scanning, &empty.ended}) state->scan_id += kSecond;
    for (auto& profile : empty.profiles) profile.scan_id += kSecond;
  }
  int backgrounds = 0, seams = 0, others = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path)) {
    const std::string name = entry.path().filename();
    if (entry.is_directory()) continue;
    backgrounds += name.starts_with("background-");
    seams += name.starts_with("seam-");
    others += !name.starts_with("background-") && !name.starts_with("seam-");
  }
  CHECK(backgrounds == 2);
  CHECK(seams == 3);
  CHECK(others == 0);
}

// All of a scan, told as of another time.
ScanMessages at(ScanMessages scan, std::int64_t shift) {
  for (scan_t* state : {&scan.scanning, &scan.ended}) state->scan_id += shift;
  for (auto& profile : scan.profiles) profile.scan_id += shift;
  return scan;
}

TEST_CASE("a clock that was a day ahead and is set right costs neither order nor background") {
  constexpr std::int64_t kDay = 86'400 * kSecond;
  Folder folder;
  SeamFindingSettings settings = patient();
  settings.backgrounds_kept = 2;
  settings.results_kept = 3;
  Bus::Bytes newest;
  {
    Life life(folder.path, settings);
    for (int i = 0; i < 4; ++i) life.scan(at(scans().empty, kDay + i * kSecond));
    life.scan(scans().empty);
    newest = life.bytes.back();
  }
  Life life(folder.path, settings);
  life.live(1.3);
  REQUIRE_FALSE(life.bytes.empty());
  CHECK(life.bytes.front() == newest);
  life.scan(scans().work);  // today's background is still there
  CHECK(life.seams.back().verdict == seam_t::FOUND);
  CHECK(life.seams.back().background_scan_id == scans().empty.ended.scan_id);
}

TEST_CASE("files of former names are read, and are older than all others") {
  Folder folder;
  {
    Life life(folder.path);
    life.scan(scans().empty);
    life.scan(scans().work);
  }
  const fs::path stored = folder.path / "LASER0-ROBOT0";
  const auto rename = [&](const std::string& prefix, std::int64_t scan_id) {
    const std::string number = std::to_string(scan_id);
    const std::string end = "-" + std::string(20 - number.size(), '0') + number + ".lcm";
    fs::rename(stored / (prefix + "-00000001" + end), stored / (prefix + end));
  };
  rename("background", scans().empty.ended.scan_id);
  rename("seam", scans().empty.ended.scan_id);
  Life life(folder.path);
  life.scan(scans().empty);  // answered already
  CHECK(life.seams.empty());
  life.scan(scans().second);
  CHECK(life.seams.back().verdict == seam_t::FOUND);
}

TEST_CASE("a damaged state folder costs what is damaged, not the service") {
  Folder folder;
  {
    Life life(folder.path);
    life.scan(scans().empty);
  }
  std::string background;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path))
    if (entry.path().filename().string().starts_with("background-")) background = entry.path();
  REQUIRE_FALSE(background.empty());
  SECTION("cut off") { fs::resize_file(background, fs::file_size(background) / 2); }
  SECTION("not a log") { std::ofstream(background) << "nothing of the kind"; }
  SECTION("empty") { std::ofstream(background).close(); }
  Life life(folder.path);
  life.scan(scans().work);
  REQUIRE(life.seams.size() == 1);
  CHECK_THAT(life.seams[0].reason, Catch::Contains("no background"));
  life.scan(scans().second);
  CHECK(life.seams.size() == 2);
}

TEST_CASE("a full disk is told, and costs no answer") {
  Folder folder;
  Life life(folder.path);
  // No file may grow: as on a full disk every write fails.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit none = old;
  none.rlim_cur = 0;
  setrlimit(RLIMIT_FSIZE, &none);
  life.scan(scans().empty);
  life.scan(scans().work);
  setrlimit(RLIMIT_FSIZE, &old);
  REQUIRE(life.seams.size() == 2);
  CHECK(life.seams[0].verdict == seam_t::BACKGROUND_STORED);
  CHECK_THAT(life.seams[0].remark, Catch::Contains("kept in memory alone"));
  CHECK(life.seams[1].verdict == seam_t::FOUND);
  CHECK(life.app->health().state == service_status_t::FAULT);
  CHECK_THAT(life.app->health().last_error, Catch::Contains("free some space"));
  // With space again the next background mends it.
  ScanMessages again = scans().empty;
  for (scan_t* state : {&again.scanning, &again.ended}) state->scan_id += kSecond;
  for (auto& profile : again.profiles) profile.scan_id += kSecond;
  life.scan(again);
  CHECK(life.app->health().state == service_status_t::RUNNING);
}

TEST_CASE("a folder that cannot be made stops the service with what to do") {
  Folder folder;
  const std::string file = folder.path / "file";
  std::ofstream(file) << "in the way";
  const auto bus = Bus::in_memory();
  CHECK_THROWS_AS(SeamFindingApp(*bus, {}, Instance{"LASER0", "ROBOT0", file}), ScanStoreError);
}
