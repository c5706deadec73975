// An ideal camera that exposes at known times, and a scan of its frames: which belong to it, and
// when its end can be told, follows by hand.
#pragma once

#include <catch2/catch.hpp>
#include <vector>

#include "services/sensor_capture/scan/scan_owner.hpp"

namespace arcstart::test {

using namespace sensor_capture;

constexpr std::int64_t kStart = 1'700'000'000'000'000;
constexpr std::int64_t ms = 1000;
constexpr std::int64_t kPeriod = 100 * ms;
constexpr std::int64_t kExposure = 4 * ms;

// Frame n is exposed from n * 100 ms to n * 100 + 4 ms, all counted from kStart.
struct IdealCell {
  ScanOwner owner;
  std::vector<std::int64_t> members;  // seq
  std::vector<std::int32_t> indices;

  explicit IdealCell(ScanOwnerSettings settings = {}) : owner(settings) {
    owner.set_shortest_period(kPeriod * 95 / 100);
  }
  static std::int64_t at(std::int64_t milliseconds) { return kStart + milliseconds * ms; }

  Membership frame(std::int64_t n, bool lit = true, bool complete = true) {
    const ExposedFrame frame{n, kStart + n * kPeriod, kStart + n * kPeriod + kExposure, lit,
                             complete};
    const Membership membership = owner.frame(frame);
    if (membership.scan_id != 0) {
      CHECK(membership.scan_id == owner.state().scan.scan_id);
      members.push_back(n);
      indices.push_back(membership.scan_index);
    }
    return membership;
  }
  void start(std::int64_t id, std::int64_t milliseconds, double longest_s = 60,
             std::int8_t kind = 1) {
    owner.order({id, true, kind, longest_s}, at(milliseconds), "");
  }
  void stop(std::int64_t id, std::int64_t milliseconds) {
    owner.order({id, false, 0, 0}, at(milliseconds), "");
  }
  const ScanState& state() const { return owner.state(); }
  const Scan& scan() const { return owner.state().scan; }
};

}  // namespace arcstart::test
