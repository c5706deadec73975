// Scans' messages on their two channels, and a collector that takes them in any order.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/scan/scan_collector.hpp"
#include "tests/seam_finding/support/synthetic_messages.hpp"

namespace arcstart::seam_finding::synthetic {

inline constexpr std::int64_t kOneSecond = 1'000'000;

// A scan of so many empty stripes: what they show does not matter here.
inline ScanMessages scan_of(int images, ScanIdentity identity = {}) {
  ScanCloud cloud;
  for (int k = 0; k < images; ++k) end_stripe(cloud, ScanStripe::Seen::kEmpty);
  return to_messages(cloud, identity);
}

inline std::vector<CollectedScan> all_of(ScanCollector& collector) {
  std::vector<CollectedScan> scans;
  while (auto scan = collector.next()) scans.push_back(std::move(*scan));
  return scans;
}

// Two channels, each in its own order.
struct Traffic {
  std::vector<scan_t> states;
  std::vector<profile_t> profiles;
};

// Delivers both channels in an order drawn at random, and gives what came of it.
inline std::vector<CollectedScan> deliver(const Traffic& traffic, std::uint64_t seed, int lead) {
  std::mt19937 engine(seed);
  ScanCollector collector;
  std::vector<CollectedScan> scans;
  std::size_t s = 0, p = 0;
  while (s < traffic.states.size() || p < traffic.profiles.size()) {
    bool state = s < traffic.states.size() && (p == traffic.profiles.size() || engine() % 2 == 0);
    // lead > 0: the states come first, lead < 0: last.
    if (lead > 0 && s < traffic.states.size()) state = true;
    if (lead < 0 && p < traffic.profiles.size()) state = false;
    if (state)
      collector.take(traffic.states[s++]);
    else
      collector.take(traffic.profiles[p++]);
    for (auto& scan : all_of(collector)) scans.push_back(std::move(scan));
  }
  return scans;
}

inline void add(Traffic& traffic, const ScanMessages& messages) {
  for (int i = 0; i < 3; ++i) traffic.states.push_back(messages.scanning);
  for (int i = 0; i < 3; ++i) traffic.states.push_back(messages.ended);
  traffic.profiles.insert(traffic.profiles.end(), messages.profiles.begin(),
                          messages.profiles.end());
}

}  // namespace arcstart::seam_finding::synthetic
