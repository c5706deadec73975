// What a service has lost lately, for its STATUS: how many, since when, and why.
#pragma once

#include <cstdint>
#include <string>

namespace arcstart {

class LossWatch {
 public:
  // lost: inputs lost until now, in all; reason: what went wrong, empty for nothing. now: us,
  // steady; utime: us, UTC.
  void take(std::int64_t lost, const std::string& reason, std::int64_t now, std::int64_t utime);

  // So long after a loss it is news, us: ten STATUS.
  static constexpr std::int64_t kIsNews = 10'000'000;
  bool is_losing() const { return is_losing_; }

  // "3 inputs lost since 21:53:07 UTC (the reason)", of losses no more than kIsNews apart; empty
  // where the last is older. told: what the reader is told beside it, and need not be told again.
  std::string words(const std::string& told = "") const;

 private:
  std::int64_t lost_ = 0, before_ = 0;       // in all; before these losses began
  std::int64_t last_ = 0, since_utime_ = 0;  // of the newest, us, steady; of the first, us, UTC
  std::string reason_;
  bool is_losing_ = false;
};

}  // namespace arcstart
