// arcstart calibrate: files in, files out, exit codes, one line for bad input.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "services/calibration/files/calibration_file.hpp"
#include "tests/calibration/support/simulated_set.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

constexpr int kPoses = 10;

// A rendered set as files, made once and removed when all tests have ended.
struct RenderedFolder {
  RenderedFolder() {
    fs::remove_all(path);
    PlateImages images(small_sensor(), {});
    write_folder(path.string(), images, {}, draw_poses(images, {}, {}, kPoses, 601), 0.1, 0.01,
                 601);
  }
  ~RenderedFolder() { fs::remove_all(path); }

  const fs::path path =
      fs::temp_directory_path() / ("arcstart_rendered_set_" + std::to_string(getpid()));
};

// A copy of it for each test.
struct SetFolder {
  SetFolder() {
    static const RenderedFolder rendered;
    fs::remove_all(root);
    fs::create_directories(root);
    fs::copy(rendered.path, root / "set", fs::copy_options::recursive);
  }
  ~SetFolder() { fs::remove_all(root); }

  struct Outcome {
    int code;
    std::string out, err;
  };
  Outcome run(const std::string& arguments) const {
    const std::string command =
        "cd " + root.string() + " && " ARCSTART_PROGRAM " calibrate " + arguments + " >out 2>err";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(root / "out"),
            text_of(root / "err")};
  }
  // Bad input: exit 2, one line.
  std::string complaint() const {
    const Outcome outcome = run("set");
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    return outcome.err;
  }
  void replace_images(const std::string& folder, const cv::Mat& image) const {
    for (const auto& entry : fs::directory_iterator(root / "set" / folder))
      cv::imwrite(entry.path().string(), image);
  }

  const fs::path root =
      fs::temp_directory_path() / ("arcstart_calibrate_command_test_" + std::to_string(getpid()));
};

}  // namespace

TEST_CASE("a folder gives a calibration that the service reads, with its report") {
  const SetFolder folder;
  // The plate in any colour, the stripe in the laser's, in whatever kind of file.
  const auto grey = [&](const char* name) {
    const std::string path = (folder.root / "set" / name).string();
    const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
    fs::remove(path);
    return image;
  };
  const auto write = [&](const char* name, const std::vector<cv::Mat>& channels) {
    cv::Mat image;
    cv::merge(channels, image);
    cv::imwrite((folder.root / "set" / name).string(), image);
  };
  const cv::Mat grid = grey("grid/0003.png"), laser = grey("laser/0003.png");
  write("grid/0003.bmp", {grid, grid, grid * 0.9});
  write("laser/0003.tif", {cv::Mat(grid * 0.5), cv::Mat(grid * 0.5), laser});
  const auto outcome =
      folder.run("set -o made.yaml --sensor LASER1 --time-offset -0.02 --channel r");
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json["verdict"] == "passed");
  CHECK(json["leave_one_out"]["laser_rms"].get<double>() < 0.4);
  CHECK(json["poses"].size() == kPoses);
  CHECK(json["left_out"].empty());

  const Calibration calibration = read_calibration_file((folder.root / "made.yaml").string());
  CHECK(calibration.id == json["id"]);
  CHECK(calibration.sensor == "LASER1");
  CHECK(calibration.time_offset == -0.02);
  CHECK(calibration.covariance.size() == 361);
  CHECK(calibration.hand_eye_residual > 0);
  CHECK(calibration.verdict.passed == CalibrationVerdict::Passed::kPassed);
  CHECK(calibration.verdict.poses == kPoses);
  CHECK(calibration.camera_residual == json["camera_residual"].get<double>());
  const TrueSensor sensor = make_true_sensor(small_sensor());
  CHECK((calibration.T_tool_camera.translation() - sensor.T_tool_camera.translation()).norm() <
        0.5);

  CHECK(nlohmann::json::parse(text_of(folder.root / "made.json")) == json);
  const std::string page = text_of(folder.root / "made.html");
  CHECK_THAT(page, Contains("passed") && Contains("Pose 10") && Contains("</html>"));
  CHECK_THAT(page, Contains("<svg") && Contains("data:image/jpeg;base64,/9j/"));
  CHECK(page.find("http") == std::string::npos);  // all within
}

