// The whole pipeline on recordings made here in closed form: the Tee's seam is known without it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "common/geometry.hpp"
#include "common/jobs/job_file.hpp"
#include "tests/command_line/recordings/replay_checks.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

struct SeamError {
  double lateral_mm, along_mm, direction_deg;
};
SeamError error_of(const seam_t& seam) {
  const Eigen::Vector3d direction = (kSeamEnd - kSeamStart).normalized();
  const Eigen::Vector3d error = Eigen::Map<const Eigen::Vector3d>(seam.start) - kSeamStart;
  const double along = error.dot(direction);
  return {(error - along * direction).norm(), along,
          angle_between(Eigen::Map<const Eigen::Vector3d>(seam.direction), direction) * 180 / M_PI};
}

void check_found(const ReplayResult& result, double lateral_mm, double direction_deg) {
  REQUIRE(result.seams.size() == 2);
  CHECK(result.seams[0].kind == scan_t::BACKGROUND);
  CHECK(result.seams[0].seam.scan_id == kBackgroundScan);
  CHECK(result.seams[0].seam.verdict == seam_t::BACKGROUND_STORED);
  const seam_t& seam = result.seams[1].seam;
  CHECK(result.seams[1].kind == scan_t::WORKPIECE);
  CHECK(seam.scan_id == kWorkpieceScan);
  CHECK(seam.background_scan_id == kBackgroundScan);
  CHECK(seam.reason == "");
  REQUIRE(seam.verdict == seam_t::FOUND);
  CHECK(seam.joint_type == "tee");
  const SeamError error = error_of(seam);
  CHECK(error.lateral_mm < lateral_mm);
  CHECK(error.direction_deg < direction_deg);
  CHECK(std::abs(error.along_mm) <
        2.5 * kStripeSpacing);  // nothing finer than stripes is asked here
  CHECK(result.is_good());
  CHECK(result.unanswered.empty());
  CHECK(result.undecodable == 0);
}

}  // namespace

TEST_CASE("from profiles the Tee's seam is found where it is, and the same bytes come again") {
  const Folder folder;
  const auto path = folder.save("a.lcm", of_stage(Stage::kProfiles));
  const ReplayResult result = replay_recordings({path});
  CHECK(result.sensor == "LASER0");
  CHECK(result.robot == "ROBOT0");
  CHECK(result.warnings.empty());
  check_found(result, 0.05, 0.05);
  CHECK((bytes_of(replay_recordings({path})) == bytes_of(result)));
}

TEST_CASE("from stripes and positions the Tee's seam is found where it is") {
  const Folder folder;
  const auto path = folder.save("a.lcm", of_stage(Stage::kStripes));
  const ReplayResult result = replay_recordings({path});
  CHECK(result.warnings.empty());
  check_found(result, 0.1, 0.1);
  CHECK(result.seams[1].seam.calibration_id == "closed form");
  CHECK((bytes_of(replay_recordings({path})) == bytes_of(result)));
}

TEST_CASE("from images the Tee's seam is found where it is, whatever was recorded beside them") {
  const Folder folder;
  const Events events = of_stage(Stage::kImages);
  const ReplayResult result = replay_recordings({folder.save("a.lcm", events)});
  check_found(result, 0.5, 0.5);

  // Derived messages, all wrong: had one of them been taken, the seam would lie elsewhere.
  Events with_derived = events;
  Recorded derived;
  derived.stripes = derived.profiles = true;
  for (auto& event : record(derived)) {
    stripe_t stripe;
    profile_t profile;
    if (event.channel == "LASER0_STRIPE" && decode(event.bytes, stripe).empty()) {
      for (auto& v : stripe.v) v += 7;
      event.bytes = encoded(stripe);
    } else if (event.channel == "LASER0_PROFILE" && decode(event.bytes, profile).empty()) {
      for (auto& z : profile.z) z += 7;
      event.bytes = encoded(profile);
    } else {
      continue;
    }
    event.timestamp -= 200'000;  // first of all
    with_derived.push_back(event);
  }
  seam_t wrong{};
  wrong.scan_id = kWorkpieceScan;
  wrong.direction[0] = 1;
  with_derived.push_back({kWorkpieceScan, "LASER0_SEAM", encoded(wrong)});
  sort(with_derived);
  CHECK((bytes_of(replay_recordings({folder.save("b.lcm", with_derived)})) == bytes_of(result)));
}

