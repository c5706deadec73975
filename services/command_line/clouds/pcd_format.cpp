#include <fmt/core.h>
#include <liblzf/lzf.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "services/command_line/clouds/point_cloud_table.hpp"

namespace arcstart::command_line {
namespace {

std::size_t header_count(const std::vector<std::string_view>& words, const std::string& name) {
  if (words.size() != 2)
    fail_to_read(name, fmt::format("its header line {} needs one number", words[0]));
  return count_of(words[1], name, std::string(words[0]));
}

void read_pcd_column(std::vector<PointField>& fields, const std::vector<std::string_view>& words,
                     const std::string& name) {
  if (words.size() != fields.size() + 1)
    fail_to_read(name, fmt::format("its header names {} fields, but {} for {}", fields.size(),
                                   words.size() - 1, words[0]));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view word = words[i + 1];
    if (words[0] == "TYPE") {
      if (word != "F" && word != "I" && word != "U")
        fail_to_read(name, fmt::format("its TYPE {:.20} is not F, I or U", word));
      fields[i].kind = word == "F"   ? FieldKind::kFloat
                       : word == "I" ? FieldKind::kSigned
                                     : FieldKind::kUnsigned;
    } else if (words[0] == "SIZE") {
      fields[i].size = count_of(word, name, "SIZE");
    } else {
      fields[i].count = count_of(word, name, "COUNT");
      if (fields[i].count < 1 || fields[i].count > 100000)
        fail_to_read(name, fmt::format("its header says COUNT {}, which is no possible count",
                                       fields[i].count));
    }
  }
}

void read_pcd_viewpoint(PointCloud& cloud, const std::vector<std::string_view>& words,
                        const std::string& name) {
  Eigen::Vector3d position;
  if (words.size() != 8) fail_to_read(name, "its VIEWPOINT needs 7 numbers");
  for (int axis = 0; axis < 3; ++axis) {
    const auto number = number_of(words[static_cast<std::size_t>(axis) + 1]);
    if (!number || !std::isfinite(*number))
      fail_to_read(name, "its VIEWPOINT has no finite position");
    position[axis] = *number;
  }
  if (!position.isZero()) cloud.viewpoint = position;
}

void check_sizes(const std::vector<PointField>& fields, const std::string& name) {
  for (const PointField& field : fields) {
    const bool possible = field.kind == FieldKind::kFloat ? field.size == 4 || field.size == 8
                                                          : field.size == 1 || field.size == 2 ||
                                                                field.size == 4 || field.size == 8;
    if (!possible)
      fail_to_read(
          name, fmt::format("its field {:.40} has an impossible SIZE {}", field.name, field.size));
  }
}

// LZF's longest copy: 3 bytes stand for 264.
constexpr std::size_t kMostGrowth = 88;

// Two sizes, compressed and not, and the table field by field (pcl::PCDWriter).
void read_compressed_table(PointCloud& cloud, PointTable& table, std::string_view bytes,
                           const std::string& name) {
  std::uint32_t sizes[2] = {};
  if (bytes.size() < sizeof sizes)
    fail_to_read(name, "its compressed points are missing: the file is cut off");
  std::memcpy(sizes, bytes.data(), sizeof sizes);
  bytes.remove_prefix(sizeof sizes);
  if (sizes[0] > bytes.size())
    fail_to_read(name,
                 fmt::format("it promises {} compressed bytes, {} follow: the file is cut off",
                             sizes[0], bytes.size()));
  if (sizes[1] / kMostGrowth > sizes[0])
    fail_to_read(name, fmt::format("{} compressed bytes cannot hold {}", sizes[0], sizes[1]));
  std::string plain(sizes[1], '\0');
  if (lzf_decompress(bytes.data(), sizes[0], plain.data(), sizes[1]) != sizes[1])
    fail_to_read(name, "its compressed points are damaged");
  table.field_major = true;
  read_binary_table(cloud, table, plain, name);
}

}  // namespace

PointCloud parse_pcd(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  PointTable table;
  HeaderText text(bytes, name);
  std::optional<std::size_t> width, height, points;
  std::string data;
  while (data.empty()) {
    const auto words = words_of(text.line());
    if (words.empty() || words[0].front() == '#' || words[0] == "VERSION") continue;
    if (words[0] == "FIELDS" || words[0] == "COLUMNS") {
      if (words.size() > kMostFields) fail_to_read(name, "its header names too many fields");
      table.fields.clear();
      for (std::size_t i = 1; i < words.size(); ++i)
        table.fields.push_back({std::string(words[i]), FieldKind::kFloat, 4, 1});
    } else if (words[0] == "SIZE" || words[0] == "TYPE" || words[0] == "COUNT") {
      read_pcd_column(table.fields, words, name);
    } else if (words[0] == "WIDTH") {
      width = header_count(words, name);
    } else if (words[0] == "HEIGHT") {
      height = header_count(words, name);
    } else if (words[0] == "POINTS") {
      points = header_count(words, name);
    } else if (words[0] == "VIEWPOINT") {
      read_pcd_viewpoint(cloud, words, name);
    } else if (words[0] == "DATA") {
      data = words.size() == 2 ? std::string(words[1]) : "nothing";
    } else {
      fail_to_read(
          name, fmt::format("its header has a line '{:.40}', which PCD does not know", words[0]));
    }
  }
  check_sizes(table.fields, name);
  if (!width) fail_to_read(name, "its header has no WIDTH");
  if (*width != 0 && height.value_or(1) > std::numeric_limits<std::size_t>::max() / *width)
    fail_to_read(name, "its header's WIDTH times HEIGHT is impossible");
  table.points = *width * height.value_or(1);
  if (points && *points != table.points)
    fail_to_read(name, fmt::format("its header says POINTS {}, but WIDTH times HEIGHT is {}",
                                   *points, table.points));
  if (data == "binary") {
    read_binary_table(cloud, table, text.left(), name);
  } else if (data == "ascii") {
    read_ascii_table(cloud, table, text, name);
  } else if (data == "binary_compressed") {
    read_compressed_table(cloud, table, text.left(), name);
  } else {
    fail_to_read(
        name,
        fmt::format("its DATA is '{:.40}', must be ascii, binary or binary_compressed", data));
  }
  return cloud;
}

}  // namespace arcstart::command_line
