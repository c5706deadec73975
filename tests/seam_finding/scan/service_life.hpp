// seam_finding's app on a bus in memory, and scans for it.
#pragma once

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "services/seam_finding/seam_finding_app.hpp"
#include "tests/seam_finding/support/synthetic_messages.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

namespace arcstart::seam_finding::synthetic {

namespace fs = std::filesystem;

constexpr std::int64_t kSecond = 1'000'000;

struct Folder {
  fs::path path =
      fs::temp_directory_path() / ("arcstart-seam-finding-" + std::to_string(::getpid()) + "-" +
                                   std::to_string(std::random_device{}()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

// On a busy machine a test's second may last ten: no chain is dead for that.
inline SeamFindingSettings patient() {
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

  explicit Life(const std::string& state_folder = "", SeamFindingSettings wanted = patient(),
                const std::optional<JobBook>& jobs = {})
      : settings(wanted) {
    bus->subscribe<seam_t>("LASER0_SEAM", Queue::measurements(), [this](const seam_t& seam) {
      seams.push_back(seam);
      Bus::Bytes encoded(static_cast<std::size_t>(seam.getEncodedSize()));
      seam.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
      bytes.push_back(encoded);
    });
    app = std::make_unique<SeamFindingApp>(
        *bus, settings, Instance{"LASER0", "ROBOT0", state_folder}, jobs.value_or(JobBook(wanted)));
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

inline const Scans& scans() {
  static const Scans made;
  return made;
}

}  // namespace arcstart::seam_finding::synthetic
