// Ridge points as they are found, many at a time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "services/extraction/ridge_point.hpp"

namespace arcstart {

// A vector that is told once for many points that there is room for them.
class FoundPoints {
 public:
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  std::span<const RidgePoint> all() const { return {points_.data(), size_}; }

  // Room for so many points behind the last one; add() says how many of them were written.
  RidgePoint* room(std::size_t count) {
    if (points_.size() < size_ + count) points_.resize(2 * (size_ + count));
    return points_.data() + size_;
  }
  void add(std::size_t count) { size_ += count; }

 private:
  std::vector<RidgePoint> points_;
  std::size_t size_ = 0;
};

}  // namespace arcstart
