#include "services/command_line/clouds/point_cloud_file.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "services/command_line/clouds/point_cloud_table.hpp"

namespace arcstart::command_line {
namespace {

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
  if (!file) fail_to_read(path, fmt::format("cannot be written: {}", std::strerror(errno)));
}

}  // namespace

PointCloud parse_point_cloud(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) fail_to_read(name, "is empty");
  PointCloud cloud = bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 5) == "ply\r\n"
                         ? parse_ply(bytes, name)
                     : is_text_table(bytes) ? parse_text_table(bytes, name)
                                            : parse_pcd(bytes, name);
  if (cloud.points.empty())
    fail_to_read(name, cloud.skipped == 0
                           ? std::string("it holds no points")
                           : fmt::format("none of its {} points is finite", cloud.skipped));
  return cloud;
}

PointCloud read_point_cloud(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (size < 0) fail_to_read(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (size > (std::streamoff{1} << 31))
    fail_to_read(path, "is larger than 2 GiB: thin it out first");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.seekg(0);
  file.read(bytes.data(), size);
  if (!file) fail_to_read(path, "cannot be read");
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

}  // namespace arcstart::command_line
