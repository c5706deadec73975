// arcstart time-offset and arcstart check: recordings in, figures out, exit codes.
#include <sys/wait.h>
#include <unistd.h>

#include <arcstart/robot_pose_t.hpp>
#include <arcstart/scan_t.hpp>
#include <arcstart/stripe_t.hpp>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/bus/calibration_message.hpp"
#include "common/bus/event_log.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "tests/bench/calibration/simulated_sweeps.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::cell_simulator;
using namespace arcstart::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

stripe_t stripe_message(const SweepProfile& stripe, std::int64_t seq) {
  stripe_t message{};
  message.utime = stripe.utime;
  message.run_id = stripe.scan_id - 1'000'000;  // each recording a start of its own
  message.seq = seq;
  message.scan_id = stripe.scan_id;
  message.scan_index = static_cast<std::int32_t>(seq);
  message.sensor_width = 800;
  message.sensor_height = 600;
  for (std::size_t s = 0; s < stripe.segments.size(); ++s)
    for (const Eigen::Vector2d& centre : stripe.segments[s]) {
      message.u.push_back(static_cast<float>(centre.x()));
      message.v.push_back(static_cast<float>(centre.y()));
      message.segment.push_back(static_cast<std::int16_t>(s));
    }
  message.count = static_cast<std::int32_t>(message.u.size());
  message.strength.assign(message.u.size(), 100);
  message.width.assign(message.u.size(), 2);
  message.deviation.assign(message.u.size(), 0.05f);
  message.rank.assign(message.u.size(), stripe_t::CHOSEN);
  message.segment_end.assign(message.u.size(), stripe_t::CONTINUES);
  if (message.count == 0) message.why = stripe_t::NO_STRIPE;
  return message;
}

// A folder of recordings, as lcm-logger would have written them.
struct Recordings {
  Recordings() {
    fs::remove_all(root);
    fs::create_directories(root);
  }
  ~Recordings() { fs::remove_all(root); }

  void save(const std::string& name, const SimulatedSweepsSettings& settings, std::uint64_t seed,
            const Calibration& calibration, bool with_poses = true) const {
    SweepData record;
    append_sweeps(record, settings, seed);
    EventLogWriter log((root / name).string());
    log.write(1, "LASER0_CALIBRATION", encoded(to_message(calibration)));
    const std::int64_t begin = record.stripes.front().utime - 500'000,
                       end = record.stripes.back().utime + 200'000;
    std::int64_t seq = 0;
    for (std::int64_t t = begin; with_poses && t < end; t += 20'000) {
      const auto lookup = record.trajectory.at(t);
      if (lookup.state != reconstruction::TrajectoryQueue::State::found) continue;
      robot_pose_t pose{};
      pose.utime = pose.arrival_utime = t;
      pose.run_id = begin;
      pose.seq = seq++;
      transform_to_arrays(lookup.T_base_tool, pose.position, pose.quaternion);
      log.write(t, "ROBOT0_POSE", encoded(pose));
    }
    seq = 0;
    for (const SweepProfile& stripe : record.stripes)
      log.write(stripe.utime, "LASER0_STRIPE", encoded(stripe_message(stripe, seq++)));
    log.close();
  }

  struct Outcome {
    int code;
    std::string out, err;
  };
  Outcome run(const std::string& arguments) const {
    const std::string command =
        "cd " + root.string() + " && " ARCSTART_PROGRAM " " + arguments + " >out 2>err";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of("out"), text_of("err")};
  }
  std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(root / name, std::ios::binary).rdbuf();
    return text.str();
  }

  const fs::path root =
      fs::temp_directory_path() / ("arcstart_sweep_commands_test_" + std::to_string(getpid()));
};

SimulatedSweepsSettings small_sweeps() {
  SimulatedSweepsSettings settings;
  settings.sensor.image_width_px = 800;
  settings.sensor.image_height_px = 600;
  return settings;
}

}  // namespace

