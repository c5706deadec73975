// A scan in files answers as the recording it came from, however its poses are written.
#include <catch2/catch.hpp>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "services/command_line/imports/imported_recording.hpp"
#include "services/command_line/recordings/replay.hpp"
#include "tests/command_line/support/closed_form_cell.hpp"
#include "tests/command_line/support/scan_files.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kSecond = 1'000'000;  // us

const Events& events() {
  static const Events all = [] {
    Recorded recorded;
    recorded.images = true;
    return record(recorded);
  }();
  return all;
}

Eigen::Vector3d start_of(const seam_t& seam) {
  return Eigen::Map<const Eigen::Vector3d>(seam.start);
}
Eigen::Vector3d end_of(const seam_t& seam) { return Eigen::Map<const Eigen::Vector3d>(seam.end); }

// Both scans of the recording, from files.
ImportedScans scans_of(const Folder& folder, const PoseWriting& writing,
                       std::vector<std::string>& notes) {
  ImportedScans scans;
  scans.calibration = calibration_of_cell("LASER0", "ROBOT0");
  const auto read = [&](const std::string& name, std::int64_t scan_id) {
    write_scan_files(folder / name, events(), scan_id, writing);
    return read_scan_folder(folder / name, {writing.format, writing.unit},
                            scans.calibration.time_offset, notes);
  };
  scans.background = read("background", kBackgroundScan);
  scans.work = read("work", kWorkpieceScan);
  return scans;
}

std::vector<ReplayedSeam> import_and_replay(const Folder& folder, const ImportedScans& scans) {
  std::vector<std::string> notes;
  const std::string path = folder / "scan.lcm";
  fs::remove(path);
  write_recording(
      path, scans, [](double) {}, notes);
  CHECK(notes.empty());
  ReplayResult result = replay_recordings({path});
  CHECK(result.warnings.empty());
  CHECK(result.undecodable == 0);
  CHECK(result.unanswered.empty());
  return std::move(result.seams);
}

}  // namespace

TEST_CASE("a scan from files gives the answer of the recording it came from, in every writing",
          "[figures]") {
  const Folder original;
  const ReplayResult recorded = replay_recordings({original.save("cell.lcm", events())});
  REQUIRE(recorded.seams.size() == 2);
  std::optional<seam_t> first;
  for (const std::string format : {"wxyz", "xyzw", "wpr", "rotvec", "matrix"})
    for (const std::string unit : {"mm", "m", "inch"}) {
      // Half of them without a line that names the columns.
      const PoseWriting writing{format, unit, unit != "m"};
      INFO(format << " in " << unit);
      const Folder folder;
      std::vector<std::string> notes;
      ImportedScans scans = scans_of(folder, writing, notes);
      put_background_first(scans, notes);
      CHECK(notes.empty());
      const auto seams = import_and_replay(folder, scans);
      REQUIRE(seams.size() == 2);
      CHECK(seams[0].seam.verdict == seam_t::BACKGROUND_STORED);
      CHECK(seams[0].seam.background_points == recorded.seams[0].seam.background_points);
      const seam_t& seam = seams[1].seam;
      REQUIRE(seam.verdict == seam_t::FOUND);
      CHECK(seam.points == recorded.seams[1].seam.points);
      CHECK((start_of(seam) - start_of(recorded.seams[1].seam)).norm() < 1e-3);
      CHECK((end_of(seam) - end_of(recorded.seams[1].seam)).norm() < 1e-3);
      if (!first) first = seam;
      CHECK((start_of(seam) - start_of(*first)).norm() < 1e-6);
      CHECK((end_of(seam) - end_of(*first)).norm() < 1e-6);
    }
  // Across the seam a stripe tells it; along it, at these poses, to a stripe's distance alone.
  const Eigen::Vector3d off = start_of(*first) - kSeamStart;
  CHECK(off.tail<2>().norm() < 0.1);
  CHECK(std::abs(off.x()) < kStripeSpacing);
}

TEST_CASE("poses that end where the last image was taken are enough") {
  const Folder folder;
  std::vector<std::string> notes;
  ImportedScans scans = scans_of(folder, {}, notes);
  const auto all = import_and_replay(folder, scans);
  for (ScanFolder* scan : {&*scans.background, &scans.work}) {
    // Taken 27.32 ms before its stamp: one pose after that is before the stamp.
    const std::int64_t taken = scan->frames.back().utime - 27'320;
    while (scan->poses[scan->poses.size() - 2].utime >= taken) scan->poses.pop_back();
    REQUIRE(scan->last_utime() == scan->frames.back().utime);
  }
  const auto few = import_and_replay(folder, scans);
  REQUIRE(few.size() == 2);
  CHECK(few[1].bytes == all[1].bytes);
}

TEST_CASE("the same files give the same bytes") {
  const Folder folder;
  std::vector<std::string> notes;
  const ImportedScans scans = scans_of(folder, {}, notes);
  write_recording(
      folder / "a.lcm", scans, [](double) {}, notes);
  write_recording(
      folder / "b.lcm", scans, [](double) {}, notes);
  CHECK(read_text(folder / "a.lcm") == read_text(folder / "b.lcm"));
  CHECK(notes.empty());
}

