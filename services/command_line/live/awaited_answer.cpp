#include "services/command_line/live/awaited_answer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "services/command_line/recordings/message_facts.hpp"
#include "services/seam_finding/scan/answer_mark.hpp"

namespace arcstart::command_line {
namespace {

constexpr std::int64_t kSpeaks = 1'500'000;  // us: STATUS comes at 1 Hz

std::string name_of(const service_status_t& status) {
  return fmt::format("{}, process {}", printable(status.host), status.pid);
}

// The mark in a STATUS of its answer to the scan; empty where it has given none.
std::string mark_in(const service_status_t& status, std::int64_t scan_id) {
  const std::string begin = seam_finding::answer_mark_of_scan(scan_id);
  const auto at = status.last_error.rfind(begin);
  return at == std::string::npos ? "" : status.last_error.substr(at, begin.size() + 8);
}

std::string in_short(const seam_t& seam) {
  if (seam.verdict != seam_t::FOUND)
    return seam.reason.empty() ? "no seam" : "no seam: " + printable(seam.reason);
  return fmt::format("found, start {:.3f} {:.3f} {:.3f}", seam.start[0], seam.start[1],
                     seam.start[2]);
}

}  // namespace

void AwaitedAnswer::take(const seam_t& seam, std::int64_t scan_id, bool has_ended) {
  if (scan_id == 0 || seam.scan_id != scan_id) return;
  const Given given{seam_finding::answer_mark(seam), seam};
  if (!has_ended) {
    early_ = given;
    return;
  }
  std::erase_if(seams_, [&](const Given& known) { return known.mark == given.mark; });
  seams_.push_back(given);
  if (seams_.size() > kKept) seams_.pop_front();
}

void AwaitedAnswer::take(const service_status_t& status, std::int64_t now) {
  std::erase_if(finders_, [&](const auto& one) { return now - one.second.heard > kSpeaks; });
  if (status.state == service_status_t::STOPPING)
    finders_.erase(status.run_id);
  else if (finders_.size() < kKept || finders_.contains(status.run_id))
    finders_[status.run_id] = {now, status};
}

void AwaitedAnswer::decide(std::int64_t scan_id, std::int64_t now) {
  if (answer_ || !failure_.empty()) return;
  mark_.clear();
  bool all = true;
  for (const auto& [run_id, finder] : finders_) {
    if (now - finder.heard > kSpeaks) continue;
    const std::string mark = mark_in(finder.status, scan_id);
    if (mark.empty()) {
      all = false;
    } else if (mark_.empty()) {
      mark_ = mark;
      who_ = name_of(finder.status);
    } else if (mark != mark_) {
      failure_ = fmt::format(
          "two seam_finding answer this scan, each in its own way: {}; and {}: end one, scan again",
          who_, name_of(finder.status));
      return;
    }
  }
  if (!all || mark_.empty()) return;
  const auto given = std::find_if(seams_.begin(), seams_.end(),
                                  [this](const Given& one) { return one.mark == mark_; });
  if (given != seams_.end()) answer_ = given->seam;
}

std::string AwaitedAnswer::stranger() const {
  if (!answer_) return "";
  const auto told = [this](const Given& one) {
    return fmt::format(
        "another SEAM of this scan is on the bus, which seam_finding ({}) did not give: {}: see "
        "'arcstart monitor'",
        who_, in_short(one.seam));
  };
  if (early_ && early_->mark != mark_) return told(*early_);
  for (const Given& one : seams_)
    if (one.mark != mark_) return told(one);
  return "";
}

std::string AwaitedAnswer::missing() const {
  if (seams_.empty() && !early_) return "";
  if (finders_.empty()) return "a SEAM came, but no STATUS of seam_finding, which must name it";
  return "a SEAM came that no STATUS of seam_finding names: a stranger's, or of another version";
}

}  // namespace arcstart::command_line
