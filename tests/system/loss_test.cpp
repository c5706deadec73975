// A cell over a bad link: extraction, reconstruction and seam_finding hear the devices through a
// relay that loses, doubles and delays their messages. Whatever is lost: no wrong seam, an answer
// or a refusal in time, and never "chain dead" while the chain lives.
#include <fmt/core.h>

#include <catch2/catch.hpp>

#include "common/time.hpp"
#include "services/command_line/output/seam_error.hpp"
#include "tests/system/lossy_relay.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;

namespace {

constexpr int kNear = 7667, kFar = 7668;
constexpr double kAnswered = 2;  // s after the scan's end

struct Fault {
  const char* name;
  LinkFaults faults;
  bool link_goes_down;
};

const Fault kFaults[] = {
    {"1 % lost", {.lost = 0.01}, false},
    {"5 % lost", {.lost = 0.05}, false},
    {"10 % doubled", {.doubled = 0.1}, false},
    {"5 % overtaken, by up to 150 ms", {.delayed = 0.05, .delay_us = 150'000}, false},
    {"all 50 ms late", {.delayed = 1, .delay_us = 50'000}, false},
    {"link down for 1 s within the scan", {}, true}};

struct LossyCell {
  RunningCell cell{"loss",
                   {"cell_simulator.image_width_px: 400", "cell_simulator.image_height_px: 300",
                    "sensor_capture.silent_periods: 100", "reconstruction.keep_every: 4"}};
  LossyRelay relay{kNear, kFar, 17};

  bool start() {
    for (const std::string service :
         {"cell_simulator", "calibration", "robot_pose", "sensor_capture"})
      cell.start(service);
    if (!cell.wait_until_ready()) return false;  // they have read their settings
    cell.change({fmt::format("bus.port: {}", kFar)});
    for (const std::string service : {"extraction", "reconstruction", "seam_finding"})
      cell.start(service);
    return cell.listen_until(
        [&] {
          for (const auto& service : RunningCell::services())
            if (cell.status(service).pid == 0 ||
                cell.status(service).state > service_status_t::DEGRADED)
              return false;
          return !cell.heard().poses.empty() && cell.heard().scan.has_value();
        },
        60);
  }
  // Its answer, and how long after the scan's end it came, s; nothing where none came.
  std::optional<seam_t> scan(std::int8_t kind, const Fault& fault, double& after) {
    const std::int64_t id = cell.begin_scan(kind);
    if (id == 0) return {};
    relay.set(fault.faults);
    if (fault.link_goes_down) {
      cell.listen(1);
      relay.take_down(1'000'000);
    }
    std::int64_t ended = 0;
    const bool answered = cell.listen_until(
        [&] {
          if (ended == 0 && cell.heard().scan->state == scan_t::ENDED &&
              cell.heard().scan->scan_id == id)
            ended = steady_now();
          return cell.seam_of(id).has_value();
        },
        40);
    relay.set({});
    after = static_cast<double>(steady_now() - (ended == 0 ? steady_now() : ended)) * 1e-6;
    return answered ? cell.seam_of(id) : std::nullopt;
  }
};

}  // namespace

TEST_CASE("what a link loses, doubles or delays gives no wrong seam and no silence", "[long]") {
  constexpr int kScans = 3;  // of each fault
  LossyCell lossy;
  ARCSTART_REQUIRE_OF(lossy.cell, lossy.start());
  REQUIRE(lossy.cell.change_scene(false, 1));
  double after = 0;
  const Fault none{"none", {}, false};
  const auto background = lossy.scan(scan_t::BACKGROUND, none, after);
  ARCSTART_REQUIRE_OF(lossy.cell, background && background->verdict == seam_t::BACKGROUND_STORED);
  REQUIRE(lossy.cell.change_scene(true, 1));
  for (const Fault& fault : kFaults) {
    int found = 0, refused = 0;
    double latest = 0;
    for (int k = 0; k < kScans; ++k) {
      lossy.cell.machine_kept_up();
      const std::int64_t lost = lossy.relay.lost() + lossy.relay.doubled();
      const auto seam = lossy.scan(scan_t::WORKPIECE, fault, after);
      INFO(fault.name << ", scan " << k << ", messages lost or doubled "
                      << lossy.relay.lost() + lossy.relay.doubled() - lost);
      ARCSTART_REQUIRE_OF(lossy.cell, seam);
      INFO(seam->reason);
      latest = std::max(latest, after);
      if (seam->verdict == seam_t::FOUND) {
        ++found;
        CHECK_FALSE(command_line::seam_error(*seam, *lossy.cell.heard().truth).wrong);
        if (fault.link_goes_down) CHECK(seam->profiles_lost > 0);
      } else {
        ++refused;
        CHECK(seam->refusal != seam_t::NO_PROFILES);
        CHECK(seam->refusal != seam_t::SENSOR_CAPTURE_SILENT);
        CHECK(seam->refusal < seam_t::STOP);
      }
      if (lossy.cell.machine_kept_up()) CHECK(after <= kAnswered);
    }
    fmt::print("{:<34} {} found and right, {} refused, answered {:.2f} s after the end at most\n",
               fault.name, found, refused, latest);
  }
}
