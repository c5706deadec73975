// bench_extraction_bus: a hundred images a second of 1600 x 1200 from sensor_capture's folder
// source through extraction, real processes over multicast, beside a bare subscriber in the same
// run. Run it under scripts/in-private-network.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "common/options.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

std::string write_images() {
  const std::string folder =
      (std::filesystem::temp_directory_path() / fmt::format("arcstart-images-{}", getpid()));
  std::filesystem::create_directories(folder);
  for (int seed = 1; seed <= 8; ++seed)
    cv::imwrite(fmt::format("{}/{}.png", folder, seed),
                render_stripe_scene(stripe_scene_settings(StripeSceneKind::kTypical),
                                    static_cast<std::uint64_t>(seed))
                    .grey);
  return folder;
}

// In the scan, each once.
template <class Messages>
std::size_t heard_of(const Messages& messages, std::int64_t scan_id) {
  std::set<std::int64_t> seqs;
  for (const auto& message : messages)
    if (message.scan_id == scan_id) seqs.insert(message.seq);
  return seqs.size();
}

}  // namespace

int main(int argc, char** argv) {
  Program options("Images a second over the bus through extraction, beside a bare subscriber");
  std::string json_path;
  double seconds = 20, rate = 100;
  options.option("--json", json_path, "Where the figures go, flat JSON");
  options.option("--seconds", seconds, "Of the scan").show_default();
  options.option("--rate", rate, "Images a second").show_default();
  if (const auto code = options.parse(argc, argv)) return *code;

  const std::string folder = write_images();
  RunningCell cell("bench_extraction_bus",
                   {"sensor_capture.source: folder", "sensor_capture.folder: " + folder,
                    fmt::format("sensor_capture.frame_rate_hz: {}", rate),
                    "sensor_capture.exposure_us: 1000", "sensor_capture.end_when_still: false"});
  cell.start("sensor_capture");
  cell.start("extraction");
  const auto running = [&](const std::string& service) {
    return cell.status(service).state == service_status_t::RUNNING;
  };
  const bool ready = cell.listen_until(
      [&] {
        return running("sensor_capture") && running("extraction") && cell.heard().scan.has_value();
      },
      30);
  if (!ready) {
    fmt::print(stderr, "bench_extraction_bus: the services did not come up:\n{}{}",
               cell.log_of("sensor_capture"), cell.log_of("extraction"));
    return 1;
  }
  cell.listen(2);
  const std::int64_t id = cell.command(scan_command_t::START, scan_t::WORKPIECE, seconds);
  const auto ended = [&] {
    return cell.heard().scan && cell.heard().scan->command_id == id &&
           cell.heard().scan->state == scan_t::ENDED;
  };
  cell.listen_until(ended, seconds + 10);
  cell.listen(2);
  std::filesystem::remove_all(folder);
  if (!ended()) {
    fmt::print(stderr, "bench_extraction_bus: the scan did not end:\n{}",
               cell.log_of("sensor_capture"));
    return 1;
  }
  const scan_t& scan = *cell.heard().scan;
  const double duration = 1e-6 * static_cast<double>(scan.end_utime - scan.begin_utime);
  const auto sent = static_cast<std::size_t>(scan.images);
  const std::size_t bare = heard_of(cell.heard().images, scan.scan_id),
                    stripes = heard_of(cell.heard().stripes, scan.scan_id);
  std::size_t empty = 0;
  for (const stripe_t& stripe : cell.heard().stripes)
    empty += stripe.scan_id == scan.scan_id && stripe.count == 0;
  fmt::print(
      "{:.1f} images/s of 1600 x 1200 for {:.1f} s: {} sent ({} lost at the source), {} heard by a "
      "bare subscriber (lost {}),\n{} stripes (lost {}), {} of them empty\n",
      static_cast<double>(sent) / duration, duration, sent, scan.lost, bare, sent - bare, stripes,
      sent - stripes, empty);
  const nlohmann::json json{{"bus.rate_hz", static_cast<double>(sent) / duration},
                            {"bus.sent", sent},
                            {"bus.lost_at_source", scan.lost},
                            {"bus.lost_bare_subscriber", sent - bare},
                            {"bus.lost_extraction", sent - stripes},
                            {"bus.empty", empty}};
  if (!json_path.empty() && !(std::ofstream(json_path) << json.dump(2) << '\n')) {
    fmt::print(stderr, "bench_extraction_bus: {} cannot be written\n", json_path);
    return 1;
  }
  return 0;
}
