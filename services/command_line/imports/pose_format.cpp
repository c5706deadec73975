#include "services/command_line/imports/pose_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

namespace arcstart::command_line {
namespace {

constexpr double kUnitTolerance = 1e-3;  // of a length of 1, a product of 0: four written digits

// Of a table's columns alone: an orientation is told from others of the same size by its names.
constexpr const char* kMatrixColumns = "r11,r12,r13,tx,r21,r22,r23,ty,r31,r32,r33,tz (and 0,0,0,1)";

std::string name_of(PoseFormat format) {
  for (const auto& [name, value] : pose_formats())
    if (value == format) return name;
  return "";
}

RigidTransform of_quaternion(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation,
                             std::string& why) {
  if (!(std::abs(rotation.norm() - 1) <= kUnitTolerance)) {
    why = fmt::format("the quaternion has length {:.4g}, not 1: choose its --pose-format",
                      rotation.norm());
    return RigidTransform::Identity();
  }
  return make_transform(position, rotation);
}

RigidTransform of_wpr(const Eigen::Vector3d& position, std::span<const double> wpr) {
  const auto turn = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * kDegree, axis);
  };
  return make_transform(position, turn(wpr[2], Eigen::Vector3d::UnitZ()) *
                                      turn(wpr[1], Eigen::Vector3d::UnitY()) *
                                      turn(wpr[0], Eigen::Vector3d::UnitX()));
}

RigidTransform of_rotvec(const Eigen::Vector3d& position, const Eigen::Vector3d& vector,
                         std::string& why) {
  const double angle = vector.norm();
  if (angle > 2 * std::numbers::pi + kUnitTolerance) {
    why = fmt::format(
        "the rotation vector has length {:.4g}, more than 2 pi: it wants rad; W, P, R in degrees "
        "are --pose-format wpr",
        angle);
    return RigidTransform::Identity();
  }
  return make_transform(position,
                        Eigen::Quaterniond(angle == 0 ? Eigen::AngleAxisd::Identity()
                                                      : Eigen::AngleAxisd(angle, vector / angle)));
}

RigidTransform of_matrix(double unit_mm, std::span<const double> numbers, std::string& why) {
  using RowByRow = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const RowByRow rows = Eigen::Map<const RowByRow>(numbers.data());
  const Eigen::Matrix3d rotation = rows.leftCols<3>();
  const bool orthogonal =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <=
      kUnitTolerance;
  if (numbers.size() == 16 &&
      (numbers[12] != 0 || numbers[13] != 0 || numbers[14] != 0 || numbers[15] != 1))
    why = "the matrix's last row is not 0,0,0,1: write it row by row, not column by column";
  else if (!orthogonal)
    why = "the matrix's first three columns are no rotation: write r11,r12,r13,tx, r21 and so on";
  else if (rotation.determinant() < 0)
    why = "the matrix mirrors (determinant -1): a right-handed base and tool are wanted";
  if (!why.empty()) return RigidTransform::Identity();
  return make_transform(rows.col(3) * unit_mm, Eigen::Quaterniond(rotation));
}

// A column's name in small letters, and the unit it ends with: "x", "mm" of X_mm.
struct ColumnName {
  std::string name, unit;
};

ColumnName column_name(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* unit : {"mm", "m", "inch", "in", "deg", "rad"})
    if (text.ends_with(fmt::format("_{}", unit)))
      return {text.substr(0, text.rfind('_')), std::string(unit) == "in" ? "inch" : unit};
  return {text, ""};
}

// The unit of a column of this format: of a position that given, of an angle its own.
std::string unit_of(PoseFormat format, std::size_t column, const std::string& length) {
  if (column < 3) return length;
  if (format == PoseFormat::kWpr) return "deg";
  return format == PoseFormat::kRotvec ? "rad" : "";
}

}  // namespace

const std::map<std::string, PoseFormat>& pose_formats() {
  static const std::map<std::string, PoseFormat> formats = {{"wxyz", PoseFormat::kWxyz},
                                                            {"xyzw", PoseFormat::kXyzw},
                                                            {"wpr", PoseFormat::kWpr},
                                                            {"rotvec", PoseFormat::kRotvec},
                                                            {"matrix", PoseFormat::kMatrix}};
  return formats;
}

const std::map<std::string, double>& length_units() {
  static const std::map<std::string, double> units = {{"mm", 1}, {"m", 1000}, {"inch", 25.4}};
  return units;
}

std::string pose_columns(PoseFormat format) {
  switch (format) {
    case PoseFormat::kWxyz:
      return "x,y,z,qw,qx,qy,qz";
    case PoseFormat::kXyzw:
      return "x,y,z,qx,qy,qz,qw";
    case PoseFormat::kWpr:
      return "x,y,z,w,p,r";
    case PoseFormat::kRotvec:
      return "x,y,z,rx,ry,rz";
    case PoseFormat::kMatrix:
      break;
  }
  return kMatrixColumns;
}

bool is_pose_size(PoseFormat format, std::size_t numbers) {
  if (format == PoseFormat::kMatrix) return numbers == 12 || numbers == 16;
  return numbers == (format == PoseFormat::kWxyz || format == PoseFormat::kXyzw ? 7 : 6);
}

RigidTransform pose_of(PoseFormat format, double unit_mm, std::span<const double> numbers,
                       std::string& why) {
  why.clear();
  const Eigen::Vector3d position = Eigen::Map<const Eigen::Vector3d>(numbers.data()) * unit_mm;
  const auto rest = numbers.subspan(3);
  switch (format) {
    case PoseFormat::kWxyz:
      return of_quaternion(position, {rest[0], rest[1], rest[2], rest[3]}, why);
    case PoseFormat::kXyzw:
      return of_quaternion(position, {rest[3], rest[0], rest[1], rest[2]}, why);
    case PoseFormat::kWpr:
      return of_wpr(position, rest);
    case PoseFormat::kRotvec:
      return of_rotvec(position, {rest[0], rest[1], rest[2]}, why);
    case PoseFormat::kMatrix:
      break;
  }
  return of_matrix(unit_mm, numbers, why);
}

std::string header_error(PoseFormat format, const std::string& unit,
                         const std::vector<std::string>& header, const std::string& first) {
  std::vector<std::string> names;
  for (const std::string& text : header) names.push_back(column_name(text).name);
  const std::string said = fmt::format("{}", fmt::join(names, ","));
  if (names.front() != first)
    return fmt::format("the first column is {}, not {}", header.front(), first);
  for (const auto& [name, other] : pose_formats()) {
    if (other == format || other == PoseFormat::kMatrix ||
        said != first + "," + pose_columns(other))
      continue;
    return fmt::format("the columns {} are those of --pose-format {}, not of {}", said, name,
                       name_of(format));
  }
  if (format == PoseFormat::kMatrix) return "";
  if (said != first + "," + pose_columns(format))
    return fmt::format("the columns are {}, those of --pose-format {} are {},{}", said,
                       name_of(format), first, pose_columns(format));
  for (std::size_t i = 1; i < header.size(); ++i) {
    const std::string told = column_name(header[i]).unit, wanted = unit_of(format, i - 1, unit);
    if (!told.empty() && told != wanted)
      return fmt::format("column {} is in {}, {}", header[i], told,
                         i <= 3 ? fmt::format("--pose-units says {}", wanted)
                                : fmt::format("--pose-format {} wants {}", name_of(format),
                                              wanted.empty() ? "no unit" : wanted));
  }
  return "";
}

}  // namespace arcstart::command_line
