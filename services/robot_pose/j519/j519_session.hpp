// The talk with a Stream Motion controller: question, start, status packets, stop.
// Pure: bytes and times in, bytes and positions out.
//
// A controller streams to one client. A start beside another's stream raises an alarm, and a stop
// ends it, so
// - nothing is stopped but this host's own stream, and that at the end alone;
// - a stream that comes to this host's port without a start, left by a predecessor, is taken over;
// - a start is sent once, and again only after the controller did not answer for a while: it has
//   been switched off. A stream that ends while the controller answers was ended by somebody else.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/robot_pose/j519/j519_packet.hpp"
#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/stream/report_sequence.hpp"

namespace arcstart::robot_pose {

class J519Session {
 public:
  using Bytes = std::vector<std::uint8_t>;

  // T_flange_tool: where the hand lies in the flange; nothing: the controller's tool centre point.
  explicit J519Session(std::optional<Eigen::Isometry3d> T_flange_tool);
  J519Session(const J519Session&) = delete;
  J519Session& operator=(const J519Session&) = delete;

  // What to send now, nothing mostly. To be asked at least ten times a second. now: steady; us.
  std::optional<Bytes> step(std::int64_t now);

  // One datagram of the controller's. arrival_utime: us, UTC.
  std::optional<ReportedPosition> take(std::span<const std::uint8_t> datagram,
                                       std::int64_t arrival_utime, std::int64_t now);

  // The stop of this host's stream; nothing where it has none.
  std::optional<Bytes> stop();

  const PoseSourceCounts& counts() const { return counts_; }
  const std::string& last_error() const { return last_error_; }
  const std::string& why_silent() const { return why_silent_; }  // empty while it streams

 private:
  enum class State {
    kAsking,    // what the controller can
    kAnswered,  // it told; a stream may be coming already, or is about to after the start
    kStreaming
  };
  void on_capability(const J519Capability& capability, std::int64_t now);
  std::optional<ReportedPosition> on_status(const J519Status& status, std::int64_t arrival_utime,
                                            std::int64_t now);
  void ask_again(std::int64_t at);
  std::string mismatch(const J519Capability& capability) const;

  std::optional<Eigen::Isometry3d> T_flange_tool_;
  PoseSourceCounts counts_;
  std::string last_error_, why_silent_;
  ReportSequence sequence_;

  State state_ = State::kAsking;
  std::optional<J519Capability> capability_;  // one that fits
  std::uint32_t version_ = kJ519Oldest;       // asked for
  std::int64_t next_ = 0;                     // when to act; steady, us
  std::int64_t pause_;                        // to the next question; us
  int unanswered_ = 0;
  bool may_start_ = true;
  std::string why_no_start_;  // where another may not be sent
  bool ours_ = false;         // a stream comes here or was asked for
  std::int64_t heard_ = 0;    // the last report; steady, us
};

}  // namespace arcstart::robot_pose