TEST_CASE("shifts between channels of up to 300 ms change nothing") {
  const Folder folder;
  const Stage stage = GENERATE(Stage::kProfiles, Stage::kStripes);
  const Events events = of_stage(stage);
  const auto expected = bytes_of(replay_recordings({folder.save("a.lcm", events)}));
  std::mt19937 random(11);
  for (int round = 0; round < 6; ++round) {
    // Another shift for every event; within a channel the order is kept.
    std::map<std::string, std::int64_t> newest;
    Events shifted = events;
    for (auto& event : shifted) {
      const bool whole_channel = round % 2 == 0;
      const auto seed = whole_channel ? std::hash<std::string>{}(event.channel) * 31 +
                                            static_cast<unsigned>(round)
                                      : random();
      event.timestamp += static_cast<std::int64_t>(seed % 600'001) - 300'000;
      auto& last = newest.try_emplace(event.channel, event.timestamp).first->second;
      last = event.timestamp = std::max(last, event.timestamp);
    }
    sort(shifted);
    CHECK((bytes_of(replay_recordings({folder.save("b.lcm", shifted)})) == expected));
  }
}

TEST_CASE("the parts of a recording give together what it gives") {
  const Folder folder;
  const Events events = of_stage(Stage::kStripes);
  const auto expected = bytes_of(replay_recordings({folder.save("a.lcm", events)}));
  Events parts[3];
  for (std::size_t i = 0; i < events.size(); ++i) parts[3 * i / events.size()].push_back(events[i]);
  std::vector<std::string> paths;
  for (int i = 0; i < 3; ++i)
    paths.push_back(folder.save("part" + std::string(1, static_cast<char>('0' + i)), parts[i]));
  do CHECK((bytes_of(replay_recordings(paths)) == expected));
  while (std::next_permutation(paths.begin(), paths.end()));
}

TEST_CASE("the calibration holds from the beginning, however late it was recorded first") {
  const Folder folder;
  Events events = of_stage(Stage::kStripes);
  const auto expected = bytes_of(replay_recordings({folder.save("a.lcm", events)}));
  std::erase_if(events, [](const auto& event) {
    return event.channel == "LASER0_CALIBRATION" && event.timestamp < kWorkpieceScan + 4'000'000;
  });
  CHECK((bytes_of(replay_recordings({folder.save("b.lcm", events)})) == expected));
}

TEST_CASE("the background comes from the recording, from another, or is missed") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  const auto both = folder.save("both.lcm", record(recorded));
  recorded.background = false;
  const auto workpiece = folder.save("workpiece.lcm", record(recorded));
  recorded.workpiece = false;
  recorded.background = true;
  const auto background = folder.save("background.lcm", record(recorded));

  const ReplayResult alone = replay_recordings({background});
  CHECK_FALSE(alone.has_workpiece());
  CHECK(alone.is_good());

  const ReplayResult without = replay_recordings({workpiece});
  REQUIRE(without.seams.size() == 1);
  CHECK(without.seams[0].seam.verdict == seam_t::REFUSED);
  CHECK_THAT(without.seams[0].seam.reason, Contains("no background"));
  CHECK_FALSE(without.is_good());

  ReplayOptions options;
  options.background = background;
  const ReplayResult given = replay_recordings({workpiece}, options);
  REQUIRE(given.seams.size() == 1);
  CHECK(given.seams[0].seam.verdict == seam_t::FOUND);
  CHECK(given.seams[0].seam.background_scan_id == kBackgroundScan);
  CHECK(given.is_good());

  const ReplayResult instead = replay_recordings({both}, options);
  REQUIRE(instead.seams.size() == 1);
  CHECK(instead.seams[0].seam.verdict == seam_t::FOUND);
  REQUIRE(instead.warnings.size() == 1);
  CHECK_THAT(instead.warnings[0], Contains("is left out"));

  options.background = workpiece;
  CHECK_THAT(refusal({workpiece}, options),
             Contains("workpiece.lcm: holds no whole background scan"));

  // A background that is later than the work is none.
  recorded.workpiece = recorded.background = true;
  Events later = record(recorded);
  for (auto& event : later) {
    scan_t state;
    if (event.channel == "LASER0_SCAN" && decode(event.bytes, state).empty()) {
      state.kind = state.kind == scan_t::BACKGROUND ? scan_t::WORKPIECE : scan_t::BACKGROUND;
      state.previous_kind = scan_t::WORKPIECE;
      event.bytes = encoded(state);
    }
  }
  const auto swapped = folder.save("swapped.lcm", later);
  options.background = swapped;
  CHECK_THAT(refusal({swapped}, options),
             Contains("swapped.lcm: its background scan is later than scan"));
}

