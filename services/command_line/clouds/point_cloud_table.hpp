// What the point cloud formats have in common: a header of text, then a table of points.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/command_line/clouds/point_cloud.hpp"

namespace arcstart::command_line {

// Throws PointCloudFileError, "name: why".
[[noreturn]] void fail_to_read(const std::string& name, const std::string& why);

enum class FieldKind { kFloat, kSigned, kUnsigned };

// One column of the table of points.
struct PointField {
  std::string name;
  FieldKind kind = FieldKind::kFloat;
  std::size_t size = 4;   // bytes of one value
  std::size_t count = 1;  // values
};

// Where the points lie in the file and how.
struct PointTable {
  std::vector<PointField> fields;
  std::size_t points = 0;
  bool big_endian = false;   // of a binary table
  bool field_major = false;  // likewise: all points' first field, then all points' second
};

constexpr std::size_t kMostFields = 256;
constexpr std::size_t kLongestHeaderLine = 4096;
constexpr int kMostHeaderLines = 1000;

// Takes line after line and word after word out of the file's bytes.
class HeaderText {
 public:
  HeaderText(std::string_view bytes, const std::string& name) : left_(bytes), name_(name) {}

  std::string_view line() {
    const std::size_t end = left_.find('\n');
    if (end == std::string_view::npos || end > kLongestHeaderLine || ++lines_ > kMostHeaderLines)
      fail_to_read(name_, "its header does not end: not a point cloud, or damaged");
    std::string_view line = left_.substr(0, end);
    left_.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }
  std::string_view word() {
    std::size_t i = 0;
    while (i < left_.size() && space(left_[i])) ++i;
    std::size_t end = i;
    while (end < left_.size() && !space(left_[end])) ++end;
    const std::string_view word = left_.substr(i, end - i);
    left_.remove_prefix(end);
    return word;
  }
  std::string_view left() const { return left_; }
  static bool space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

 private:
  std::string_view left_;
  const std::string& name_;
  int lines_ = 0;
};

std::vector<std::string_view> words_of(std::string_view line);

// What stands behind "WIDTH" or "element". Throws where it is no count.
std::size_t count_of(std::string_view word, const std::string& name, const std::string& what);

// Nothing for a word that is no number; not finite for one that no double holds.
std::optional<double> number_of(std::string_view word);

// A point that is not finite, or lies beyond any cell, is counted as skipped.
void take_point(PointCloud& cloud, const Eigen::Vector3d& point);

// Both take the points in, and throw where the table lacks x, y or z or is longer than what there
// is of it.
void read_binary_table(PointCloud& cloud, const PointTable& table, std::string_view bytes,
                       const std::string& name);
void read_ascii_table(PointCloud& cloud, const PointTable& table, HeaderText& text,
                      const std::string& name);

// PCD, version 0.7 and before (pcl/io/pcd_io.h): ascii, binary and binary_compressed.
PointCloud parse_pcd(std::string_view bytes, const std::string& name);

// PLY 1.0: ascii, binary_little_endian and binary_big_endian.
PointCloud parse_ply(std::string_view bytes, const std::string& name);

// A point a line, as XYZ, TXT, ASC, PTS and CSV files have it: numbers separated by spaces, tabs,
// commas or semicolons, of which the first three are x, y and z, unless a line before them names
// the columns. Lines that begin with # or // are left out.
bool is_text_table(std::string_view bytes);
PointCloud parse_text_table(std::string_view bytes, const std::string& name);

}  // namespace arcstart::command_line
