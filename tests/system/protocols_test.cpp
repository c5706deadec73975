// The same scan by each protocol of the robot: the same seam.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "services/command_line/output/seam_error.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;
using namespace arcstart::command_line;

namespace {

using Changes = std::vector<std::string>;

// The arm that speaks all three at once, its positions without noise: what is left between two
// scans of one scene are the protocols and their clocks.
RunningCell cell_of_protocols(const std::string& name, Changes changes = {}) {
  changes.insert(
      changes.end(),
      {"cell_simulator.image_width_px: 800", "cell_simulator.image_height_px: 600",
       "cell_simulator.j519_port: 60025", "cell_simulator.rtde_port: 30004",
       "cell_simulator.position_noise_mm: 0", "robot_pose.controller_address: 127.0.0.1"});
  return RunningCell(name, changes);
}

const Changes kHspo = {"robot_pose.protocol: hspo", "robot_pose.port: 60015"};
const Changes kJ519 = {"robot_pose.protocol: j519", "robot_pose.controller_port: 60025",
                       "robot_pose.port: 60016"};
const Changes kRtde = {"robot_pose.protocol: rtde", "robot_pose.controller_port: 30004"};

void take_positions_by(RunningCell& cell, const Changes& protocol) {
  cell.terminate("robot_pose");
  cell.change(protocol);
  cell.start("robot_pose");
  REQUIRE(cell.wait_until_ready());
}

seam_t scanned(RunningCell& cell, std::int8_t source) {
  const auto seam = cell.scan(scan_t::WORKPIECE);
  REQUIRE(seam);
  INFO(seam->reason << " " << cell.status("robot_pose").last_error);
  REQUIRE(seam->verdict == seam_t::FOUND);
  CHECK(seam->profiles_lost == 0);
  CHECK(cell.heard().poses.back().source == source);
  CHECK(cell.status("robot_pose").lost == 0);
  CHECK(cell.status("robot_pose").undecodable == 0);
  return *seam;
}

Eigen::Vector3d place(const double (&p)[3]) { return {p[0], p[1], p[2]}; }
Eigen::Matrix3d covariance(const double (&c)[3][3]) {
  return Eigen::Map<const Eigen::Matrix3d>(&c[0][0]);
}

// One end of a seam in two answers to one scene; mm. The search goes along the seam at 50 mm/s, so
// that what is not known of the clocks, on a busy machine up to 1 ms, moves an end along it by
// 0.05 mm, and nothing across. Noise moves it across by what the answers say, and along by what two
// ends that are off by 0.03 mm each can differ (the deviations that an answer gives along the seam
// are wider, for they hold where an end is hidden, too).
void check_same_end(const Eigen::Vector3d& apart, const Eigen::Vector3d& along,
                    const Eigen::Matrix3d& noise) {
  const double moved = std::abs(apart.dot(along)), across = apart.cross(along).norm();
  const double across_variance = std::max(noise.trace() - along.dot(noise * along), 0.);
  WARN(moved << " mm along, " << across << " mm across from HSPO's");
  CHECK(across < 0.02 + 3 * std::sqrt(across_variance));
  CHECK(moved < 0.02 + 0.05 + (across_variance > 0 ? 3 * std::sqrt(2) * 0.03 : 0));
}

void check_same(const seam_t& seam, const seam_t& expected, bool noisy) {
  const Eigen::Vector3d along = place(expected.direction);
  const double share = noisy ? 1 : 0;
  check_same_end(
      place(seam.start) - place(expected.start), along,
      share * (covariance(seam.start_covariance) + covariance(expected.start_covariance)));
  check_same_end(place(seam.end) - place(expected.end), along,
                 share * (covariance(seam.end_covariance) + covariance(expected.end_covariance)));
}

}  // namespace

TEST_CASE("a scan by HSPO, J519 and RTDE: one seam") {
  RunningCell cell = cell_of_protocols("protocols", kHspo);
  cell.start_all();
  REQUIRE(cell.wait_until_ready());
  const auto background = cell.scan(scan_t::BACKGROUND);
  REQUIRE(background);
  INFO(background->reason);
  REQUIRE(background->verdict == seam_t::BACKGROUND_STORED);
  REQUIRE(cell.change_scene(true, 31));
  const seam_t by_hspo = scanned(cell, robot_pose_t::HSPO);
  CHECK_FALSE(seam_error(by_hspo, *cell.heard().truth).wrong);
  take_positions_by(cell, kJ519);
  check_same(scanned(cell, robot_pose_t::J519), by_hspo, /*noisy=*/false);
  take_positions_by(cell, kRtde);
  check_same(scanned(cell, robot_pose_t::RTDE), by_hspo, /*noisy=*/false);
}

TEST_CASE("the hand fixed in the flange, older and faster forms, with noise: the same seam",
          "[long]") {
  const Changes by_flange = {"cell_simulator.j519_tool: false", "cell_simulator.j519_version: 3"};
  RunningCell cell = cell_of_protocols("protocols_long", by_flange);
  cell.change({"cell_simulator.position_noise_mm: 0.02"});
  cell.start_all();
  REQUIRE(cell.wait_until_ready());
  REQUIRE(cell.scan(scan_t::BACKGROUND));
  // As cell_simulator_settings.hpp has it: the calibration's tool in the flange.
  const std::string tool = "robot_pose.tool_in_flange: [31.5, -4.2, 297.8, 1.3, 28.4, -2.1]";
  for (const std::int64_t seed : {41, 42, 43}) {
    REQUIRE(cell.change_scene(true, seed));
    Changes hspo = kHspo, j519 = kJ519, rtde = kRtde;
    hspo.push_back("robot_pose.tool_in_flange: []");
    j519.push_back(tool);
    rtde.push_back(tool);
    rtde.push_back("robot_pose.rate_hz: 500");
    take_positions_by(cell, hspo);
    const seam_t by_hspo = scanned(cell, robot_pose_t::HSPO);
    take_positions_by(cell, j519);
    check_same(scanned(cell, robot_pose_t::J519), by_hspo, /*noisy=*/true);
    take_positions_by(cell, rtde);
    check_same(scanned(cell, robot_pose_t::RTDE), by_hspo, /*noisy=*/true);
  }
}
