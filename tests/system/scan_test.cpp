// Scans of a running cell: the right seam, nothing lost, in time, the same on replay. Where the
// machine did not keep up, what is lost is no fault, and is reported; an answer is right all the
// same or there is none.
#include <catch2/catch.hpp>
#include <csignal>
#include <set>

#include "paths.hpp"
#include "services/command_line/output/seam_error.hpp"
#include "services/command_line/output/seam_json.hpp"
#include "services/command_line/recordings/replay.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;
using namespace arcstart::command_line;

namespace {

template <class Messages>
std::set<std::int32_t> indices_of(const Messages& messages, std::int64_t scan_id) {
  std::set<std::int32_t> indices;
  for (const auto& message : messages)
    if (message.scan_id == scan_id) indices.insert(message.scan_index);
  return indices;
}

void check_right(const seam_t& seam, const truth_t& truth) {
  INFO(seam.reason << " " << seam.remark);
  REQUIRE(seam.verdict == seam_t::FOUND);
  const SeamError error = seam_error(seam, truth);
  CHECK_FALSE(error.wrong);
  CHECK(error.lateral_mm < 0.15);
  CHECK(error.direction_deg < 0.1);
  CHECK(error.start_mm < 8);
}

}  // namespace

TEST_CASE("five scans in a row: the right seam, in time, and nothing lost") {
  RunningCell cell("scans");
  const std::string recording = cell.folder() + "/recording.lcm";
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  Process logger(
      {std::string(ARCSTART_SOURCE) + "/scripts/record", "-o", recording, "--free-mb", "200"},
      cell.folder() + "/record.log");
  cell.listen(1);

  const auto background = cell.scan(scan_t::BACKGROUND);
  ARCSTART_REQUIRE_OF(cell, background && background->verdict == seam_t::BACKGROUND_STORED);
  bool kept_up = true;
  cell.machine_kept_up();
  for (int scan = 0; scan < 4; ++scan) {
    ARCSTART_REQUIRE_OF(cell, cell.change_scene(true, 11 + scan));
    const auto seam = cell.scan(scan_t::WORKPIECE);
    const bool busy = !cell.machine_kept_up();
    kept_up &= !busy;
    if (busy) {
      WARN("scan " << scan << ": the machine did not keep up; what is lost is not judged");
      if (seam && seam->verdict == seam_t::FOUND)
        CHECK_FALSE(seam_error(*seam, *cell.heard().truth).wrong);
      else if (seam)
        CHECK_FALSE(seam->reason.empty());
      continue;
    }
    REQUIRE(seam);
    check_right(*seam, *cell.heard().truth);
    CHECK(seam->images_lost == 0);
    CHECK(seam->profiles_lost == 0);
    CHECK(seam->background_scan_id == background->scan_id);
    // Image published to seam heard, both as this process hears them.
    const std::int64_t delay =
        cell.heard().seam_heard.at(seam->scan_id) - cell.heard().image_heard.at(seam->scan_id);
    WARN("scan " << scan << ": seam " << delay / 1000 << " ms after the last image");
    REQUIRE(cell.heard().scan);
    const auto images = static_cast<std::size_t>(cell.heard().scan->images);
    CHECK(images > 40);
    CHECK(indices_of(cell.heard().images, seam->scan_id).size() == images);
    CHECK(indices_of(cell.heard().stripes, seam->scan_id).size() == images);
    CHECK(indices_of(cell.heard().profiles, seam->scan_id).size() == images);
  }
  for (const auto& [service, status] : cell.heard().statuses) {
    INFO(service << ": " << status.last_error);
    if (kept_up) CHECK(status.lost == 0);
    CHECK(status.undecodable == 0);
    WARN(service << ": peak memory " << status.peak_memory / 1000000 << " MB");
    if (service != "cell_simulator") CHECK(status.peak_memory < 250'000'000);
  }
  const auto& poses = cell.heard().poses;
  REQUIRE(poses.size() > 100);
  if (kept_up)
    CHECK(poses.back().seq - poses.front().seq + 1 == static_cast<std::int64_t>(poses.size()));
  cell.listen(1.5);
  logger.send(SIGINT);
  CHECK(logger.wait(10) == 0);

  // Replayed: the same answers byte by byte, twice, and as the live run gave them.
  const auto answers = [](const ReplayResult& result) {
    std::vector<std::vector<std::uint8_t>> bytes;
    for (const auto& seam : result.seams) bytes.push_back(seam.bytes);
    return bytes;
  };
  const auto once = answers(replay_recordings({recording}));
  CHECK(once == answers(replay_recordings({recording})));
  // What the logger did not hear it cannot give back.
  if (kept_up) CHECK(once == cell.heard().seam_bytes);
}

TEST_CASE("lcm-logplayer into live services gives what replay in process gives") {
  const std::string source = ARCSTART_SOURCE, recording = source + "/logs/tool_50.lcm";
  const Output played = run({source + "/scripts/replay", recording}, 90);
  INFO(played.err);
  CHECK(played.code == 0);
  std::string expected;
  for (const ReplayedSeam& seam : replay_recordings({recording}).seams)
    expected += seam_to_json_line(seam.seam) + "\n";
  CHECK(played.out == expected);
}
