// Memory for what lives no longer than one image: handed out in order, taken back all at once.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

namespace arcstart::extraction {

// A function that needs memory for its while takes it from such a resource; from the heap where
// none is given.
using Memory = std::pmr::memory_resource*;
inline Memory heap() { return std::pmr::get_default_resource(); }

template <class Value>
using FrameVector = std::pmr::vector<Value>;

// Takes memory from the heap only while images need more than all before them.
class FrameArena : public std::pmr::memory_resource {
 public:
  // Nothing that was handed out may be touched any more.
  void take_back();

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
    return this == &other;
  }

  std::vector<std::vector<std::byte>>
      blocks_;            // the first is used again and again, others are for once
  std::size_t used_ = 0;  // of the last block
};

}  // namespace arcstart::extraction
