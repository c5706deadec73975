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
