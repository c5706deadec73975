#include "services/command_line/imports/pose_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/command_line/imports/import_error.hpp"
#include "services/command_line/imports/pose_format.hpp"

namespace arcstart::command_line {
namespace {

// A length unit slipped: no scan is as short as these, no robot reaches as far.
constexpr double kNearest = 10, kSmallestSpread = 3;  // mm
constexpr double kFarthest = 100'000;                 // mm

// Within pi degrees of the base's axes all through: hardly a tool, but a slip that is often made.
bool may_be_radians(const std::vector<std::vector<double>>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](const std::vector<double>& pose) {
    return std::all_of(pose.begin() + 3, pose.end(),
                       [](double angle) { return std::abs(angle) <= std::numbers::pi + 1e-3; });
  });
}

}  // namespace

void refuse_other_unit(const std::vector<RigidTransform>& poses, const PoseConvention& convention,
                       const std::string& path) {
  double farthest = 0, spread = 0;
  for (const RigidTransform& pose : poses) {
    const Eigen::Vector3d& position = pose.translation();
    farthest = std::max(farthest, position.norm());
    spread = std::max(spread, (position - poses.front().translation()).norm());
  }
  if (poses.size() > 1 && farthest < kNearest && spread < kSmallestSpread)
    throw ImportError(fmt::format(
        "{}: all positions lie within {:.3g} mm of base: are they in another unit than {}? Choose "
        "it by --pose-units",
        path, farthest, convention.unit));
  if (farthest > kFarthest)
    throw ImportError(
        fmt::format("{}: positions lie {:.3g} m from base: are they in another unit than {}? "
                    "Choose it by --pose-units",
                    path, farthest / 1000, convention.unit));
}

PoseTable read_pose_table(const std::string& path, const std::string& first,
                          const PoseConvention& convention, std::vector<std::string>& notes) {
  const PoseFormat format = pose_formats().at(convention.format);
  const double unit_mm = length_units().at(convention.unit);
  const std::string columns = first + "," + pose_columns(format);
  PoseTable poses{read_csv(path, columns + ", tool in base"), {}};
  const CsvTable& table = poses.table;
  if (!table.header.fields.empty())
    if (const auto error = header_error(format, convention.unit, table.header.fields, first);
        !error.empty())
      throw ImportError(fmt::format("{}: {}", table.where(table.header), error));
  std::vector<std::vector<double>> all_numbers;
  for (const CsvRow& row : table.rows) {
    if (!is_pose_size(format, row.fields.size() - 1))
      throw ImportError(fmt::format("{}: {} columns: --pose-format {} has {}", table.where(row),
                                    row.fields.size(), convention.format, columns));
    std::vector<double> numbers;
    for (std::size_t column = 1; column < row.fields.size(); ++column)
      numbers.push_back(number_at(table, row, column));
    std::string why;
    poses.T_base_tool.push_back(pose_of(format, unit_mm, numbers, why));
    if (!why.empty()) throw ImportError(fmt::format("{}: {}", table.where(row), why));
    all_numbers.push_back(std::move(numbers));
  }
  refuse_other_unit(poses.T_base_tool, convention, path);
  if (format == PoseFormat::kWpr && may_be_radians(all_numbers))
    notes.push_back(path + ": no angle is above 3.15 degrees: are they in rad? wpr wants degrees");
  return poses;
}

std::vector<StampedPose> read_pose_file(const std::string& path, const PoseConvention& convention,
                                        std::vector<std::string>& notes) {
  const PoseTable read = read_pose_table(path, "utime", convention, notes);
  std::vector<StampedPose> poses;
  for (const CsvRow& row : read.table.rows) {
    const std::int64_t utime = utime_at(read.table, row, 0);
    if (!poses.empty() && utime <= poses.back().utime)
      throw ImportError(fmt::format("{}: its time, {}, is not later than that of the row before",
                                    read.table.where(row), utime));
    poses.push_back({utime, read.T_base_tool[poses.size()]});
  }
  if (poses.size() < 2)
    throw ImportError(path +
                      ": holds a single pose: at least two are wanted, before the first "
                      "image and after the last");
  return poses;
}

}  // namespace arcstart::command_line
