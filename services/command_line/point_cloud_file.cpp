#include "services/command_line/point_cloud_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>

namespace arcstart {
namespace {

constexpr std::size_t kLongestHeaderLine = 4096;
constexpr int kMostHeaderLines = 1000;
constexpr std::size_t kMostFields = 256;

[[noreturn]] void fail(const std::string& name, const std::string& why) {
  throw PointCloudFileError(name + ": " + why);
}

enum class Kind { kFloat, kSigned, kUnsigned };

// One column of the table of points.
struct Field {
  std::string name;
  Kind kind = Kind::kFloat;
  std::size_t size = 4;   // bytes of one value
  std::size_t count = 1;  // values
};

// Where the points lie in the file and how.
struct Table {
  std::vector<Field> fields;
  std::size_t points = 0;
  bool binary = false;
};

// Takes line after line and word after word out of the file's bytes.
class Text {
 public:
  Text(std::string_view bytes, const std::string& name) : left_(bytes), name_(name) {}

  std::string_view line() {
    const std::size_t end = left_.find('\n');
    if (end == std::string_view::npos || end > kLongestHeaderLine || ++lines_ > kMostHeaderLines)
      fail(name_, "its header does not end: not a point cloud, or damaged");
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

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && Text::space(line[i])) ++i;
    std::size_t end = i;
    while (end < line.size() && !Text::space(line[end])) ++end;
    if (end > i) words.push_back(line.substr(i, end - i));
    i = end;
  }
  return words;
}

std::size_t count_of(std::string_view word, const std::string& name, const char* what) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    fail(name, fmt::format("its header says {} {:.40}, which is no possible count", what, word));
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

template <class T>
double load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double value_at(const char* bytes, const Field& field) {
  if (field.kind == Kind::kFloat) return field.size == 8 ? load<double>(bytes) : load<float>(bytes);
  const bool is_signed = field.kind == Kind::kSigned;
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

void take(PointCloud& cloud, const Eigen::Vector3d& point) {
  if (point.allFinite() && point.cwiseAbs().maxCoeff() < 1e9)
    cloud.points.push_back(point);
  else
    ++cloud.skipped;
}

// The values' columns of x, y and z, counted in values, and the bytes before them.
struct Columns {
  std::array<std::size_t, 3> field, value, byte;
  std::size_t values = 0, bytes = 0;
};

Columns columns_of(const Table& table, const std::string& name) {
  Columns columns;
  std::array<bool, 3> seen{};
  for (std::size_t i = 0; i < table.fields.size(); ++i) {
    const Field& field = table.fields[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (field.name != std::string(1, "xyz"[axis]) || seen[axis]) continue;
      if (field.count != 1)
        fail(name, fmt::format("its field {} holds {} values", field.name, field.count));
      seen[axis] = true;
      columns.field[axis] = i;
      columns.value[axis] = columns.values;
      columns.byte[axis] = columns.bytes;
    }
    columns.values += field.count;
    columns.bytes += field.count * field.size;
  }
  if (!seen[0] || !seen[1] || !seen[2]) fail(name, "it has no fields x, y and z");
  return columns;
}

void read_binary(PointCloud& cloud, const Table& table, std::string_view bytes,
                 const std::string& name) {
  const Columns columns = columns_of(table, name);
  if (table.points > bytes.size() / columns.bytes)
    fail(name, fmt::format("its header promises {} points of {} bytes, {} bytes follow: the file "
                           "is cut off, or its "
                           "header wrong",
                           table.points, columns.bytes, bytes.size()));
  cloud.points.reserve(table.points);
  for (std::size_t i = 0; i < table.points; ++i) {
    const char* row = bytes.data() + i * columns.bytes;
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[static_cast<int>(axis)] =
          value_at(row + columns.byte[axis], table.fields[columns.field[axis]]);
    take(cloud, point);
  }
}

void read_ascii(PointCloud& cloud, const Table& table, Text& text, const std::string& name) {
  const Columns columns = columns_of(table, name);
  // A value takes two characters at least, its own and the space after it.
  if (table.points > (text.left().size() + 1) / (2 * columns.values))
    fail(name, fmt::format("its header promises {} points of {} values, {} characters follow: the "
                           "file is cut off, or "
                           "its header wrong",
                           table.points, columns.values, text.left().size()));
  cloud.points.reserve(table.points);
  for (std::size_t i = 0; i < table.points; ++i) {
    Eigen::Vector3d point;
    for (std::size_t value = 0; value < columns.values; ++value) {
      const std::string_view word = text.word();
      if (word.empty())
        fail(name,
             fmt::format("it ends in point {} of {}: the file is cut off", i + 1, table.points));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (columns.value[axis] != value) continue;
        const auto number = number_of(word);
        if (!number) fail(name, fmt::format("point {}: '{:.40}' is no number", i + 1, word));
        point[static_cast<int>(axis)] = *number;
      }
    }
    take(cloud, point);
  }
}

// ---- PCD, version 0.7 and before (pcl/io/pcd_io.h)

std::size_t header_count(const std::vector<std::string_view>& words, const std::string& name) {
  if (words.size() != 2) fail(name, fmt::format("its header line {} needs one number", words[0]));
  return count_of(words[1], name, std::string(words[0]).c_str());
}

void read_pcd_column(std::vector<Field>& fields, const std::vector<std::string_view>& words,
                     const std::string& name) {
  if (words.size() != fields.size() + 1)
    fail(name, fmt::format("its header names {} fields, but {} for {}", fields.size(),
                           words.size() - 1, words[0]));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view word = words[i + 1];
    if (words[0] == "TYPE") {
      if (word != "F" && word != "I" && word != "U")
        fail(name, fmt::format("its TYPE {:.20} is not F, I or U", word));
      fields[i].kind = word == "F" ? Kind::kFloat : word == "I" ? Kind::kSigned : Kind::kUnsigned;
    } else if (words[0] == "SIZE") {
      fields[i].size = count_of(word, name, "SIZE");
    } else {
      fields[i].count = count_of(word, name, "COUNT");
      if (fields[i].count < 1 || fields[i].count > 100000)
        fail(name,
             fmt::format("its header says COUNT {}, which is no possible count", fields[i].count));
    }
  }
}

