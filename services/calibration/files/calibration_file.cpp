#include "services/calibration/files/calibration_file.hpp"

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include "common/configuration.hpp"

namespace arcstart::calibration {
namespace {

constexpr std::size_t kLargestFile = 65536;  // bytes; a calibration has about 700, with its
                                             // covariance 8000

// The file's keys as a section of the configuration, which reads them strictly.
struct FileContent {
  std::string id, sensor, robot, tool, made, origin;
  int width = 0, height = 0;
  std::array<double, 4> camera_matrix{};
  std::array<double, 5> distortion{};
  std::array<double, 4> laser_plane{};
  std::array<double, 3> camera_position{};
  std::array<double, 4> camera_quaternion{};
  double time_offset = 0;
  double camera_residual = 0, laser_plane_residual = 0, hand_eye_residual = 0;
  // Verdict, limits, poses and who forced it: may be left out together.
  std::string verdict, forced_by;
  std::array<double, 6> limits{-1, -1, -1, -1, -1, -1};
  int poses = -1;
  std::vector<double> covariance;  // may be left out

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("id", id);
    visitor("sensor", sensor);
    visitor("robot", robot);
    visitor("tool", tool);
    visitor("made", made);
    visitor("origin", origin);
    visitor("width", width);
    visitor("height", height);
    visitor("camera_matrix", camera_matrix);
    visitor("distortion", distortion);
    visitor("laser_plane", laser_plane);
    visitor("camera_position", camera_position);
    visitor("camera_quaternion", camera_quaternion);
    visitor("time_offset", time_offset);
    visitor("camera_residual", camera_residual);
    visitor("laser_plane_residual", laser_plane_residual);
    visitor("hand_eye_residual", hand_eye_residual);
  }
  template <class Visitor>
  void visit_verdict(Visitor& visitor) {
    visitor("verdict", verdict);
    visitor("limits", limits);
    visitor("poses", poses);
    visitor("forced_by", forced_by);
  }
};

// Reads a key like SectionReader, but insists on it.
struct StrictReader {
  SectionReader& reader;
  const YAML::Node& root;
  const std::string& name;

  template <class T>
  void operator()(const std::string& key, T& value) {
    if (!root[key])
      throw CalibrationFileError(
          fmt::format("{}: {}: is missing: make the calibration anew", name, key));
    reader(key, value);
  }
};

// All after the line of the id, which stands first but for comments. What stood before it would not
// be guarded.
std::string guarded_part(const std::string& text, const std::string& name) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.starts_with("id:")) return text.substr(std::min(end + 1, text.size()));
    if (!line.empty() && !line.starts_with("#")) break;
    begin = end + 1;
  }
  throw CalibrationFileError(name + ": id: must be the first key: is this a calibration file?");
}

std::int64_t parse_made(const std::string& made, const std::string& name) {
  std::int64_t utime = 0;
  const auto [end, error] = std::from_chars(made.data(), made.data() + made.size(), utime);
  if (error != std::errc{} || end != made.data() + made.size())
    throw CalibrationFileError(
        fmt::format("{}: made: must be a time in us, UTC, is '{}'", name, made));
  return utime;
}

CalibrationVerdict to_verdict(const FileContent& content) {
  using Passed = CalibrationVerdict::Passed;
  CalibrationVerdict verdict;
  if (content.verdict == "passed")
    verdict.passed = Passed::kPassed;
  else if (content.verdict == "failed")
    verdict.passed = Passed::kFailed;
  verdict.camera_limit = content.limits[0];
  verdict.laser_plane_limit = content.limits[1];
  verdict.leave_one_out_limit = content.limits[2];
  verdict.predicted_limit = content.limits[3];
  verdict.robot_position_limit = content.limits[4];
  verdict.robot_orientation_limit = content.limits[5];
  verdict.poses = content.poses;
  verdict.forced_by = content.forced_by;
  return verdict;
}

Calibration to_calibration(const FileContent& content, const std::string& name) {
  Calibration calibration;
  calibration.id = content.id;
  calibration.sensor = content.sensor;
  calibration.robot = content.robot;
  calibration.tool = content.tool;
  calibration.made = parse_made(content.made, name);
  calibration.origin = content.origin;
  SensorModel& model = calibration.sensor_model;
  model.width = content.width;
  model.height = content.height;
  model.fx = content.camera_matrix[0];
  model.fy = content.camera_matrix[1];
  model.cx = content.camera_matrix[2];
  model.cy = content.camera_matrix[3];
  model.distortion = content.distortion;
  model.laser_plane.normal = Eigen::Map<const Eigen::Vector3d>(content.laser_plane.data());
  model.laser_plane.offset = content.laser_plane[3];
  const double length =
      Eigen::Map<const Eigen::Vector4d>(content.camera_quaternion.data()).squaredNorm();
  if (!(std::abs(length - 1) < 1e-6))
    throw CalibrationFileError(name + ": camera_quaternion: must have length 1");
  calibration.T_tool_camera =
      transform_from_arrays(content.camera_position.data(), content.camera_quaternion.data());
  calibration.time_offset = content.time_offset;
  calibration.camera_residual = content.camera_residual;
  calibration.laser_plane_residual = content.laser_plane_residual;
  calibration.hand_eye_residual = content.hand_eye_residual;
  calibration.verdict = to_verdict(content);
  calibration.covariance = content.covariance;
  return calibration;
}

}  // namespace

Calibration parse_calibration(const std::string& text, const std::string& name) {
  if (text.size() > kLargestFile)
    throw CalibrationFileError(
        fmt::format("{}: longer than {} bytes: is this a calibration file?", name, kLargestFile));
  const std::string guarded = guarded_part(text, name);
  FileContent content;
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) throw CalibrationFileError(name + ": must be a map of keys to values");
    SectionReader reader(name, "calibration", root);
    StrictReader strict{reader, root, name};
    content.visit(strict);
    if (root["verdict"] || root["limits"] || root["poses"] || root["forced_by"]) {
      content.visit_verdict(strict);
      if (content.verdict != "passed" && content.verdict != "failed")
        throw CalibrationFileError(
            fmt::format("{}: verdict: must be passed or failed, is '{}'", name, content.verdict));
    }
    reader("covariance", content.covariance);
    reader.refuse_unknown_keys();
  } catch (const YAML::Exception& error) {
    throw CalibrationFileError(
        fmt::format("{}:{}: not YAML: {}", name, error.mark.line + 1, error.msg));
  } catch (const ConfigurationError& error) {
    throw CalibrationFileError(error.what());
  }
  if (content.id != fingerprint(guarded))
    throw CalibrationFileError(fmt::format(
        "{}: id {} does not fit what the file says: parts of it were changed by hand, but camera, "
        "laser plane and hand-eye are one set: restore the file or make the calibration anew",
        name, content.id));
  Calibration calibration = to_calibration(content, name);
  if (const std::string error = calibration_error(calibration); !error.empty())
    throw CalibrationFileError(name + ": " + error);
  return calibration;
}

Calibration read_calibration_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file && !file.eof())
    throw CalibrationFileError(
        path + ": cannot be read: put the cell's calibration there, or set calibration.file");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_calibration(text, path);
}

}  // namespace arcstart::calibration
