// Universal Robots' RTDE by TCP: connects, listens, and connects again when that ends. Nothing is
// ever written into the controller.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "common/tcp_connection.hpp"
#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/robot_pose_settings.hpp"
#include "services/robot_pose/rtde/rtde_session.hpp"

namespace arcstart::robot_pose {

class RtdeSource : public PoseSource {
 public:
  // notify: called from another thread when something has come; it must outlive this object.
  RtdeSource(const RobotPoseSettings& settings, std::function<void()> notify);
  ~RtdeSource() override;

  void start() override;
  std::optional<ReportedPosition> poll() override;
  PoseSourceCounts counts() const override;
  std::string last_error() const override;
  std::string description() const override;
  std::string why_silent() const override;

 private:
  void run();
  std::string listen();      // until the connection is no use any more: why
  std::string owed() const;  // by the controller, as the end of a sentence
  void publish(const std::vector<ReportedPosition>& positions);

  std::string controller_;
  int port_;
  std::function<void()> notify_;
  RtdeSession session_;  // the thread's alone
  TcpConnection connection_;
  std::thread thread_;

  mutable std::mutex mutex_;  // of what follows
  std::deque<ReportedPosition> waiting_;
  PoseSourceCounts counts_;
  std::int64_t overflowed_ = 0;  // positions dropped because nobody polled
  std::string last_error_;
  std::string why_silent_ = "no connection has been tried yet";
};

}  // namespace arcstart::robot_pose