void read_pcd_viewpoint(PointCloud& cloud, const std::vector<std::string_view>& words,
                        const std::string& name) {
  Eigen::Vector3d position;
  if (words.size() != 8) fail(name, "its VIEWPOINT needs 7 numbers");
  for (int axis = 0; axis < 3; ++axis) {
    const auto number = number_of(words[static_cast<std::size_t>(axis) + 1]);
    if (!number || !std::isfinite(*number)) fail(name, "its VIEWPOINT has no finite position");
    position[axis] = *number;
  }
  if (!position.isZero()) cloud.viewpoint = position;
}

void check_sizes(const std::vector<Field>& fields, const std::string& name) {
  for (const Field& field : fields) {
    const bool possible = field.kind == Kind::kFloat ? field.size == 4 || field.size == 8
                                                     : field.size == 1 || field.size == 2 ||
                                                           field.size == 4 || field.size == 8;
    if (!possible)
      fail(name, fmt::format("its field {:.40} has an impossible SIZE {}", field.name, field.size));
  }
}

PointCloud parse_pcd(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  Table table;
  Text text(bytes, name);
  std::optional<std::size_t> width, height, points;
  std::string data;
  while (data.empty()) {
    const auto words = words_of(text.line());
    if (words.empty() || words[0].front() == '#' || words[0] == "VERSION") continue;
    if (words[0] == "FIELDS" || words[0] == "COLUMNS") {
      if (words.size() > kMostFields) fail(name, "its header names too many fields");
      table.fields.clear();
      for (std::size_t i = 1; i < words.size(); ++i)
        table.fields.push_back({std::string(words[i]), Kind::kFloat, 4, 1});
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
      fail(name, fmt::format("its header has a line '{:.40}', which PCD does not know", words[0]));
    }
  }
  check_sizes(table.fields, name);
  if (!width) fail(name, "its header has no WIDTH");
  if (*width != 0 && height.value_or(1) > std::numeric_limits<std::size_t>::max() / *width)
    fail(name, "its header's WIDTH times HEIGHT is impossible");
  table.points = *width * height.value_or(1);
  if (points && *points != table.points)
    fail(name, fmt::format("its header says POINTS {}, but WIDTH times HEIGHT is {}", *points,
                           table.points));
  if (data == "binary") {
    read_binary(cloud, table, text.left(), name);
  } else if (data == "ascii") {
    read_ascii(cloud, table, text, name);
  } else if (data == "binary_compressed") {
    fail(name,
         "binary_compressed PCD is not read: convert it by `pcl_convert_pcd_ascii_binary IN.pcd "
         "OUT.pcd 1`");
  } else {
    fail(name, fmt::format("its DATA is '{:.40}', must be ascii or binary", data));
  }
  return cloud;
}

// ---- PLY 1.0

