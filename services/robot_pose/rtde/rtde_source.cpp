#include "services/robot_pose/rtde/rtde_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/time.hpp"
#include "services/robot_pose/stream/hand.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr int kRtdePort = 30004;
constexpr const char* kAllowed = "RTDE allowed there (Settings, Security, Services)";
constexpr std::size_t kMostPositions = 5000;       // that wait to be polled
constexpr std::int64_t kAnswers = 2'000'000;       // us: the longest that an answer may take
constexpr std::int64_t kDataStall = 1'000'000;     // us without a data package
constexpr std::int64_t kRetryFirst = 250'000;      // us to the next connection; doubles
constexpr std::int64_t kRetryLongest = 4'000'000;  // us

}  // namespace

RtdeSource::RtdeSource(const RobotPoseSettings& settings, std::function<void()> notify)
    : controller_(settings.controller_address),
      port_(settings.controller_port ? settings.controller_port : kRtdePort),
      notify_(std::move(notify)),
      session_(settings.rate_hz, tool_in_flange(settings.tool_in_flange)) {}

RtdeSource::~RtdeSource() {
  connection_.end();
  if (thread_.joinable()) thread_.join();
}

void RtdeSource::start() {
  if (controller_.empty())
    throw std::runtime_error(
        "robot_pose.controller_address: protocol rtde needs the address of the controller");
  thread_ = std::thread([this] { run(); });
}

void RtdeSource::run() {
  for (std::int64_t pause = kRetryFirst;;) {
    std::string why = connection_.open(controller_, port_, kAnswers, kAllowed);
    const bool connected = why.empty();
    if (connected) why = listen();
    if (why.empty()) return;
    if (connected && session_.streaming()) pause = kRetryFirst;
    connection_.close();
    {
      const std::lock_guard lock(mutex_);
      why_silent_ = why;
    }
    if (connection_.sleep(pause)) return;
    pause = std::min(2 * pause, kRetryLongest);
  }
}

// Empty where it was ended from outside.
std::string RtdeSource::listen() {
  if (!connection_.send(session_.begin())) return "the controller closed the connection";
  std::vector<std::uint8_t> bytes;
  std::int64_t arrival = 0;
  for (std::int64_t due = steady_now() + kAnswers;;) {
    const auto received =
        connection_.receive(bytes, arrival, std::max<std::int64_t>(due - steady_now(), 0));
    if (received == TcpConnection::Received::kEnded) {
      if (session_.streaming()) connection_.send(rtde_request(rtde_type::kPause));
      return {};
    }
    if (received == TcpConnection::Received::kClosed)
      return "the controller closed the connection" + owed();
    if (received == TcpConnection::Received::kBytes) {
      const std::string awaited = session_.awaited();
      RtdeSession::Step step = session_.take(bytes, arrival);
      const bool whole =
          !step.request.empty() || !step.positions.empty() || session_.awaited() != awaited;
      if (whole) due = steady_now() + (session_.streaming() ? kDataStall : kAnswers);
      publish(step.positions);
      if (!step.fault.empty()) return step.fault;
      if (!connection_.send(step.request)) return "the controller closed the connection";
    }
    if (steady_now() < due) continue;
    if (session_.streaming()) return "the controller stopped sending data over a live connection";
    return fmt::format("the controller took the connection, and {} s later has not gone on{}",
                       kAnswers / 1'000'000, owed());
  }
}

std::string RtdeSource::owed() const {
  std::string owed = session_.streaming() ? "" : " and owes an answer to " + session_.awaited();
  if (const std::size_t bytes = session_.half_a_frame(); bytes > 0)
    owed += fmt::format(", in the middle of a frame ({} bytes of it came)", bytes);
  return owed;
}

void RtdeSource::publish(const std::vector<ReportedPosition>& positions) {
  {
    const std::lock_guard lock(mutex_);
    for (const ReportedPosition& position : positions) {
      if (waiting_.size() < kMostPositions)
        waiting_.push_back(position);
      else
        ++overflowed_;
    }
    counts_ = session_.counts();
    last_error_ = session_.last_error();
    if (!positions.empty()) why_silent_.clear();
  }
  if (!positions.empty()) notify_();
}

std::optional<ReportedPosition> RtdeSource::poll() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return std::nullopt;
  ReportedPosition position = std::move(waiting_.front());
  waiting_.pop_front();
  return position;
}

PoseSourceCounts RtdeSource::counts() const {
  const std::lock_guard lock(mutex_);
  PoseSourceCounts counts = counts_;
  counts.lost += overflowed_;
  return counts;
}

std::string RtdeSource::last_error() const {
  const std::lock_guard lock(mutex_);
  return last_error_;
}

std::string RtdeSource::why_silent() const {
  const std::lock_guard lock(mutex_);
  return why_silent_;
}

std::string RtdeSource::description() const {
  return fmt::format("RTDE from {}:{}", controller_, port_);
}

}  // namespace arcstart::robot_pose
