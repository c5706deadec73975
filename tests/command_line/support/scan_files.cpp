#include "tests/command_line/support/scan_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace arcstart::test {
namespace {

constexpr double kDegrees = 180 / M_PI;

// Element by element, in another way than a composition of turns.
struct Rotation {
  double r[3][3];
  explicit Rotation(const double q[4]) {
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    std::copy(&rows[0][0], &rows[0][0] + 9, &r[0][0]);
  }
};

std::vector<double> numbers_of(const robot_pose_t& pose, const std::string& format,
                               double unit_mm) {
  const double* p = pose.position;
  const double* q = pose.quaternion;
  std::vector<double> numbers{p[0] / unit_mm, p[1] / unit_mm, p[2] / unit_mm};
  const auto add = [&](std::initializer_list<double> more) { numbers.insert(numbers.end(), more); };
  const Rotation R(q);
  if (format == "wxyz") add({q[0], q[1], q[2], q[3]});
  if (format == "xyzw") add({q[1], q[2], q[3], q[0]});
  if (format == "wpr")
    add({kDegrees * std::atan2(R.r[2][1], R.r[2][2]),
         kDegrees * std::atan2(-R.r[2][0], std::hypot(R.r[0][0], R.r[1][0])),
         kDegrees * std::atan2(R.r[1][0], R.r[0][0])});
  if (format == "rotvec") {
    const double sine = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double scale = sine > 0 ? 2 * std::atan2(sine, q[0]) / sine : 0;
    add({scale * q[1], scale * q[2], scale * q[3]});
  }
  if (format == "matrix") {
    const std::vector<double> position = numbers;
    numbers.clear();
    for (std::size_t row = 0; row < 3; ++row)
      add({R.r[row][0], R.r[row][1], R.r[row][2], position[row]});
  }
  return numbers;
}

template <class Message>
Message decoded(const RecordedEvent& event) {
  Message message;
  const int size = static_cast<int>(event.bytes.size());
  if (message.decode(event.bytes.data(), 0, size) != size)
    throw std::runtime_error(event.channel + ": does not decode");
  return message;
}

}  // namespace

void write_scan_files(const std::string& folder, const Events& events, std::int64_t scan_id,
                      const PoseWriting& writing) {
  static const std::map<std::string, double> units{{"mm", 1}, {"m", 1000}, {"inch", 25.4}};
  static const std::map<std::string, std::string> columns{{"wxyz", "x,y,z,qw,qx,qy,qz"},
                                                          {"xyzw", "x,y,z,qx,qy,qz,qw"},
                                                          {"wpr", "x,y,z,w,p,r"},
                                                          {"rotvec", "x,y,z,rx,ry,rz"},
                                                          {"matrix", "a,b,c,x,d,e,f,y,g,h,i,z"}};
  std::filesystem::create_directories(folder + "/frames");
  std::string frames = writing.header ? "index,utime_received\n" : "";
  std::int64_t first = 0, last = 0;
  for (const RecordedEvent& event : events) {
    if (event.channel != "LASER0_IMAGE") continue;
    const auto image = decoded<image_t>(event);
    if (image.scan_id != scan_id) continue;
    if (first == 0) first = image.utime;
    last = image.utime;
    frames += fmt::format("{},{}\n", image.scan_index, image.utime);
    std::ofstream(fmt::format("{}/frames/{:04}.png", folder, image.scan_index), std::ios::binary)
        .write(reinterpret_cast<const char*>(image.data.data()), image.size);
  }
  std::string poses = writing.header ? "utime," + columns.at(writing.format) + "\n" : "";
  for (const RecordedEvent& event : events) {
    if (event.channel != "ROBOT0_POSE") continue;
    const auto pose = decoded<robot_pose_t>(event);
    if (pose.utime < first - 500'000 || pose.utime > last + 500'000) continue;
    poses += fmt::format("{},{:.17g}\n", pose.utime,
                         fmt::join(numbers_of(pose, writing.format, units.at(writing.unit)), ","));
  }
  write_text(folder + "/frames.csv", frames);
  write_text(folder + "/poses.csv", poses);
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace arcstart::test
