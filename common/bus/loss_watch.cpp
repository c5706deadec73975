#include "common/bus/loss_watch.hpp"

#include <fmt/core.h>

namespace arcstart {

void LossWatch::take(std::int64_t lost, const std::string& reason, std::int64_t now,
                     std::int64_t utime) {
  if (is_losing_ && now - last_ >= kIsNews) {
    is_losing_ = false;
    reason_.clear();
  }
  if (lost != lost_) {
    if (!is_losing_) {
      before_ = lost_;
      since_utime_ = utime;
    }
    lost_ = lost;
    last_ = now;
    is_losing_ = true;
  }
  if (is_losing_ && !reason.empty()) reason_ = reason;
}

std::string LossWatch::words(const std::string& told) const {
  if (!is_losing_) return "";
  const std::int64_t second = since_utime_ / 1'000'000 % 86'400;
  return fmt::format("{} inputs lost since {:02}:{:02}:{:02} UTC{}", lost_ - before_, second / 3600,
                     second / 60 % 60, second % 60,
                     reason_.empty() || reason_ == told ? "" : " (" + reason_ + ")");
}

}  // namespace arcstart
