// One live scan, slow and small enough for processes under sanitizers.
#include <catch2/catch.hpp>

#include "services/command_line/output/seam_error.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;
using namespace arcstart::command_line;

TEST_CASE("a live scan at 2 frames a second and 400 x 300") {
  RunningCell cell("slow_scan",
                   {"cell_simulator.image_width_px: 400", "cell_simulator.image_height_px: 300",
                    "cell_simulator.frame_rate_hz: 2", "sensor_capture.frame_rate_hz: 2",
                    "cell_simulator.search_speed_mm_s: 7.2", "cell_simulator.seed: 31",
                    "reconstruction.keep_every: 4"});
  cell.start_all();
  REQUIRE(cell.wait_until_ready(60));
  const auto background = cell.scan(scan_t::BACKGROUND, 60);
  REQUIRE(background);
  CHECK(background->verdict == seam_t::BACKGROUND_STORED);
  REQUIRE(cell.change_scene(true, 31));
  const auto seam = cell.scan(scan_t::WORKPIECE, 60);
  REQUIRE(seam);
  INFO(seam->reason);
  REQUIRE(seam->verdict == seam_t::FOUND);
  CHECK_FALSE(seam_error(*seam, *cell.heard().truth).wrong);
  CHECK(seam->profiles_lost == 0);
  for (const auto& service : RunningCell::services()) {
    cell.terminate(service);
    INFO(service << ": " << cell.log_of(service));
    CHECK(cell.process(service).wait(10) == 0);
    CHECK(cell.log_of(service).find("Sanitizer") == std::string::npos);
    CHECK(cell.log_of(service).find("runtime error") == std::string::npos);
  }
}
