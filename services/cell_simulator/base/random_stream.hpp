// Random numbers that are the same on every machine and with every library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace arcstart::cell_simulator {

// SplitMix64 (Steele, Lea and Flood 2014). Streams of one seed and different purposes are
// independent.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::uint64_t purpose = 0) : state_(seed) {
    state_ = next() ^ (purpose * 0xd1342543de82ef95ull);
  }
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // 0 to below 1
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal() {  // Box and Muller
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace arcstart::cell_simulator
