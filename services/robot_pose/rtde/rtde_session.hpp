// The talk with a Universal Robots controller over one RTDE connection after another: version,
// output recipe, start, data. Pure: bytes and arrival times in, bytes and positions out.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/rtde/rtde_frames.hpp"
#include "services/robot_pose/stream/report_sequence.hpp"

namespace arcstart::robot_pose {

class RtdeSession {
 public:
  using Bytes = std::vector<std::uint8_t>;

  // rate_hz: of the data asked for. T_flange_tool: where the hand lies in the flange; nothing: the
  // controller's tool centre point, which then must stay where it is in the flange.
  RtdeSession(double rate_hz, std::optional<Eigen::Isometry3d> T_flange_tool);
  RtdeSession(const RtdeSession&) = delete;
  RtdeSession& operator=(const RtdeSession&) = delete;

  // A connection has been made: the first request.
  Bytes begin();

  struct Step {
    Bytes request;                            // to be sent; often empty
    std::vector<ReportedPosition> positions;  // in order
    std::string fault;                        // why this connection is no use: one line
  };
  // Bytes of the connection. arrival_utime: us, UTC.
  Step take(std::span<const std::uint8_t> bytes, std::int64_t arrival_utime);

  bool streaming() const { return state_ == State::kStreaming; }
  std::string awaited() const;  // what the controller owes an answer to, for people
  std::size_t half_a_frame() const { return reader_.waiting(); }  // bytes that came of it

  const PoseSourceCounts& counts() const { return counts_; }
  const std::string& last_error() const { return last_error_; }

 private:
  enum class State { kVersion, kRecipe, kStart, kStreaming };
  void on_frame(const RtdeFrame& frame, std::int64_t arrival_utime, Step& step);
  void on_version(bool accepted, Step& step);
  void on_recipe(std::span<const std::uint8_t> payload, Step& step);
  void on_start(bool accepted, Step& step);
  std::optional<ReportedPosition> on_data(const RtdeFrame& frame, std::int64_t arrival_utime);
  Bytes outputs_request() const;
  bool place_hand(const RtdeData& data, ReportedPosition& reported);

  double rate_hz_;
  std::optional<Eigen::Isometry3d> T_flange_tool_;
  PoseSourceCounts counts_;
  std::string last_error_;
  ReportSequence sequence_;

  State state_ = State::kVersion;
  RtdeFrameReader reader_;
  bool with_tool_offset_ = true;  // of the recipe; old controllers do not tell it
  std::uint8_t recipe_ = 0;
  std::string text_;  // the controller's last words on this connection

  std::optional<double> timestamp_;                   // of the last data; s
  std::uint32_t index_ = 0;                           // of them, counted here
  std::optional<std::array<double, 6>> tool_offset_;  // the first that was told
};

}  // namespace arcstart::robot_pose
