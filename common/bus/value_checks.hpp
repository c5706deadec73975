// What the values of a message must satisfy, and the first condition that does not hold.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

namespace arcstart {

constexpr double kLongest = 1e7;  // mm: ten kilometres; nothing in a cell is farther away

template <class List>
bool all_finite(const List& values) {
  for (const double value : values)
    if (!std::isfinite(value) || std::abs(value) > 1e30) return false;
  return true;
}

// Before the year 10000: a stamp to which any setting in seconds can be added.
inline bool is_time(std::int64_t utime) { return utime > 0 && utime < 253'402'300'800'000'000; }

inline bool is_length(double value) { return std::isfinite(value) && std::abs(value) <= kLongest; }

template <class List>
bool are_lengths(const List& values) {
  for (const double value : values)
    if (!is_length(value)) return false;
  return true;
}

inline bool is_unit(const double* values, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += values[i] * values[i];
  return std::abs(sum - 1) < 1e-6;
}

// -1 stands for not known.
inline bool is_known_or_not(double value) {
  return value == -1 || (value >= 0 && is_length(value));
}

// Of the less probable of two.
inline bool is_weight(double value) { return value >= 0 && value <= 0.5; }

// A short line of UTF-8, of a job or a part: it goes into JSON as it stands.
bool is_name(const std::string& text);
inline constexpr const char* kNoName = "job or part is no line of UTF-8 of at most 256 bytes";

// Collects the first condition that fails.
class Checks {
 public:
  Checks& require(bool condition, const char* why) {
    if (!condition && error_.empty()) error_ = why;
    return *this;
  }
  const std::string& error() const { return error_; }

 private:
  std::string error_;
};

}  // namespace arcstart
