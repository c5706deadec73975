#include "services/extraction/image/frame_arena.hpp"

#include <algorithm>
#include <memory>

namespace arcstart::extraction {

void* FrameArena::do_allocate(std::size_t bytes, std::size_t alignment) {
  constexpr std::size_t kLeast = 1 << 16;
  if (!blocks_.empty()) {
    std::vector<std::byte>& block = blocks_.back();
    void* place = block.data() + used_;
    std::size_t room = block.size() - used_;
    if (std::align(alignment, bytes, place, room) != nullptr) {
      used_ = block.size() - room + bytes;
      return place;
    }
  }
  const std::size_t last = blocks_.empty() ? 0 : blocks_.back().size();
  blocks_.emplace_back(std::max({kLeast, 2 * last, bytes + alignment}));
  used_ = 0;
  return do_allocate(bytes, alignment);
}

void FrameArena::take_back() {
  used_ = 0;
  if (blocks_.size() <= 1) return;
  std::size_t all = 0;
  for (const auto& block : blocks_) all += block.size();
  blocks_.clear();
  blocks_.emplace_back(all);
}

}  // namespace arcstart::extraction
