// Where positions of the robot come from: the interface that every robot protocol stands behind.
//
// The robot's hand, whose pose is reported, is the tool frame to which hand-eye is calibrated
// (T_tool_camera): by default the tool centre point that the controller itself uses. HSPO sends
// that and nothing else. With robot_pose.tool_in_flange it is a frame fixed in the flange, six
// zeros for the flange itself, and no change of tool at the controller can move it; for that a
// source must know the flange, from J519's capability or RTDE's tcp_offset. A source that cannot
// say that it reports this hand reports nothing.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace arcstart::robot_pose {

// Protocols, values as in robot_pose_t.
enum class RobotProtocol : std::int8_t { kUnknown, kHspo, kJ519, kRtde };

// One position as the controller measured and reported it.
struct ReportedPosition {
  std::int64_t seq = 0;  // rises by 1, and by 1 more for each report that was lost
  Eigen::Vector3d position = Eigen::Vector3d::Zero();            // tool in base; mm
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // tool in base
  RobotProtocol source = RobotProtocol::kUnknown;
  // The controller's numbers, -1 where it does not say. Tool 0: the flange itself; user frame 0:
  // the robot's own base.
  int tool_frame = -1, user_frame = -1;
  std::vector<double> joints;      // rad, as the controller counts them; empty where unknown
  std::int64_t device_clock = 0;   // the controller's, in its ticks, wraps undone
  double device_tick_us = 1;       // length of a tick; us
  std::int64_t arrival_utime = 0;  // us, UTC, host clock
  bool clock_begins = false;       // nothing before compares with this device_clock
  std::string invalid;             // why the position or its clock must not be used
};

struct PoseSourceCounts {
  std::int64_t received = 0;   // packets from the robot
  std::int64_t malformed = 0;  // of those, not understood
  std::int64_t late = 0;       // of those, duplicates and reordered ones, dropped
  std::int64_t lost = 0;       // reports whose number was skipped
  std::int64_t foreign = 0;    // datagrams that hold nothing for us: another sender or motion
                               // group, or no measured position at all
};

// Knows no LCM. No source ever sends a motion command.
class PoseSource {
 public:
  virtual ~PoseSource() = default;

  // Begins to listen. Throws std::runtime_error with what to do where it cannot.
  virtual void start() = 0;

  // The next position in order of arrival, nothing where none waits.
  virtual std::optional<ReportedPosition> poll() = 0;

  virtual PoseSourceCounts counts() const = 0;

  // The last thing that was wrong with what came, one line; empty for nothing.
  virtual std::string last_error() const = 0;

  // What is listened to, for people: "HSPO on 192.168.1.5:60015".
  virtual std::string description() const = 0;

  // Why no position comes, or what to look at: one line.
  virtual std::string why_silent() const = 0;
};

}  // namespace arcstart::robot_pose
