// Scans rendered by another program, on which arcstart was wrong: from files through import and
// replay. Skipped, and said, where shared data is not there.
#include <fmt/core.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "paths.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/command_line/imports/imported_recording.hpp"
#include "services/command_line/output/scan_pictures.hpp"
#include "services/command_line/recordings/replay.hpp"
#include "tests/command_line/support/case_truth.hpp"
#include "tests/command_line/support/scan_files.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
namespace fs = std::filesystem;

namespace {

// Never is an end `seen` and yet off by more than so many of its deviations and so many mm.
constexpr double kMostDeviations = 3, kMostError = 1;  // 1, mm

struct Case {
  std::string name, joint_asked;
  bool has_seam;  // of the joint asked for
};
const std::vector<Case> kCases = {{"tee_cut_face_seen", "tee", true},
                                  {"lap_tool_across", "lap", true},
                                  {"tee_slanted_ends", "tee", true},
                                  {"no_tee_round_tool", "tee", false}};

std::string cases() {
  const char* folder = std::getenv("ARCSTART_DATA");
  return (folder ? std::string(folder) : ARCSTART_SOURCE "/../shared/data") + "/cases";
}

// By the stripes: refused for what they show, or they show an end elsewhere.
bool is_contradicted(const seam_t& seam) {
  const bool refused =
      seam.refusal >= seam_t::SEAM_NOT_SHOWN && seam.refusal <= seam_t::CORNER_ROUND;
  return refused || seam.start_second_weight > 0 || seam.end_second_weight > 0;
}

// Its picture, too, is there where it is to be.
seam_t answer_to(const Case& asked, const CaseTruth& truth) {
  const Folder folder;
  // By way of the file, as a user has it.
  write_text(folder / "calibration.yaml", calibration::calibration_file_text(truth.calibration));
  ImportedScans scans;
  scans.calibration = calibration::read_calibration_file(folder / "calibration.yaml");
  scans.settings = Configuration::from_text(
      "seam_finding:\n  joint_type: " + asked.joint_asked + "\n", asked.name);
  std::vector<std::string> notes;
  const double offset = scans.calibration.time_offset;
  scans.work = read_scan_folder(cases() + "/" + asked.name, {}, offset, notes);
  scans.background = read_scan_folder(cases() + "/background", {}, offset, notes);
  CHECK(notes.empty());
  put_background_first(scans, notes);
  CHECK(notes.size() == 1);  // all begin at the same time
  write_recording(
      folder / "scan.lcm", scans, [](double) {}, notes);
  ReplayOptions options;
  ScanPictures pictures(folder.path(),
                        scans.settings.read<seam_finding::SeamFindingSettings>("seam_finding"));
  options.on_bus = [&](Bus& bus, const std::string& sensor) { pictures.listen(bus, sensor); };
  const ReplayResult result = replay_recordings({folder / "scan.lcm"}, options);
  CHECK(result.warnings.empty());
  CHECK(result.unanswered.empty());
  REQUIRE(result.seams.size() == 2);
  CHECK(result.seams[0].seam.verdict == seam_t::BACKGROUND_STORED);
  const seam_t& seam = result.seams[1].seam;
  pictures.write();
  const bool drawn = fs::exists(folder / fmt::format("contradiction_{}.png", seam.scan_id));
  if (is_contradicted(seam)) CHECK(drawn);
  if (seam.verdict == seam_t::FOUND && seam.usable == seam_t::USABLE) CHECK_FALSE(drawn);
  return seam;
}

// Of an end of the seam, along it.
struct EndError {
  double error, deviation;  // mm
};

EndError end_error(const double found[3], const double covariance[3][3],
                   const Eigen::Vector3d& truth, const Eigen::Vector3d& along) {
  using Covariance = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const Covariance> C(&covariance[0][0]);
  return {(Eigen::Map<const Eigen::Vector3d>(found) - truth).norm(),
          std::sqrt(std::max(0.0, along.dot(C * along)))};
}

void hold_against(const Case& asked, const std::string& which, std::int8_t visibility,
                  const EndError& end) {
  fmt::print("{:<18} {:<5} off {:7.2f} mm, deviation {:.2f} mm, {}\n", asked.name, which, end.error,
             end.deviation, visibility == seam_t::SEEN ? "seen" : "not seen");
  if (visibility != seam_t::SEEN) return;
  CHECK(end.error <= std::max(kMostDeviations * end.deviation, kMostError));
}

}  // namespace

TEST_CASE("scans of others' making are imported and answered", "[figures]") {
  if (!fs::is_directory(cases())) {
    WARN("skipped: " << cases() << " is not there; set ARCSTART_DATA");
    return;
  }
  for (const Case& asked : kCases) {
    INFO(asked.name);
    const CaseTruth truth = read_case_truth(cases() + "/" + asked.name + "/truth.yaml");
    CHECK((truth.joint == asked.joint_asked) == asked.has_seam);
    const seam_t seam = answer_to(asked, truth);
    CHECK(seam.stripes + seam.stripes_empty >= 40);  // of 43 images
    CHECK(seam.stripes_without_pose == 0);
    if (seam.verdict != seam_t::FOUND) {
      fmt::print("{:<18} {}\n", asked.name, seam.reason);
      CHECK((seam.verdict == seam_t::REFUSED || seam.verdict == seam_t::AMBIGUOUS));
      CHECK_FALSE(seam.reason.empty());
      continue;
    }
    CHECK(seam.joint_type == asked.joint_asked);
    if (!asked.has_seam) {
      FAIL_CHECK("found, though there is no " << asked.joint_asked);
      continue;
    }
    const Eigen::Vector3d along = (truth.b - truth.a).normalized();
    // Wherever its ends are taken to be, it lies on the seam: the geometry is carried over whole.
    for (const double* point : {seam.start, seam.end}) {
      const Eigen::Vector3d from_a = Eigen::Map<const Eigen::Vector3d>(point) - truth.a;
      CHECK((from_a - along * along.dot(from_a)).norm() < 0.1);
    }
    hold_against(asked, "start", seam.start_visibility,
                 end_error(seam.start, seam.start_covariance, truth.a, along));
    hold_against(asked, "end", seam.end_visibility,
                 end_error(seam.end, seam.end_covariance, truth.b, along));
  }
}
