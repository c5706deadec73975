#include "common/bus/value_checks.hpp"

#include <glib.h>

#include <algorithm>

namespace arcstart {
namespace {

constexpr std::size_t kLongestName = 256;  // bytes; seam_t repeats a job's and a part's

bool is_control(char character) {
  const auto code = static_cast<unsigned char>(character);
  return code < 0x20 || code == 0x7F;
}

}  // namespace

bool is_name(const std::string& text) {
  return text.size() <= kLongestName && std::none_of(text.begin(), text.end(), is_control) &&
         g_utf8_validate(text.data(), static_cast<gssize>(text.size()), nullptr);
}

}  // namespace arcstart
