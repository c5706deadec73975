// FANUC Stream Motion (J519) by UDP: its status packets, and no motion command.
#pragma once

#include <functional>
#include <string>

#include "services/robot_pose/j519/j519_session.hpp"
#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/robot_pose_settings.hpp"
#include "services/robot_pose/stream/udp_listener.hpp"

namespace arcstart::robot_pose {

class J519Source : public PoseSource {
 public:
  // notify: called from another thread when something has come; it must outlive this object.
  J519Source(const RobotPoseSettings& settings, std::function<void()> notify);
  ~J519Source() override;  // stops this host's stream

  void start() override;
  std::optional<ReportedPosition> poll() override;
  PoseSourceCounts counts() const override;
  std::string last_error() const override { return last_error_; }
  std::string description() const override;
  std::string why_silent() const override { return session_.why_silent(); }

 private:
  UdpListener listener_;
  J519Session session_;
  std::string address_, controller_;
  int controller_port_;
  std::int64_t foreign_ = 0;
  std::string session_error_, last_error_;
};

}  // namespace arcstart::robot_pose