Field ply_field(const std::vector<std::string_view>& words, const std::string& name) {
  struct Type {
    const char* name;
    const char* sized_name;
    Kind kind;
    std::size_t size;
  };
  static constexpr Type kTypes[] = {
      {"char", "int8", Kind::kSigned, 1},    {"uchar", "uint8", Kind::kUnsigned, 1},
      {"short", "int16", Kind::kSigned, 2},  {"ushort", "uint16", Kind::kUnsigned, 2},
      {"int", "int32", Kind::kSigned, 4},    {"uint", "uint32", Kind::kUnsigned, 4},
      {"float", "float32", Kind::kFloat, 4}, {"double", "float64", Kind::kFloat, 8},
  };
  if (words.size() == 3)
    for (const Type& type : kTypes)
      if (words[1] == type.name || words[1] == type.sized_name)
        return {std::string(words[2]), type.kind, type.size, 1};
  fail(name, "its header has a property of unknown type");
}

PointCloud parse_ply(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  Table table;
  Text text(bytes, name);
  std::string format;
  enum { kBefore, kVertex, kAfter } part = kBefore;
  text.line();
  for (;;) {
    const auto words = words_of(text.line());
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      format = words.size() == 3 ? std::string(words[1]) : "nothing";
    } else if (words[0] == "element") {
      if (words.size() != 3) fail(name, "its header has an element without name or count");
      const std::size_t count = count_of(words[2], name, "element");
      if (words[1] == "vertex" && part == kBefore) {
        part = kVertex;
        table.points = count;
      } else if (part == kBefore && count > 0) {
        fail(name, fmt::format("its first element is '{:.40}', must be vertex", words[1]));
      } else if (part == kVertex) {
        part = kAfter;
      }
    } else if (words[0] == "property") {
      if (part != kVertex) continue;
      if (words.size() > 1 && words[1] == "list")
        fail(name, "its vertices hold lists, which no point cloud does");
      if (table.fields.size() >= kMostFields) fail(name, "its header names too many properties");
      table.fields.push_back(ply_field(words, name));
    } else {
      fail(name, fmt::format("its header has a line '{:.40}', which PLY does not know", words[0]));
    }
  }
  if (part == kBefore) fail(name, "its header has no element vertex");
  if (format == "binary_little_endian") {
    read_binary(cloud, table, text.left(), name);
  } else if (format == "ascii") {
    read_ascii(cloud, table, text, name);
  } else {
    fail(name,
         fmt::format("its format is '{:.40}', must be ascii or binary_little_endian", format));
  }
  return cloud;
}

// ---- writing

void write(const std::string& path, const std::string& header,
           const std::vector<Eigen::Vector3d>& points, const std::vector<Colour>& colours,
           bool colour_as_word) {
  const bool coloured = !points.empty() && colours.size() == points.size();
  std::string bytes = header;
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const double coordinate : points[i]) append(static_cast<float>(coordinate));
    if (!coloured) continue;
    const Colour& c = colours[i];
    if (colour_as_word)
      append(static_cast<std::uint32_t>(c[0]) << 16 | static_cast<std::uint32_t>(c[1]) << 8 | c[2]);
    else
      append(c);
  }
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail(path, fmt::format("cannot be written: {}", std::strerror(errno)));
}

}  // namespace

PointCloud parse_point_cloud(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) fail(name, "is empty");
  PointCloud cloud = bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 5) == "ply\r\n"
                         ? parse_ply(bytes, name)
                         : parse_pcd(bytes, name);
  if (cloud.points.empty())
    fail(name, cloud.skipped == 0 ? std::string("it holds no points")
                                  : fmt::format("none of its {} points is finite", cloud.skipped));
  return cloud;
}

PointCloud read_point_cloud(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (size < 0) fail(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (size > (std::streamoff{1} << 31)) fail(path, "is larger than 2 GiB: thin it out first");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.seekg(0);
  file.read(bytes.data(), size);
  if (!file) fail(path, "cannot be read");
  return parse_point_cloud(bytes, path);
}

void write_pcd(const std::string& path, const std::vector<Eigen::Vector3d>& points,
               const std::vector<Colour>& colours) {
  const bool coloured = !points.empty() && colours.size() == points.size();
  write(path,
        fmt::format("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y "
                    "z{0}\nSIZE 4 4 4{1}\n"
                    "TYPE F F F{2}\nCOUNT 1 1 1{3}\nWIDTH {4}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 "
                    "0\nPOINTS {4}\n"
                    "DATA binary\n",
                    coloured ? " rgb" : "", coloured ? " 4" : "", coloured ? " U" : "",
                    coloured ? " 1" : "", points.size()),
        points, colours, true);
}

void write_ply(const std::string& path, const std::vector<Eigen::Vector3d>& points,
               const std::vector<Colour>& colours) {
  const bool coloured = !points.empty() && colours.size() == points.size();
  write(path,
        fmt::format(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty "
            "float y\n"
            "property float z\n{}end_header\n",
            points.size(),
            coloured ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : ""),
        points, colours, false);
}

}  // namespace arcstart
