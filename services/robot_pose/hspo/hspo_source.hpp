// FANUC HSPO by UDP: the controller pushes, this host listens. Nothing is ever sent.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "services/robot_pose/hspo/hspo_stream.hpp"
#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/robot_pose_settings.hpp"
#include "services/robot_pose/stream/udp_listener.hpp"

namespace arcstart::robot_pose {

class HspoSource : public PoseSource {
 public:
  // notify: called from another thread when something has come; it must outlive this object.
  HspoSource(const RobotPoseSettings& settings, std::function<void()> notify);

  void start() override;
  std::optional<ReportedPosition> poll() override;
  PoseSourceCounts counts() const override;
  std::string last_error() const override { return last_error_; }
  std::string description() const override;
  std::string why_silent() const override;

  int port() const { return listener_.port(); }

 private:
  bool is_the_controller(const Datagram& datagram);

  UdpListener listener_;
  HspoStream stream_;
  std::string address_;
  bool tool_in_flange_is_set_;
  std::string controller_;        // whom we listen to; empty before anybody was heard
  bool controller_is_set_;        // by the settings
  std::int64_t heard_utime_ = 0;  // last time
  std::int64_t foreign_ = 0;
  std::string stream_error_, last_error_;
};

}  // namespace arcstart::robot_pose
