#include "services/calibration/files/target_file.hpp"

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "common/configuration.hpp"
#include "services/calibration/files/calibration_set_error.hpp"

namespace arcstart::calibration {
namespace {

constexpr double kShortestPitch = 0.5;  // mm; a smaller one was meant in metres

// plate.yaml as a section of the configuration, which reads it strictly.
struct PlateKeys {
  std::string pattern;
  int columns = 0, rows = 0;
  double pitch_mm = 0, radius_mm = 0, origin_dot_radius_mm = 0;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("pattern", pattern, one_of({"circles", "asymmetric_circles", "chessboard"}));
    visitor("columns", columns, between(2, 100));
    visitor("rows", rows, between(2, 100));
    visitor("pitch_mm", pitch_mm, positive());
    visitor("radius_mm", radius_mm, not_negative());
    visitor("origin_dot_radius_mm", origin_dot_radius_mm, not_negative());
  }
};

std::string plate_error(const PlateKeys& keys) {
  if (keys.pattern.empty() || keys.columns == 0 || keys.rows == 0 || keys.pitch_mm == 0)
    return "pattern, columns, rows and pitch_mm must all be given";
  if (keys.pitch_mm < kShortestPitch)
    return fmt::format("pitch_mm: {} mm: is it in metres? Give millimetres", keys.pitch_mm);
  if (keys.pattern == "chessboard") {
    if (keys.columns < 3 || keys.rows < 3)
      return "columns and rows count a chessboard's inner corners: at least 3 each";
    return "";
  }
  if (keys.radius_mm == 0)
    return "radius_mm is missing: a circle's image is not centred on its centre, and only the "
           "radius tells by how much";
  const double nearest = keys.pattern == "circles" ? keys.pitch_mm : keys.pitch_mm * std::sqrt(2);
  if (keys.radius_mm < kShortestPitch / 10)
    return fmt::format("radius_mm: {} mm: is it in metres? Give millimetres", keys.radius_mm);
  if (2 * keys.radius_mm >= nearest)
    return fmt::format(
        "radius_mm: circles of {} mm overlap at a pitch of {} mm: give the radius, "
        "not the diameter",
        keys.radius_mm, keys.pitch_mm);
  return "";
}

std::array<double, 8> numbers_of_line(const std::string& line, const std::string& where) {
  std::array<double, 8> numbers{};
  std::istringstream fields(line);
  std::string field;
  std::size_t count = 0;
  while (std::getline(fields, field, ',')) {
    const std::size_t begin = std::min(field.find_first_not_of(" \t"), field.size());
    const std::size_t end = field.find_last_not_of(" \t\r") + 1;
    double number = 0;
    const auto [stop, error] =
        std::from_chars(field.data() + begin, field.data() + std::max(begin, end), number);
    if (error != std::errc{} || stop != field.data() + end || !std::isfinite(number))
      throw CalibrationSetError(fmt::format("{}: '{}' is no number", where, field));
    if (count < numbers.size()) numbers[count] = number;
    ++count;
  }
  if (count != numbers.size())
    throw CalibrationSetError(
        fmt::format("{}: {} numbers; give index,x,y,z,qw,qx,qy,qz", where, count));
  return numbers;
}

void refuse_metres(const std::map<int, RigidTransform>& poses, const std::string& path) {
  constexpr double kSmallestSpread = 3, kNearest = 10;  // mm: no robot calibrates within these
  double farthest = 0, spread = 0;
  for (const auto& [index, pose] : poses) {
    farthest = std::max(farthest, pose.translation().norm());
    spread = std::max(spread, (pose.translation() - poses.begin()->second.translation()).norm());
  }
  if (poses.size() > 1 && farthest < kNearest && spread < kSmallestSpread)
    throw CalibrationSetError(fmt::format(
        "{}: all positions lie within {:.3g} of base and {:.3g} of each other: are they in metres? "
        "Give millimetres",
        path, farthest, spread));
}

}  // namespace

Target read_target_file(const std::string& path) {
  PlateKeys keys;
  try {
    const YAML::Node root = YAML::LoadFile(path);
    if (!root.IsMap()) throw CalibrationSetError(path + ": must be a map of keys to values");
    SectionReader reader(path, "plate", root);
    keys.visit(reader);
    reader.refuse_unknown_keys();
  } catch (const YAML::BadFile&) {
    throw CalibrationSetError(path + ": is missing or cannot be read: it describes the plate");
  } catch (const YAML::Exception& error) {
    throw CalibrationSetError(
        fmt::format("{}:{}: not YAML: {}", path, error.mark.line + 1, error.msg));
  } catch (const ConfigurationError& error) {
    throw CalibrationSetError(error.what());
  }
  if (const std::string error = plate_error(keys); !error.empty())
    throw CalibrationSetError(path + ": " + error);
  Target plate;
  plate.pattern = keys.pattern == "circles"      ? TargetPattern::circles
                  : keys.pattern == "chessboard" ? TargetPattern::chessboard
                                                 : TargetPattern::asymmetric_circles;
  plate.columns = keys.columns;
  plate.rows = keys.rows;
  plate.pitch_mm = keys.pitch_mm;
  plate.radius_mm = keys.radius_mm;
  plate.origin_dot_radius_mm = keys.origin_dot_radius_mm;
  return plate;
}

std::map<int, RigidTransform> read_poses_file(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw CalibrationSetError(path +
                              ": is missing or cannot be read: it says index,x,y,z,qw,qx,qy,qz of "
                              "each pose, tool in base, mm");
  std::map<int, RigidTransform> poses;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with("#") ||
        (number == 1 && line.starts_with("index")))
      continue;
    const std::string where = fmt::format("{}:{}", path, number);
    const auto n = numbers_of_line(line, where);
    if (n[0] != std::floor(n[0]) || n[0] < 0 || n[0] > 1e6)
      throw CalibrationSetError(fmt::format("{}: index {} is no image's number", where, n[0]));
    const Eigen::Quaterniond rotation(n[4], n[5], n[6], n[7]);
    if (!(std::abs(rotation.norm() - 1) < 1e-3))
      throw CalibrationSetError(fmt::format(
          "{}: the quaternion has length {:.4g}, not 1: give qw,qx,qy,qz", where, rotation.norm()));
    const auto pose = make_transform({n[1], n[2], n[3]}, rotation);
    if (!poses.emplace(static_cast<int>(n[0]), pose).second)
      throw CalibrationSetError(fmt::format("{}: index {} stands there twice", where, n[0]));
  }
  if (poses.empty()) throw CalibrationSetError(path + ": holds no pose");
  refuse_metres(poses, path);
  return poses;
}

}  // namespace arcstart::calibration
