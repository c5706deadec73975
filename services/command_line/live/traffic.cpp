#include "services/command_line/live/traffic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

namespace arcstart::command_line {
namespace {

constexpr std::size_t kTicks = 6;  // over which rates are taken: five seconds

std::string text_of(const scan_t& scan) {
  static constexpr std::array kStates = {"idle", "scanning", "ended"};
  const std::string clocks = scan.clock_bound < 0
                                 ? "clocks not compared"
                                 : fmt::format("clocks {:.1f} +- {:.1f} ms apart",
                                               scan.clock_difference * 1e3, scan.clock_bound * 1e3);
  return fmt::format("{}, {} images, {} lost, {} {}", kStates[static_cast<std::size_t>(scan.state)],
                     scan.images, scan.lost, clocks, scan.refusal);
}

std::string text_of(const service_status_t& status) {
  static constexpr std::array kStates = {"starting", "running", "degraded", "fault", "stopping"};
  const std::string state = kStates[static_cast<std::size_t>(status.state)];
  return status.last_error.empty() ? state : state + ": " + status.last_error;
}

std::string text_of(const seam_t& seam) {
  static constexpr std::array kVerdicts = {"found", "ambiguous", "refused", "background stored"};
  const std::string verdict = kVerdicts[static_cast<std::size_t>(seam.verdict)];
  return seam.reason.empty() ? verdict : verdict + ": " + seam.reason;
}

std::string text_of(const image_t& preview) { return preview.laser_on ? "laser on" : "laser off"; }

std::string text_of(const calibration_t& calibration) { return "id " + calibration.id; }

template <class Message>
std::string state_text(const std::vector<std::uint8_t>& bytes) {
  Message message;
  return decode(bytes, message).empty() ? printable(text_of(message), 100) : "";
}

std::string state_of(ChannelKind kind, const std::vector<std::uint8_t>& bytes) {
  switch (kind) {
    case ChannelKind::kScan:
      return state_text<scan_t>(bytes);
    case ChannelKind::kStatus:
      return state_text<service_status_t>(bytes);
    case ChannelKind::kSeam:
      return state_text<seam_t>(bytes);
    case ChannelKind::kCalibration:
      return state_text<calibration_t>(bytes);
    case ChannelKind::kPreview:
      return state_text<image_t>(bytes);
    default:
      return "";
  }
}

}  // namespace

void Traffic::take(const std::string& name, const std::vector<std::uint8_t>& bytes,
                   std::int64_t steady) {
  auto found = channels_.find(name);
  if (found == channels_.end()) {
    if (channels_.size() >= kMostChannels) {
      ++elsewhere_;
      return;
    }
    found = channels_.try_emplace(name).first;
    found->second.kind = channel_kind(name);
  }
  Channel& channel = found->second;
  ++channel.total.messages;
  channel.total.bytes += static_cast<std::int64_t>(bytes.size());
  channel.arrival = steady;
  channel.size = bytes.size();
  if (!message_error(channel.kind, bytes).empty()) {
    ++channel.undecodable;
    if (const std::string former = former_type(bytes); !former.empty())
      channel.state = former + " of the version before: bring its sender to this version";
    return;
  }
  channel.state = state_of(channel.kind, bytes);
  if (is_measurement(channel.kind)) note_source(channel, bytes);
}

void Traffic::note_source(Channel& channel, const std::vector<std::uint8_t>& bytes) {
  Source source;
  if (!read_source(channel.kind, bytes, source).empty()) return;
  const auto head = std::span(bytes).first(std::min(bytes.size(), kImageHead));
  const bool is_repeated = channel.senders.is_repeated(source.run_id, source.seq, head);
  channel.state = channel.senders.dispute();
  if (is_repeated) return;
  if (source.run_id != channel.run_id) channel.seq = -1;
  if (channel.seq >= 0 && source.seq > channel.seq) {
    // A sender may state any seq: the sum must not overflow.
    const std::int64_t gap = source.seq - channel.seq - 1;
    channel.gaps = std::min(channel.gaps, std::numeric_limits<std::int64_t>::max() - gap) + gap;
  }
  channel.utime = source.utime;
  channel.run_id = source.run_id;
  channel.seq = std::max(channel.seq, source.seq);
}

void Traffic::tick(std::int64_t steady) {
  ticks_.push_back(steady);
  if (ticks_.size() > kTicks) ticks_.pop_front();
  for (auto& [name, channel] : channels_) {
    channel.at_ticks.push_back(channel.total);
    if (channel.at_ticks.size() > kTicks) channel.at_ticks.pop_front();
  }
}

Traffic::Rates Traffic::rates(const Channel& channel, std::int64_t steady) const {
  if (ticks_.empty() || steady <= ticks_.front()) return {};
  const Count before =
      channel.at_ticks.size() == ticks_.size() ? channel.at_ticks.front() : Count{};
  const double seconds = static_cast<double>(steady - ticks_.front()) * 1e-6;
  return {static_cast<double>(channel.total.messages - before.messages) / seconds,
          static_cast<double>(channel.total.bytes - before.bytes) / seconds};
}

double Traffic::age_s(const Channel& channel, std::int64_t steady, std::int64_t utime) {
  // As doubles: a sender may state any utime.
  if (channel.utime != 0)
    return (static_cast<double>(utime) - static_cast<double>(channel.utime)) * 1e-6;
  return static_cast<double>(steady - channel.arrival) * 1e-6;
}

std::string Traffic::table(std::int64_t steady, std::int64_t utime) const {
  std::string text =
      fmt::format("{:<32} {:>8} {:>10} {:>9} {:>8} {:>6} {:>11}  {}\n", "channel", "rate/Hz",
                  "kB/s", "size/B", "age/s", "gaps", "undecodable", "state");
  for (const auto& [name, channel] : channels_) {
    const Rates now = rates(channel, steady);
    const std::string gaps = is_measurement(channel.kind) ? fmt::format("{}", channel.gaps) : "-";
    const std::string undecodable =
        channel.kind == ChannelKind::kUnknown ? "-" : fmt::format("{}", channel.undecodable);
    std::string line =
        fmt::format("{:<32} {:>8.1f} {:>10.1f} {:>9} {:>8.3f} {:>6} {:>11}  {}",
                    printable(name, 64), now.messages_per_s, now.bytes_per_s / 1000, channel.size,
                    age_s(channel, steady, utime), gaps, undecodable, channel.state);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  if (elsewhere_ > 0)
    text +=
        fmt::format("and {} messages on channels beyond the first {}\n", elsewhere_, kMostChannels);
  return text;
}

nlohmann::json Traffic::json(std::int64_t steady, std::int64_t utime) const {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [name, channel] : channels_) {
    const Rates now = rates(channel, steady);
    nlohmann::json entry = {
        {"channel", printable(name)},    {"messages", channel.total.messages},
        {"rate_hz", now.messages_per_s}, {"bytes_per_s", now.bytes_per_s},
        {"size_bytes", channel.size},    {"age_s", age_s(channel, steady, utime)}};
    if (is_measurement(channel.kind)) entry["gaps"] = channel.gaps;
    if (channel.kind != ChannelKind::kUnknown) entry["undecodable"] = channel.undecodable;
    if (!channel.state.empty()) entry["state"] = channel.state;
    list.push_back(std::move(entry));
  }
  return list;
}

std::string Traffic::json_line(std::int64_t steady, std::int64_t utime) const {
  return json(steady, utime).dump();
}

}  // namespace arcstart::command_line