TEST_CASE(
    "settings are those of the recording, of --cell where given, else the defaults, which is "
    "said") {
  const Folder folder;
  Events events = of_stage(Stage::kProfiles);
  for (auto& event : events) {
    service_status_t status;
    if (event.channel != "LASER0_SEAM_FINDING_STATUS") continue;
    REQUIRE(decode(event.bytes, status).empty());
    status.configuration = "seam_finding:\n  stripes_min: 900\n";
    event.bytes = encoded(status);
  }
  const auto path = folder.save("a.lcm", events);
  const ReplayResult strict = replay_recordings({path});
  REQUIRE(strict.seams.size() == 2);
  CHECK(strict.seams[1].seam.verdict != seam_t::FOUND);
  CHECK_THAT(replay_settings({path}, {}), Contains("stripes_min: 900"));

  std::ofstream(folder / "cell.yaml") << "seam_finding:\n  stripes_min: 5\n";
  ReplayOptions options;
  options.cell = folder / "cell.yaml";
  CHECK(replay_recordings({path}, options).is_good());
  std::ofstream(folder / "cell.yaml") << "seam_finding:\n  stripes: 5\n";
  CHECK_THAT(refusal({path}, options), Contains("cell.yaml:2: seam_finding.stripes: unknown key"));

  std::erase_if(events,
                [](const auto& event) { return event.channel == "LASER0_SEAM_FINDING_STATUS"; });
  const ReplayResult defaults = replay_recordings({folder.save("b.lcm", events)});
  CHECK(defaults.is_good());
  REQUIRE(defaults.warnings.size() == 1);
  CHECK_THAT(defaults.warnings[0],
             Contains("lacks channel LASER0_SEAM_FINDING_STATUS") && Contains("--cell"));
}

