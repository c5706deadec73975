#include "services/command_line/cell/census.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/command_line/live/scan_client.hpp"
#include "services/command_line/recordings/message_facts.hpp"

namespace arcstart::command_line {
namespace {

// s. 0.1 mm at 100 mm/s: what a seam's start is known to.
constexpr double kClocksApart = 0.001;

std::string state_of(const service_status_t& status) {
  switch (status.state) {
    case service_status_t::STARTING:
      return "starts";
    case service_status_t::DEGRADED:
      return "degraded";
    case service_status_t::FAULT:
      return "fault";
    case service_status_t::STOPPING:
      return "ends";
    default:
      return "runs";
  }
}

std::string place_of(const service_status_t& status) {
  return fmt::format("process {} on {}", status.pid, printable(status.host));
}

}  // namespace

Census::Census(Bus& bus, const Instance& instance) : instance_(instance) {
  bus.subscribe_pattern(
      "(?s).*_STATUS", Queue::measurements(),
      [this](const Bus::Bytes& bytes, const std::string& channel) { take_status(bytes, channel); });
  bus.subscribe<scan_t>(instance.sensor_channel("SCAN"), Queue::newest(),
                        [this](const scan_t& state) { scan_ = state; });
  bus.subscribe<calibration_t>(instance.sensor_channel("CALIBRATION"), Queue::measurements(),
                               [this](const calibration_t& told) {
                                 if (calibrations_.size() < kMostSpeakers)
                                   calibrations_[told.id] = told;
                               });
}

void Census::take_status(const Bus::Bytes& bytes, const std::string& channel) {
  service_status_t status;
  if (!decode(bytes, status).empty()) {
    if (strange_.size() < kMostSpeakers) strange_.insert(printable(channel));
    return;
  }
  const Speaker speaker{channel, status.host, status.pid};
  if (status.state == service_status_t::STOPPING) {
    speakers_.erase(speaker);
    return;
  }
  if (speakers_.size() >= kMostSpeakers && !speakers_.contains(speaker)) return;
  Speech& speech = speakers_[speaker];
  speech.last = ++heard_;
  if (speech.first == 0) speech.first = heard_;
  speech.status = status;
}

std::vector<CheckLine> Census::lines(const std::string& own_version,
                                     const std::string& cell) const {
  std::vector<CheckLine> lines = {clocks(cell), calibration(), versions(own_version)};
  add_services(lines, cell);
  return lines;
}

CheckLine Census::clocks(const std::string& cell) const {
  const std::string what = "clocks";
  if (!scan_)
    return {what, instance_.sensor_channel("SCAN") + " is not heard",
            "scripts/start " + cell + " on the host of sensor_capture"};
  if (scan_->clock_bound < 0)
    return {what, "sensor_capture cannot compare its host's clock with that of robot_pose",
            "scripts/start " + cell + " on the host of robot_pose"};
  const double apart = std::abs(scan_->clock_difference);
  const std::string words =
      fmt::format("those that stamp images and positions differ by {:.2f} ms, give or take {:.2f}",
                  scan_->clock_difference * 1e3, scan_->clock_bound * 1e3);
  if (apart - scan_->clock_bound <= kClocksApart) return {what, words, ""};
  return {what, words, "chronyc tracking; chronyc makestep (docs/connect-a-robot.md)"};
}

CheckLine Census::calibration() const {
  const std::string what = "calibration";
  if (calibrations_.empty())
    return {what, "none in force: " + instance_.sensor_channel("CALIBRATION") + " is not heard",
            "arcstart calibrate FOLDER -o FILE, then calibration: file: FILE in cell.yaml "
            "(docs/calibrate.md)"};
  if (calibrations_.size() > 1) {
    std::string ids;
    for (const auto& [id, told] : calibrations_) ids += (ids.empty() ? "" : ", ") + printable(id);
    return {what, "several are sent: " + ids, "end all services of role calibration but one"};
  }
  const auto& [id, told] = *calibrations_.begin();
  return {what, fmt::format("{} of {}", printable(id), printable(told.sensor)), ""};
}

CheckLine Census::versions(const std::string& own) const {
  const std::string words = "arcstart " + own + " here";
  if (strange_.empty()) return {"versions", words + "; all that is heard speaks its messages", ""};
  return {"versions", words + fmt::format("; another speaks on {}", fmt::join(strange_, ", ")),
          "install the same arcstart on every host"};
}

// A line a host; and one for each service that is missing, has a twin, or cannot do its work.
void Census::add_services(std::vector<CheckLine>& lines, const std::string& cell) const {
  std::map<std::string, std::vector<std::string>> at_host;
  std::map<std::string, std::vector<const Speech*>> in_role;
  for (const auto& [speaker, speech] : speakers_) {
    auto& others = in_role[std::get<0>(speaker)];
    // One that was silent before the other began has died, and this is its successor.
    std::erase_if(others,
                  [&speech = speech](const Speech* other) { return other->last < speech.first; });
    if (std::none_of(others.begin(), others.end(), [&speech = speech](const Speech* other) {
          return speech.last < other->first;
        }))
      others.push_back(&speech);
  }
  for (const auto& [channel, those] : in_role)
    for (const Speech* speech : those)
      at_host[printable(speech->status.host)].push_back(
          fmt::format("{} {}", printable(channel.substr(0, channel.rfind("_STATUS"))),
                      state_of(speech->status)));
  for (const auto& [host, services] : at_host)
    lines.push_back({"host", fmt::format("{}: {}", host, fmt::join(services, ", ")), ""});
  for (const auto& [channel, those] : in_role) {
    if (those.size() > 1)
      lines.push_back(
          {"twins",
           fmt::format("{} is sent by {} and {}", printable(channel), place_of(those[0]->status),
                       place_of(those[1]->status)),
           fmt::format("on {}: kill {}", printable(those[1]->status.host), those[1]->status.pid)});
    for (const Speech* speech : those)
      if (speech->status.state == service_status_t::FAULT)
        lines.push_back({"fault", printable(speech->status.service) + " cannot do its work",
                         printable(speech->status.last_error, 400)});
  }
  std::vector<std::string> missing;
  for (const auto& service : chain_services())
    if (!in_role.contains(status_channel(instance_, service))) missing.push_back(service.name);
  if (!missing.empty())
    lines.push_back({"missing", fmt::format("not heard: {}", fmt::join(missing, ", ")),
                     fmt::format("scripts/start {} --only {}", cell, fmt::join(missing, ","))});
}

}  // namespace arcstart::command_line