TEST_CASE("the cell's limits decide") {
  const SetFolder folder;
  std::ofstream(folder.root / "cell.yaml") << "calibration:\n  leave_one_out_mm: 0.01\n";
  std::ofstream(folder.root / "set/calibration.yaml") << "in force";
  const auto outcome = folder.run("set --cell cell.yaml");
  CHECK(outcome.code == 1);
  CHECK(nlohmann::json::parse(outcome.out)["verdict"] == "failed");
  CHECK_THAT(outcome.err, Contains("limit missed: leave-one-out"));
  CHECK(text_of(folder.root / "set/calibration.yaml") == "in force");
  const std::string failed = (folder.root / "set/calibration.failed.yaml").string();
  CHECK(read_calibration_file(failed).id == nlohmann::json::parse(outcome.out)["id"]);
  CHECK_THAT(outcome.err, Contains("calibration.failed.yaml: not within its limits"));
  using Passed = CalibrationVerdict::Passed;
  CHECK(read_calibration_file(failed).verdict.passed == Passed::kFailed);
  CHECK(read_calibration_file(failed).verdict.leave_one_out_limit == 0.01);
  CHECK(read_calibration_file(failed).verdict.poses == kPoses);
  // By a person, over what was there, which is kept.
  const auto forced = folder.run("set --cell cell.yaml --force 'R. Meyer'");
  CHECK(forced.code == 1);
  CHECK_THAT(forced.err, Contains("forced into use by R. Meyer"));
  const Calibration used = read_calibration_file((folder.root / "set/calibration.yaml").string());
  CHECK(used.verdict.passed == Passed::kFailed);
  CHECK(used.verdict.forced_by == "R. Meyer");
  CHECK(text_of(folder.root / "set/calibration.former.yaml") == "in force");
  CHECK_THAT(text_of(folder.root / "set/calibration.html"),
             Contains("Forced into use by R. Meyer"));
  CHECK(nlohmann::json::parse(forced.out)["forced_by"] == "R. Meyer");
  std::ofstream(folder.root / "cell.yaml") << "calibration:\n  leave_one_out: 0.01\n";
  CHECK(folder.run("set --cell cell.yaml").code == 2);
}

TEST_CASE("images that cannot give a calibration are said in one line") {
  const SetFolder folder;
  SECTION("unreadable") {
    std::ofstream(folder.root / "set/grid/0003.png") << "not an image";
    CHECK_THAT(folder.complaint(), Contains("grid/0003.png"));
  }
  SECTION("of another size") {
    cv::imwrite((folder.root / "set/laser/0004.png").string(), cv::Mat::zeros(100, 100, CV_8U));
    CHECK_THAT(folder.complaint(), Contains("laser/0004.png") && Contains("100 x 100"));
  }
  SECTION("another grid") {
    std::ofstream(folder.root / "set/plate.yaml")
        << "pattern: asymmetric_circles\ncolumns: 4\nrows: 11\npitch_mm: 12\nradius_mm: 4\n";
    CHECK_THAT(folder.complaint(), Contains("4 x 11") && Contains("columns and rows"));
  }
  SECTION("no stripe") {
    folder.replace_images("laser", cv::Mat::zeros(600, 800, CV_8U));
    CHECK_THAT(folder.complaint(), Contains("no stripe"));
  }
  SECTION("no folder") {
    fs::remove_all(folder.root / "set");
    CHECK_THAT(folder.complaint(), Contains("is no folder"));
  }
}

TEST_CASE("too few poses are refused, with what is missing") {
  const SetFolder folder;
  std::ifstream poses(folder.root / "set/poses.csv");
  std::string line, kept;
  for (int i = 0; i < 5 && std::getline(poses, line); ++i) kept += line + "\n";
  poses.close();
  std::ofstream(folder.root / "set/poses.csv") << kept;
  for (int i = 5; i <= kPoses; ++i)
    for (const char* name : {"grid", "laser"})
      fs::remove(folder.root / "set" / name /
                 (i < 10 ? "000" + std::to_string(i) + ".png" : "0010.png"));
  const auto outcome = folder.run("set");
  CHECK(outcome.code == 1);
  CHECK(nlohmann::json::parse(outcome.out)["verdict"] == "refused");
  CHECK_THAT(outcome.err, Contains("refused: 4 usable poses, at least 5"));
  CHECK(!fs::exists(folder.root / "set/calibration.yaml"));
}

TEST_CASE("quaternions in another order are recognised and said") {
  const SetFolder folder;
  std::ifstream poses(folder.root / "set/poses.csv");
  std::string line, kept;
  std::getline(poses, kept);
  while (std::getline(poses, line)) {
    std::istringstream fields(line);
    std::vector<std::string> f;
    for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
    REQUIRE(f.size() == 8);
    kept += "\n" + f[0] + "," + f[1] + "," + f[2] + "," + f[3] + "," + f[5] + "," + f[6] + "," +
            f[7] + "," + f[4];
  }
  poses.close();
  std::ofstream(folder.root / "set/poses.csv") << kept << "\n";
  const auto outcome = folder.run("set");
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.err, Contains("refused") && Contains("qw,qx,qy,qz, the scalar first"));
}