TEST_CASE("a recording of sweeps gives the time offset and the calibration with it") {
  const Recordings folder;
  SimulatedSweepsSettings settings = small_sweeps();
  settings.scene.search_rise_mm = 100;
  Calibration calibration = true_calibration(settings);
  calibration.time_offset = 0;
  folder.save("sweeps.lcm", settings, 711, calibration);
  const auto outcome = folder.run("time-offset sweeps.lcm -o made.yaml --json");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_THAT(outcome.err, Contains("standard deviation"));
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json["time_offset"].get<double>() == Approx(-0.02732).margin(1e-3));
  CHECK(json["deviation"].get<double>() < 0.5e-3);
  CHECK(json["residual_as_it_was"].get<double>() > 3 * json["residual"].get<double>());
  CHECK(json["sweeps"].size() == 4);
  const Calibration made = read_calibration_file((folder.root / "made.yaml").string());
  CHECK(made.time_offset == Approx(json["time_offset"].get<double>()));
  CHECK(made.T_tool_camera.isApprox(calibration.T_tool_camera, 1e-9));
  CHECK_THAT(made.origin, Contains("time offset from"));

  // From that file again: nothing is left to mend.
  const auto again = folder.run("time-offset sweeps.lcm --calibration made.yaml --json");
  REQUIRE(again.code == 0);
  const auto repeated = nlohmann::json::parse(again.out);
  CHECK(repeated["time_offset"].get<double>() == Approx(made.time_offset).margin(2e-5));
  CHECK(repeated["residual_as_it_was"].get<double>() ==
        Approx(repeated["residual"].get<double>()).epsilon(0.01));
}

TEST_CASE("sweeps that tell nothing, and recordings that lack something, are said") {
  const Recordings folder;
  SimulatedSweepsSettings settings = small_sweeps();
  settings.speeds_mm_s = {100, 100};
  const Calibration calibration = true_calibration(settings);
  folder.save("level.lcm", settings, 712, calibration);
  const auto level = folder.run("time-offset level.lcm -o made.yaml");
  CHECK(level.code == 1);
  CHECK_THAT(level.err, Contains("parallel to the motion"));
  CHECK_FALSE(fs::exists(folder.root / "made.yaml"));
  folder.save("no_poses.lcm", settings, 712, calibration, false);
  for (const std::string command : {"time-offset", "check"}) {
    const auto outcome = folder.run(command + " no_poses.lcm");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("ROBOT0_POSE"));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(folder.run(command + " missing.lcm").code == 2);
    CHECK(folder.run(command).code == 2);
    CHECK(folder.run(command + " --help").code == 0);
    std::ofstream(folder.root / "torn.yaml") << "id: 1\n";
    CHECK(folder.run(command + " level.lcm --calibration torn.yaml").code == 2);
  }
  Calibration other = calibration;
  other.sensor = "LASER7";
  std::ofstream(folder.root / "other.yaml") << calibration_file_text(other);
  CHECK(folder.run("check level.lcm --calibration other.yaml").code == 2);
}

TEST_CASE("recordings of a ball from two sides pass a calibration, or sound the alarm") {
  const Recordings folder;
  SimulatedSweepsSettings settings = small_sweeps();
  settings.kind = SceneKind::workpiece;
  settings.scene.ball_radius_mm = 20;
  settings.scene.search_begin_mm = -50;
  settings.scene.search_end_mm = 50;
  settings.speeds_mm_s = {30};
  Calibration calibration = true_calibration(settings);
  folder.save("one.lcm", settings, 721, calibration);
  settings.scene.search_turn_deg = 180;
  settings.begin_utime += 60'000'000;
  folder.save("other.lcm", settings, 721, calibration);
  const auto good = folder.run("check one.lcm other.lcm --sphere-radius 20 --json");
  INFO(good.err);
  CHECK(good.code == 0);
  CHECK_THAT(good.err, Contains("holds"));
  const auto json = nlohmann::json::parse(good.out);
  CHECK(json["error"].get<double>() < 0.1);
  CHECK(json["limit"] == 0.3);
  CHECK(json["scans"].size() == 2);

  std::ofstream(folder.root / "cell.yaml") << "calibration: {check_mm: 0.01}\n";
  const auto strict = folder.run("check one.lcm other.lcm --sphere-radius 20 --cell cell.yaml");
  CHECK(strict.code == 1);
  CHECK_THAT(strict.err, Contains("DRIFTED") && Contains("0.01 mm"));

  calibration.T_tool_camera.pretranslate(Eigen::Vector3d(1, 0, 0));
  std::ofstream(folder.root / "knocked.yaml") << calibration_file_text(calibration);
  const auto knocked =
      folder.run("check one.lcm other.lcm --sphere-radius 20 --calibration knocked.yaml");
  CHECK(knocked.code == 1);
  CHECK_THAT(knocked.err, Contains("HAS DRIFTED"));
  const auto faces = folder.run("check one.lcm --json");
  CHECK(faces.code == 1);
  CHECK_THAT(faces.err, Contains("one side"));
}
