#include "services/robot_link/robot_link_app.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <arcstart/scan_command_t.hpp>

#include "common/time.hpp"
#include "common/xyzwpr.hpp"

namespace arcstart::robot_link {
namespace {

static_assert(kValid == delivery_t::VALID);
using Progress = Handshake::Progress;
static_assert(static_cast<int>(Progress::kPending) == delivery_t::PENDING &&
              static_cast<int>(Progress::kWriting) == delivery_t::WRITING &&
              static_cast<int>(Progress::kDelivered) == delivery_t::DELIVERED &&
              static_cast<int>(Progress::kTaken) == delivery_t::TAKEN &&
              static_cast<int>(Progress::kDone) == delivery_t::DONE);

constexpr std::int64_t kSendEvery = 200'000;      // us: scan commands go at 5 Hz
constexpr std::int64_t kStatusHolds = 3'000'000;  // us: STATUS comes at 1 Hz
constexpr std::int64_t kStatePeriod = 1'000'000;  // us

// What a scan needs, and whether its STATUS is the robot's.
struct Needed {
  const char* service;
  bool of_robot;
};
constexpr Needed kNeeded[] = {{"sensor_capture", false}, {"robot_pose", true},
                              {"calibration", false},    {"extraction", false},
                              {"reconstruction", false}, {"seam_finding", false}};

DeliveryLimits limits_of(const RobotLinkSettings& settings) {
  DeliveryLimits limits;
  limits.T_base_frame = from_xyzwpr(settings.frame_in_base);
  limits.box_low = settings.box_low_mm;
  limits.box_high = settings.box_high_mm;
  limits.longest_start_deviation = settings.longest_start_deviation_mm;
  limits.longest_end_deviation = settings.longest_end_deviation_mm;
  limits.longest_age = settings.longest_age_s;
  return limits;
}

}  // namespace

RobotLinkApp::RobotLinkApp(Bus& bus, const RobotLinkSettings& settings, const Instance& instance,
                           std::int64_t run_id, std::unique_ptr<ControllerLink> link)
    : bus_(bus),
      settings_(settings),
      instance_(instance),
      run_id_(run_id),
      limits_(limits_of(settings)),
      talk_(std::move(link)) {
  bus_.subscribe<scan_t>(instance.sensor_channel("SCAN"), Queue::measurements(),
                         [this](const scan_t& scan) { on_scan(scan); });
  bus_.subscribe<seam_t>(instance.sensor_channel("SEAM"), Queue::newest(),
                         [this](const seam_t& seam) { on_seam(seam); });
  for (const Needed& needed : kNeeded)
    bus_.subscribe<service_status_t>(
        status_channel(instance, {needed.service, "", needed.of_robot}), Queue::newest(),
        [this, needed](const service_status_t& status) {
          services_[needed.service] = {steady_now(), status.state};
        });
}

std::string RobotLinkApp::job_name(std::int32_t number) const {
  if (number < 1 || static_cast<std::size_t>(number) > settings_.jobs.size()) return {};
  return settings_.jobs[static_cast<std::size_t>(number) - 1];
}

std::string RobotLinkApp::not_ready() const {
  for (const Needed& needed : kNeeded) {
    const auto heard = services_.find(needed.service);
    if (heard == services_.end() || steady_now() - heard->second.steady > kStatusHolds)
      return fmt::format("{} is not heard", needed.service);
    if (heard->second.state == service_status_t::FAULT)
      return fmt::format("{} has failed", needed.service);
  }
  return {};
}

// Another's scan under the robot's number is nobody's.
void RobotLinkApp::on_scan(const scan_t& scan) {
  const bool recalled = command_id_ == 0;  // begun by this service before it was started anew
  const auto pending = talk_.with([](Handshake& h) { return h.report().question; });
  const bool ours = scan.request != 0 && scan.request == pending.request &&
                    scan.job == job_name(pending.job) &&
                    scan.part == std::to_string(pending.part) &&
                    (recalled || scan.start_command_id == command_id_);
  const bool running = scan.state == scan_t::SCANNING;
  if (scan.state != scan_t::IDLE && scan.kind == scan_t::WORKPIECE)
    talk_.with([&](Handshake& h) { h.newest_scan(ours ? scan.request : 0, running); });
  if (ours && !running && scan_ended_since_ == 0) scan_ended_since_ = steady_now();
  if (command_id_ != 0 && scan.refused_command_id == command_id_)
    if (const auto wanted = talk_.with([](Handshake& h) { return h.scan_wanted(); }))
      refuse(*wanted, kNoScan, "the scan is refused: " + scan.refusal);
}

void RobotLinkApp::on_seam(const seam_t& seam) {
  const Question asked = talk_.with([](Handshake& h) { return h.report().question; });
  if (asked.request == 0 || seam.request != asked.request || seam.job != job_name(asked.job) ||
      seam.part != std::to_string(asked.part))
    return;
  if (command_id_ != 0 && seam.command_id != 0 && seam.command_id != command_id_) return;
  const std::int64_t now = utime_now();
  const SeamDelivery found = deliver(seam, limits_, now);
  const bool pending = talk_.with([&](Handshake& h) {
    const bool waits = h.pending().has_value();
    h.answer({asked, found.verdict, found.positions,
              steady_now() + seconds_to_us(limits_.longest_age) - (now - seam.utime)});
    return waits;
  });
  if (!pending) return;  // repeated
  scan_id_ = seam.scan_id;
  reason_ = found.reason;
  positions_ = found.positions;
}

void RobotLinkApp::refuse(const Question& question, std::int32_t number, const std::string& why) {
  reason_ = why;
  talk_.with([&](Handshake& h) { h.answer({question, number, {}, 0}); });
}

void RobotLinkApp::serve(const Question& question, std::int64_t now_utime) {
  const std::int64_t now = steady_now();
  if (question != question_) {
    question_ = question;
    question_since_ = now;
    command_id_ = next_send_ = scan_ended_since_ = scan_id_ = delivered_utime_ = 0;
    reason_.clear();
    positions_ = {};
  }
  if (job_name(question.job).empty())
    return refuse(question, kUnknownJob,
                  fmt::format("there is no job {}: robot_link.jobs names {}", question.job,
                              settings_.jobs.size()));
  const std::int64_t longest = seconds_to_us(settings_.answer_timeout_s);
  if (scan_ended_since_ != 0 && now - scan_ended_since_ > longest)
    return refuse(question, kNoAnswer, "no SEAM came after the scan's end");
  if (now - question_since_ > 2 * longest + seconds_to_us(settings_.longest_scan_s))
    return refuse(question, kNoAnswer, "the scan does not end");
  if (!talk_.with([](Handshake& h) { return h.scan_wanted().has_value(); })) return;
  if (const std::string why = not_ready(); !why.empty())
    return refuse(question, kCellNotReady, "no scan can be made: " + why);
  if (now - question_since_ > longest)
    return refuse(question, kNoScan, "sensor_capture does not begin the scan");
  if (now < next_send_) return;
  if (command_id_ == 0) command_id_ = now_utime;
  scan_command_t command{};
  command.utime = now_utime;
  command.command_id = command_id_;
  command.action = scan_command_t::START;
  command.kind = scan_t::WORKPIECE;
  command.longest_duration = settings_.longest_scan_s;
  command.request = question.request;
  command.job = job_name(question.job);
  command.part = std::to_string(question.part);
  bus_.publish(instance_.sensor_channel("SCAN_COMMAND"), command);
  next_send_ = now + kSendEvery;
}

delivery_t RobotLinkApp::delivery(std::int64_t now_utime) const {
  const Handshake::Report report = talk_.with([](Handshake& h) { return h.report(); });
  delivery_t message{};
  message.utime = now_utime;
  message.run_id = run_id_;
  message.controller = talk_.description();
  message.connected = talk_.connected();
  message.trouble = talk_.trouble();
  message.robot_alive = report.robot_alive;
  message.progress = static_cast<std::int8_t>(report.progress);
  message.request = report.question.request;
  message.job = job_name(report.question.job);
  message.part = report.question.request > 0 ? std::to_string(report.question.part) : "";
  message.scan_id = scan_id_;
  message.verdict = static_cast<std::int16_t>(report.verdict);
  message.reason = report.verdict == kValid ? "" : reason_;
  message.delivered_utime = delivered_utime_;
  message.quaternion[0] = 1;
  if (report.verdict != kValid || scan_id_ == 0) return message;
  double(*places[])[3] = {&message.approach, &message.start, &message.end};
  for (std::size_t i = 0; i < positions_.size(); ++i)
    transform_to_arrays(positions_[i], *places[i], message.quaternion);
  return message;
}

void RobotLinkApp::tick(std::int64_t now_utime) {
  const bool ready = not_ready().empty();
  const auto pending = talk_.with([&](Handshake& h) {
    h.set_ready(ready);
    return h.pending();
  });
  if (pending) serve(*pending, now_utime);

  delivery_t news = delivery(now_utime);
  if (delivered_utime_ == 0 && news.progress >= delivery_t::DELIVERED)
    news.delivered_utime = delivered_utime_ = now_utime;
  const bool same = news.progress == told_.progress && news.request == told_.request &&
                    news.verdict == told_.verdict && news.connected == told_.connected &&
                    news.robot_alive == told_.robot_alive && news.trouble == told_.trouble;
  if (same && now_utime - told_.utime < kStatePeriod && now_utime >= told_.utime) return;
  bus_.publish(instance_.robot_channel("DELIVERY"), news);
  told_ = news;
}

Health RobotLinkApp::health() const {
  Health health;
  health.received = talk_.operations();
  if (!talk_.connected()) {
    health.state = service_status_t::FAULT;
    health.last_error = talk_.description() + ": " + talk_.trouble();
  } else if (!talk_.with([](Handshake& h) { return h.report().robot_alive; })) {
    health.notice = "the robot's program does not run: its beat stands still";
  }
  return health;
}

}  // namespace arcstart::robot_link
