// arcstart import scan: files in, a recording out, exit codes, one line for what cannot be.
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "services/calibration/files/calibration_file.hpp"
#include "tests/command_line/support/closed_form_cell.hpp"
#include "tests/command_line/support/scan_files.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(const Folder& folder, const std::string& arguments) {
  const std::string command =
      "cd " + folder.path() + " && " ARCSTART_PROGRAM " " + arguments + " >out 2>err";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"),
          read_text(folder / "err")};
}

// FOLDER/work, FOLDER/background and FOLDER/calibration.yaml.
void write_files(const Folder& folder, const PoseWriting& writing = {}) {
  Recorded recorded;
  recorded.images = true;
  static const Events events = record(recorded);
  write_scan_files(folder / "background", events, kBackgroundScan, writing);
  write_scan_files(folder / "work", events, kWorkpieceScan, writing);
  write_text(folder / "calibration.yaml",
             calibration::calibration_file_text(calibration_of_cell("LASER0", "ROBOT0")));
}

}  // namespace

TEST_CASE("arcstart import scan makes a recording that arcstart replay answers") {
  const Folder folder;
  write_files(folder, {"wpr", "inch", true});
  const Outcome made = run(folder,
                           "import scan work --background background --calibration "
                           "calibration.yaml --pose-format wpr --pose-units inch --job bracket "
                           "-o scan.lcm");
  INFO(made.err);
  CHECK(made.code == 0);
  CHECK(made.out.empty());
  CHECK_THAT(made.err, Contains("import scan: scan.lcm: 46 images and"));
  const Outcome answer = run(folder, "replay scan.lcm --json");
  CHECK(answer.code == 0);
  CHECK_THAT(answer.err, Contains("found tee"));
  CHECK_THAT(answer.out, Contains("\"job\": \"bracket\"") || Contains("\"job\":\"bracket\""));

  // The background from a recording of its own.
  CHECK(run(folder,
            "import scan work --calibration calibration.yaml --pose-format wpr --pose-units inch "
            "-o work.lcm")
            .code == 0);
  CHECK(run(folder,
            "import scan background --calibration calibration.yaml --pose-format wpr --pose-units "
            "inch -o other.lcm")
            .code == 0);
  const Outcome without = run(folder, "replay work.lcm");
  CHECK(without.code == 1);
  CHECK_THAT(without.err, Contains("refused: no background"));

  const Outcome lap = run(folder,
                          "import scan work --background background --calibration "
                          "calibration.yaml --pose-format wpr --pose-units inch --joint lap -o "
                          "lap.lcm");
  CHECK(lap.code == 0);
  CHECK_THAT(run(folder, "replay --print-settings lap.lcm").out, Contains("joint_type: \"lap\""));
}

TEST_CASE("what arcstart import scan cannot use ends with 2 and one line, and leaves no file") {
  const Folder folder;
  write_files(folder);
  write_text(folder / "there.lcm", "mine");
  fs::copy(folder / "work", folder / "xyzw", fs::copy_options::recursive);
  write_text(folder / "xyzw/poses.csv",
             "utime,x,y,z,qx,qy,qz,qw\n" +
                 read_text(folder / "work/poses.csv")
                     .substr(read_text(folder / "work/poses.csv").find('\n') + 1));
  fs::copy(folder / "work", folder / "late", fs::copy_options::recursive);
  write_text(folder / "late/frames/0045.png", "no image");
  Calibration other = calibration_of_cell("LASER0", "ROBOT0");
  other.sensor_model.width = 800;
  write_text(folder / "other.yaml", calibration::calibration_file_text(other));
  write_text(folder / "cell.yaml", "seam_finding:\n  no_such_key: 1\n");
  const std::string right = " --calibration calibration.yaml -o scan.lcm";
  for (const auto& [arguments, words] : std::vector<std::pair<std::string, std::string>>{
           {"nowhere" + right, "nowhere: is no folder"},
           {"work --background nowhere" + right, "nowhere: is no folder"},
           {"work --calibration nowhere.yaml -o scan.lcm", "nowhere.yaml: cannot be read"},
           {"work --calibration other.yaml -o scan.lcm", "the calibration is of 800 x 480"},
           {"xyzw" + right, "xyzw/poses.csv:1: the columns"},
           {"work --pose-units m" + right, "another unit than m"},
           {"work --pose-format matrix" + right, "work/poses.csv:1: the columns"},
           {"late" + right, "late/frames/0045.png: not an image, or damaged"},
           {"work --cell cell.yaml" + right, "no_such_key"},
           {"work --calibration calibration.yaml -o there.lcm", "there.lcm: exists already"},
           {"work --calibration calibration.yaml -o work", "work: exists already"},
           {"work --calibration calibration.yaml -o no/such/scan.lcm", "cannot be written"}}) {
    const Outcome outcome = run(folder, "import scan " + arguments);
    INFO(arguments << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.starts_with("import scan: "));
    CHECK_THAT(outcome.err, Contains(words));
  }
  for (const std::string& arguments : std::vector<std::string>{
           "", "scan", "scan work", "scan work --pose-format euler" + right, "weld"})
    CHECK(run(folder, "import " + arguments).code == 2);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    CHECK((entry.path().extension() != ".lcm" || entry.path().filename() == "there.lcm"));
  CHECK_FALSE(fs::exists(folder / "scan.lcm.part"));
  CHECK(read_text(folder / "there.lcm") == "mine");
}
