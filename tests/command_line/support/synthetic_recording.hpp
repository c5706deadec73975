// Recordings of a cell in closed form: a coarse table, scanned empty and then with a Tee on it, as
// lcm-logger would have written them. What is true is known without any of the pipeline's stages.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "services/command_line/recordings/recording.hpp"

namespace arcstart::test {

using namespace command_line;

struct RecordedEvent {
  std::int64_t timestamp;  // us, when the logger got it
  std::string channel;
  std::vector<std::uint8_t> bytes;
};
using Events = std::vector<RecordedEvent>;  // by timestamp

// The Tee's seam: the line y = -4, z = 10 mm of base, along the search direction +x.
const Eigen::Vector3d kSeamStart(20, -4, 10), kSeamEnd(120, -4, 10);
constexpr double kStripeSpacing = 50.0 / 14;  // mm: 50 mm/s, 14 fps

constexpr std::int64_t kBegin = 1'700'000'000'000'000;        // us, of the recording
constexpr std::int64_t kBackgroundScan = kBegin + 1'000'000;  // their ids
constexpr std::int64_t kWorkpieceScan = kBegin + 7'000'000;

struct Recorded {
  bool images = false, stripes = false, profiles = false;
  bool background = true, workpiece = true;
  std::string sensor = "LASER0", robot = "ROBOT0";
};
// With positions, scan states, the calibration and the services' STATUS.
Events record(const Recorded& recorded);

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

// Sorts by timestamp; events of the same stay as they are.
void sort(Events& events);

// A folder of its own, gone with it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  std::string save(const std::string& name, const Events& events) const;  // its path
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace arcstart::test
