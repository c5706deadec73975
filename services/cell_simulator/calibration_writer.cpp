#include "services/cell_simulator/calibration_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/configuration.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr const char* kMade = "made: ";

template <class Numbers>
std::string list(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string quoted(const std::string& text) { return std::string(YAML::Dump(YAML::Node(text))); }

// The time at which an existing file was made, -1 where there is none to be read.
std::int64_t time_made(const std::string& text) {
  const std::size_t line = text.find(std::string("\n") + kMade);
  return line == std::string::npos ? -1 : std::atoll(text.c_str() + line + 1 + std::strlen(kMade));
}

std::string read_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

std::string calibration_text(const TrueCalibration& calibration, std::int64_t made) {
  const TrueSensor& truth = calibration.truth;
  const Eigen::Vector3d n = truth.laser_normal, position = truth.T_tool_camera.translation();
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(truth.T_tool_camera.linear()).normalized();
  std::string text;
  const auto add = [&text](const std::string& key, const std::string& value) {
    text += key + ": " + value + "\n";
  };
  add("sensor", quoted(calibration.sensor));
  add("robot", quoted(calibration.robot));
  add("tool", quoted(calibration.tool));
  text += kMade + fmt::format("{}\n", made);
  add("origin", "\"simulator's truth\"");
  add("width", fmt::format("{}", truth.width));
  add("height", fmt::format("{}", truth.height));
  add("camera_matrix", list(std::array{truth.fx, truth.fy, truth.cx, truth.cy}));
  add("distortion", list(truth.distortion));
  add("laser_plane", list(std::array{n.x(), n.y(), n.z(), truth.laser_offset}));
  add("camera_position", list(std::array{position.x(), position.y(), position.z()}));
  add("camera_quaternion",
      list(std::array{rotation.w(), rotation.x(), rotation.y(), rotation.z()}));
  add("time_offset", fmt::format("{}", calibration.time_offset));
  add("camera_residual", "-1");
  add("laser_plane_residual", "-1");
  add("hand_eye_residual", "-1");
  add("verdict", "passed");  // the truth meets any limit
  add("limits", "[-1, -1, -1, -1, -1, -1]");
  add("poses", "-1");
  add("forced_by", "\"\"");
  return "# arcstart calibration\nid: " + fingerprint(text) + "\n" + text;
}

bool write_calibration(const std::string& path, const TrueCalibration& calibration,
                       std::int64_t made) {
  const std::string there = read_file(path);
  if (there == calibration_text(calibration, time_made(there))) return false;

  const std::string text = calibration_text(calibration, made);
  std::error_code error;
  if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, error);
  const std::string unfinished = path + ".unfinished";
  const int file = open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  bool good = file >= 0 &&
              write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
              fsync(file) == 0;
  if (file >= 0) good = close(file) == 0 && good;
  good = good && std::rename(unfinished.c_str(), path.c_str()) == 0;
  if (good) return true;
  const std::string why = std::strerror(errno);
  unlink(unfinished.c_str());
  throw CalibrationWriteError(path + ": the calibration cannot be written (" + why +
                              "): set calibration_file");
}

}  // namespace arcstart::cell_simulator