TEST_CASE("a background taken at the same time, or later, is moved before the work") {
  const Folder folder;
  std::vector<std::string> notes;
  ImportedScans scans = scans_of(folder, {}, notes);
  const auto in_order = import_and_replay(folder, scans);
  // Both begin at the same instant, as rendered ones do.
  scans.background->shift(scans.work.first_utime() - scans.background->first_utime());
  const ScanFolder together = *scans.background;
  put_background_first(scans, notes);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("overlaps in time") && Contains("earlier"));
  CHECK(scans.background->last_utime() < scans.work.first_utime());
  CHECK(scans.background->frames[1].utime - scans.background->poses[1].utime ==
        together.frames[1].utime - together.poses[1].utime);
  const auto moved = import_and_replay(folder, scans);
  REQUIRE(moved.size() == 2);
  REQUIRE(moved[1].seam.verdict == seam_t::FOUND);
  CHECK(moved[1].seam.background_scan_id == moved[0].seam.scan_id);
  CHECK((start_of(moved[1].seam) - start_of(in_order[1].seam)).norm() < 1e-3);

  notes.clear();
  scans.background->shift(3600 * kSecond);
  put_background_first(scans, notes);
  CHECK(notes.size() == 1);
  CHECK(scans.background->last_utime() < scans.work.first_utime());
  notes.clear();
  put_background_first(scans, notes);  // once is enough
  CHECK(notes.empty());
}

TEST_CASE("what the recording says of the scan: job, part, joint; and nothing that is not known") {
  const Folder folder;
  std::vector<std::string> notes;
  ImportedScans scans = scans_of(folder, {}, notes);
  scans.job = "bracket";
  scans.part = "7";
  scans.settings = Configuration::from_text("seam_finding:\n  joint_type: lap\n", "test");
  write_recording(
      folder / "scan.lcm", scans, [](double) {}, notes);
  CHECK_THAT(replay_settings({folder / "scan.lcm"}, {}), Contains("joint_type: \"lap\""));
  const Recording recording({folder / "scan.lcm"}, "", "");
  CHECK(recording.sensor() == "LASER0");
  CHECK(recording.robot() == "ROBOT0");
  REQUIRE(recording.scans().size() == 2);
  const RecordedScan& work = recording.scans().rbegin()->second;
  CHECK(work.kind == scan_t::WORKPIECE);
  CHECK(work.begun);
  CHECK(work.ended);
  CHECK(work.messages[0] == static_cast<int>(scans.work.frames.size()));
  CHECK(work.last_seq ==
        static_cast<std::int64_t>(scans.work.frames.size() + scans.background->frames.size()) - 1);
  for (const RecordedMessage& message :
       recording.sources([](const RecordedScan& scan) { return scan.is_workpiece(); })) {
    const auto bytes = recording.read(message);
    scan_t scan;
    robot_pose_t pose;
    if (recording.channel(message) == "LASER0_SCAN" && message.scan_id == work.scan_id) {
      REQUIRE(decode(bytes, scan).empty());
      CHECK(scan.job == "bracket");
      CHECK(scan.part == "7");
      CHECK(scan.previous_scan_id == recording.scans().begin()->first);
    }
    if (recording.channel(message) == "ROBOT0_POSE") {
      REQUIRE(decode(bytes, pose).empty());
      CHECK(pose.source == robot_pose_t::UNKNOWN);
      CHECK(pose.tool_frame == -1);
    }
  }
}

TEST_CASE(
    "colour, 16 bits, other sizes: turned to grey and told, or refused with the file's name") {
  const Folder folder;
  std::vector<std::string> notes;
  ImportedScans scans = scans_of(folder, {}, notes);
  scans.background.reset();
  const std::string image = scans.work.frames[20].image;
  const cv::Mat grey = cv::imread(image, cv::IMREAD_UNCHANGED);
  const auto refusal = [&] {
    std::string what;
    try {
      write_recording(
          folder / "scan.lcm", scans, [](double) {}, notes);
    } catch (const InputError& error) {
      what = error.what();
    }
    CHECK_FALSE(fs::exists(folder / "scan.lcm"));
    CHECK_FALSE(fs::exists(folder / "scan.lcm.part"));
    CHECK_THAT(what, Contains(image + ": "));
    return what;
  };
  cv::Mat other;
  grey.convertTo(other, CV_16U, 256);
  cv::imwrite(image, other);
  CHECK_THAT(refusal(), Contains("not 8 bit"));
  cv::imwrite(image, grey(cv::Rect(0, 0, 600, 480)));
  CHECK_THAT(refusal(), Contains("600 x 480 pixels, the calibration is of 640 x 480"));
  write_text(image, "no image");
  CHECK_THAT(refusal(), Contains("not an image, or damaged"));

  // A red stripe.
  const std::vector<cv::Mat> channels{cv::Mat::zeros(grey.size(), CV_8U), grey / 8, grey};
  cv::merge(channels, other);
  cv::imwrite(image, other);
  const auto brightest = [&](const std::string& path) {
    Recording recording({path}, "", "");
    for (const auto& message : recording.sources([](const RecordedScan&) { return true; })) {
      image_t found;
      if (recording.channel(message) != "LASER0_IMAGE" ||
          !decode(recording.read(message), found).empty() || found.scan_index != 20)
        continue;
      CHECK(found.encoding == image_t::MONO8);
      return static_cast<int>(*std::max_element(found.data.begin(), found.data.end()));
    }
    return -1;
  };
  double top = 0;
  cv::minMaxLoc(grey, nullptr, &top);
  write_recording(
      folder / "turned.lcm", scans, [](double) {}, notes);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains(image) && Contains("turned to grey") && Contains("--channel"));
  CHECK(brightest(folder / "turned.lcm") < top / 2);
  notes.clear();
  scans.channel = "r";
  write_recording(
      folder / "red.lcm", scans, [](double) {}, notes);
  CHECK(notes.empty());
  CHECK(brightest(folder / "red.lcm") == static_cast<int>(top));
}