TEST_CASE("a scan is answered by what its recording says of its job, and by no file") {
  const Folder folder;
  seam_finding::SeamFindingSettings settings;
  const std::string of_cell =
      write_settings("seam_finding", settings) + write_settings("jobs", JobsSettings{});
  settings.weld_start = seam_finding::WeldStart::kFar;
  seam_finding::JobsOfScans jobs;
  jobs.scan_id = {std::to_string(kWorkpieceScan)};
  jobs.name = {"bracket"};
  jobs.text = {write_settings("seam_finding", settings) + write_settings("job", JobSettings{})};
  jobs.refusal = {""};
  const std::string of_job = write_settings("jobs_of_scans", jobs);
  Events events = of_stage(Stage::kProfiles);
  // Stated once alone, in the middle of the scan; another scan's job comes after.
  int statuses = 0;
  for (auto& event : events) {
    service_status_t status;
    scan_t state;
    if (event.channel == "LASER0_SEAM_FINDING_STATUS") {
      REQUIRE(decode(event.bytes, status).empty());
      status.configuration = of_cell;
      if (++statuses == 3) status.configuration += of_job;
      event.bytes = encoded(status);
    } else if (event.channel == "LASER0_SCAN") {
      REQUIRE(decode(event.bytes, state).empty());
      if (state.scan_id == kWorkpieceScan) state.job = "bracket";
      event.bytes = encoded(state);
    }
  }
  REQUIRE(statuses > 3);
  const auto path = folder.save("a.lcm", events);
  const ReplayResult result = replay_recordings({path});
  CHECK(result.warnings.empty());
  REQUIRE(result.seams.size() == 2);
  const seam_t& seam = result.seams[1].seam;
  REQUIRE(seam.verdict == seam_t::FOUND);
  CHECK((Eigen::Map<const Eigen::Vector3d>(seam.start) - kSeamEnd).norm() < 2.5 * kStripeSpacing);
  CHECK(seam.direction[0] < -0.99);
  CHECK(replay_recordings({path}).seams[1].bytes == result.seams[1].bytes);

  // What a live service is started with for scripts/replay says the same.
  std::ofstream(folder / "settings.yaml") << replay_settings({path}, {});
  ReplayOptions options;
  options.cell = folder / "settings.yaml";
  CHECK(replay_recordings({path}, options).seams[1].bytes == result.seams[1].bytes);

  // A cell's own file of that name counts where the cell is given, and one that is not there
  // refuses.
  std::ofstream(folder / "cell.yaml") << of_cell;
  options.cell = folder / "cell.yaml";
  CHECK_THAT(replay_recordings({path}, options).seams[1].seam.reason,
             Contains("jobs/bracket.yaml: cannot be read"));
  std::filesystem::create_directory(folder / "jobs");
  std::ofstream(folder / "jobs/bracket.yaml") << "{}";
  CHECK(replay_recordings({path}, options).seams[1].seam.direction[0] > 0.99);

  // Where the recording lost it, nothing is guessed.
  for (auto& event : events) {
    service_status_t status;
    if (event.channel != "LASER0_SEAM_FINDING_STATUS") continue;
    REQUIRE(decode(event.bytes, status).empty());
    status.configuration = of_cell;
    event.bytes = encoded(status);
  }
  CHECK_THAT(replay_recordings({folder.save("b.lcm", events)}).seams[1].seam.reason,
             Contains("the recording does not tell the settings of job bracket"));
}

TEST_CASE("the channels for lcm-logplayer are those that replay begins with") {
  const Folder folder;
  const auto channels = [&](Stage stage) {
    return source_channels({folder.save("a.lcm", of_stage(stage))}, {});
  };
  CHECK(channels(Stage::kProfiles) == "(LASER0_SCAN|LASER0_CALIBRATION|LASER0_PROFILE)");
  CHECK(channels(Stage::kStripes) == "(LASER0_SCAN|LASER0_CALIBRATION|ROBOT0_POSE|LASER0_STRIPE)");
  std::filesystem::resize_file(folder / "a.lcm", std::filesystem::file_size(folder / "a.lcm") - 1);
  CHECK_THROWS_AS(source_channels({folder / "a.lcm"}, {}), RecordingError);
}

TEST_CASE("replay reads and writes no state folder") {
  const Folder folder, home;
  const auto path = folder.save("a.lcm", of_stage(Stage::kProfiles));
  setenv("HOME", home.path().c_str(), 1);
  setenv("XDG_STATE_HOME", home.path().c_str(), 1);
  setenv("STATE_DIRECTORY", home.path().c_str(), 1);
  CHECK(replay_recordings({path}).is_good());
  CHECK(std::filesystem::is_empty(home.path()));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}
