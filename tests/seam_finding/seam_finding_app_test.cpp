#include "services/seam_finding/seam_finding_app.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "tests/seam_finding/synthetic_messages.hpp"
#include "tests/seam_finding/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::synthetic;
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kSecond = 1'000'000;

struct Folder {
  fs::path path =
      fs::temp_directory_path() / ("arcstart-seam-finding-" + std::to_string(::getpid()) + "-" +
                                   std::to_string(std::random_device{}()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

// On a busy machine a test's second may last ten: no chain is dead for that.
SeamFindingSettings patient() {
  SeamFindingSettings settings;
  settings.dead_chain_s = 600;
  return settings;
}

// One life of the service on a bus in memory; what it says is kept with its bytes.
struct Life {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  SeamFindingSettings settings;
  std::unique_ptr<SeamFindingApp> app;
  std::vector<seam_t> seams;
  std::vector<Bus::Bytes> bytes;

  explicit Life(const std::string& state_folder = "", SeamFindingSettings wanted = patient())
      : settings(wanted) {
    bus->subscribe<seam_t>("LASER0_SEAM", Queue::measurements(), [this](const seam_t& seam) {
      seams.push_back(seam);
      Bus::Bytes encoded(static_cast<std::size_t>(seam.getEncodedSize()));
      seam.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
      bytes.push_back(encoded);
    });
    app = std::make_unique<SeamFindingApp>(*bus, settings,
                                           Instance{"LASER0", "ROBOT0", state_folder});
  }
  void handle() {
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
  }
  void state(const scan_t& message) {
    bus->publish("LASER0_SCAN", message);
    handle();
  }
  void profile(const profile_t& message) {
    bus->publish("LASER0_PROFILE", message);
    handle();
  }
  void scan(const ScanMessages& messages) {
    state(messages.scanning);
    for (const auto& one : messages.profiles) profile(one);
    state(messages.ended);
  }
  // Calls tick as the service's shell does, for so long.
  void live(double seconds) {
    for (int i = 0; i < seconds * 20; ++i) {
      app->tick(0);
      handle();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
};

// Background and workpiece scans of one scene, some seconds apart.
struct Scans {
  Scene scene = make_scene({.tool = true}, 21);
  ScanMessages empty, work, second;
  Scans() {
    Scene cell = scene;
    cell.boxes.clear();
    ScanIdentity identity;
    identity.kind = scan_t::BACKGROUND;
    empty = to_messages(make_scan(cell, {}, 2).cloud, identity);
    identity.kind = scan_t::WORKPIECE;
    identity.scan_id += 20 * kSecond;
    identity.first_seq += 400;
    work = to_messages(make_scan(scene, {}, 1).cloud, identity);
    identity.scan_id += 20 * kSecond;
    identity.first_seq += 400;
    second = to_messages(make_scan(scene, {}, 3).cloud, identity);
  }
  double start_error(const seam_t& seam) const {
    return (Eigen::Map<const Eigen::Vector3d>(seam.start) - scene.start).norm();
  }
};

const Scans& scans() {
  static const Scans made;
  return made;
}

}  // namespace

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

TEST_CASE("a restarted sensor_capture refuses the scan, the next is right") {
  Life life;
  life.scan(scans().empty);
  life.state(scans().work.scanning);
  for (int i = 0; i < 20; ++i) life.profile(scans().work.profiles[i]);
  life.state(idle_state(scans().work.scanning.run_id + 30 * kSecond));
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
