#include "services/cell_simulator/calibration_writer.hpp"

#include <yaml-cpp/yaml.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/configuration.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "arcstart-test-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

TrueCalibration a_calibration() {
  return {"LASER0", "ROBOT0", "TCP1", make_true_sensor(SensorSettings()), -0.02732};
}

}  // namespace

TEST_CASE("the calibration file gives the truth back bit by bit, and its id covers all of it") {
  const Folder folder;
  const std::string path = folder.path / "state" / "calibration.yaml";
  const TrueCalibration calibration = a_calibration();
  REQUIRE(write_calibration(path, calibration, 1'700'000'000'000'001));
  const std::string text = content(path);
  const YAML::Node file = YAML::Load(text);

  const TrueSensor& truth = calibration.truth;
  CHECK(file["sensor"].as<std::string>() == "LASER0");
  CHECK(file["robot"].as<std::string>() == "ROBOT0");
  CHECK(file["tool"].as<std::string>() == "TCP1");
  CHECK(file["made"].as<std::int64_t>() == 1'700'000'000'000'001);
  CHECK(file["origin"].as<std::string>() == "simulator's truth");
  CHECK(file["width"].as<int>() == 1600);
  CHECK(file["height"].as<int>() == 1200);
  CHECK(file["camera_matrix"].as<std::vector<double>>() ==
        std::vector{truth.fx, truth.fy, truth.cx, truth.cy});
  CHECK(file["distortion"].as<std::vector<double>>() ==
        std::vector<double>(truth.distortion.begin(), truth.distortion.end()));
  CHECK(file["laser_plane"].as<std::vector<double>>() ==
        std::vector{truth.laser_normal.x(), truth.laser_normal.y(), truth.laser_normal.z(),
                    truth.laser_offset});
  const auto position = file["camera_position"].as<std::vector<double>>();
  CHECK(Eigen::Vector3d(position[0], position[1], position[2]) ==
        truth.T_tool_camera.translation());
  const auto q = file["camera_quaternion"].as<std::vector<double>>();
  CHECK(
      (Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix() - truth.T_tool_camera.linear())
          .norm() < 1e-14);
  CHECK(file["time_offset"].as<double>() == -0.02732);
  for (const char* residual : {"camera_residual", "laser_plane_residual", "hand_eye_residual"})
    CHECK(file[residual].as<double>() == -1);

  const std::size_t body = text.find("sensor:");
  CHECK(text.substr(0, body) ==
        "# arcstart calibration\nid: " + fingerprint(text.substr(body)) + "\n");
}

TEST_CASE("a restart keeps the file and its id, another truth replaces them") {
  const Folder folder;
  const std::string path = folder.path / "calibration.yaml";
  TrueCalibration calibration = a_calibration();
  REQUIRE(write_calibration(path, calibration, 1));
  const std::string first = content(path);
  CHECK_FALSE(write_calibration(path, calibration, 2));
  CHECK(content(path) == first);

  calibration.truth.fx += 0.001;
  CHECK(write_calibration(path, calibration, 3));
  CHECK(YAML::Load(content(path))["id"].as<std::string>() !=
        YAML::Load(first)["id"].as<std::string>());

  std::ofstream(path) << "damaged";
  CHECK(write_calibration(path, calibration, 4));
  CHECK(YAML::Load(content(path))["made"].as<int>() == 4);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) ==
        1);  // nothing unfinished is left
}

TEST_CASE("a file that cannot be written is named with what to do") {
  const Folder folder;
  std::ofstream(folder.path / "file") << "x";
  const std::string path = folder.path / "file" / "calibration.yaml";
  CHECK_THROWS_WITH(write_calibration(path, a_calibration(), 1),
                    Catch::Contains(path) && Catch::Contains("set calibration_file"));
}
