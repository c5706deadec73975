#include "services/command_line/clouds/point_cloud_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

namespace arcstart::command_line {
namespace {

template <class T>
double load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double value_at(const char* bytes, const PointField& field, bool big_endian) {
  std::array<char, 8> reversed;
  if (big_endian) {
    std::reverse_copy(bytes, bytes + field.size, reversed.begin());
    bytes = reversed.data();
  }
  if (field.kind == FieldKind::kFloat)
    return field.size == 8 ? load<double>(bytes) : load<float>(bytes);
  const bool is_signed = field.kind == FieldKind::kSigned;
  switch (field.size) {
    case 1:
      return is_signed ? load<std::int8_t>(bytes) : load<std::uint8_t>(bytes);
    case 2:
      return is_signed ? load<std::int16_t>(bytes) : load<std::uint16_t>(bytes);
    case 4:
      return is_signed ? load<std::int32_t>(bytes) : load<std::uint32_t>(bytes);
    default:
      return is_signed ? load<std::int64_t>(bytes) : load<std::uint64_t>(bytes);
  }
}

// The values' columns of x, y and z, counted in values, and the bytes before them.
struct Columns {
  std::array<std::size_t, 3> field, value, byte;
  std::size_t values = 0, bytes = 0;
};

Columns columns_of(const PointTable& table, const std::string& name) {
  Columns columns;
  std::array<bool, 3> seen{};
  for (std::size_t i = 0; i < table.fields.size(); ++i) {
    const PointField& field = table.fields[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (field.name != std::string(1, "xyz"[axis]) || seen[axis]) continue;
      if (field.count != 1)
        fail_to_read(name, fmt::format("its field {} holds {} values", field.name, field.count));
      seen[axis] = true;
      columns.field[axis] = i;
      columns.value[axis] = columns.values;
      columns.byte[axis] = columns.bytes;
    }
    columns.values += field.count;
    columns.bytes += field.count * field.size;
  }
  if (!seen[0] || !seen[1] || !seen[2]) fail_to_read(name, "it has no fields x, y and z");
  return columns;
}

}  // namespace

void fail_to_read(const std::string& name, const std::string& why) {
  throw PointCloudFileError(name + ": " + why);
}

void take_point(PointCloud& cloud, const Eigen::Vector3d& point) {
  if (point.allFinite() && point.cwiseAbs().maxCoeff() < 1e9)
    cloud.points.push_back(point);
  else
    ++cloud.skipped;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && HeaderText::space(line[i])) ++i;
    std::size_t end = i;
    while (end < line.size() && !HeaderText::space(line[end])) ++end;
    if (end > i) words.push_back(line.substr(i, end - i));
    i = end;
  }
  return words;
}

std::size_t count_of(std::string_view word, const std::string& name, const std::string& what) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    fail_to_read(name,
                 fmt::format("its header says {} {:.40}, which is no possible count", what, word));
  return value;
}

std::optional<double> number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::quiet_NaN();
  if (error != std::errc()) return std::nullopt;
  return value;
}

void read_binary_table(PointCloud& cloud, const PointTable& table, std::string_view bytes,
                       const std::string& name) {
  const Columns columns = columns_of(table, name);
  if (table.points > bytes.size() / columns.bytes)
    fail_to_read(name,
                 fmt::format("its header promises {} points of {} bytes, {} bytes follow: the file "
                             "is cut off, or its "
                             "header wrong",
                             table.points, columns.bytes, bytes.size()));
  cloud.points.reserve(table.points);
  for (std::size_t i = 0; i < table.points; ++i) {
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const PointField& field = table.fields[columns.field[axis]];
      const std::size_t at = table.field_major ? columns.byte[axis] * table.points + i * field.size
                                               : i * columns.bytes + columns.byte[axis];
      point[static_cast<int>(axis)] = value_at(bytes.data() + at, field, table.big_endian);
    }
    take_point(cloud, point);
  }
}

void read_ascii_table(PointCloud& cloud, const PointTable& table, HeaderText& text,
                      const std::string& name) {
  const Columns columns = columns_of(table, name);
  // A value takes two characters at least, its own and the space after it.
  if (table.points > (text.left().size() + 1) / (2 * columns.values))
    fail_to_read(
        name, fmt::format("its header promises {} points of {} values, {} characters follow: the "
                          "file is cut off, or "
                          "its header wrong",
                          table.points, columns.values, text.left().size()));
  cloud.points.reserve(table.points);
  for (std::size_t i = 0; i < table.points; ++i) {
    Eigen::Vector3d point;
    for (std::size_t value = 0; value < columns.values; ++value) {
      const std::string_view word = text.word();
      if (word.empty())
        fail_to_read(name, fmt::format("it ends in point {} of {}: the file is cut off", i + 1,
                                       table.points));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (columns.value[axis] != value) continue;
        const auto number = number_of(word);
        if (!number)
          fail_to_read(name, fmt::format("point {}: '{:.40}' is no number", i + 1, word));
        point[static_cast<int>(axis)] = *number;
      }
    }
    take_point(cloud, point);
  }
}

}  // namespace arcstart::command_line
