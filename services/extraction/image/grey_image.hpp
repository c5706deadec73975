// A view of an 8-bit grey image; what it views must outlive it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace arcstart::extraction {

struct GreyImage {
  const std::uint8_t* data = nullptr;
  int width = 0;              // px
  int height = 0;             // px
  std::ptrdiff_t stride = 0;  // bytes from a row to the next

  const std::uint8_t* row(int v) const { return data + v * stride; }
  std::uint8_t at(int u, int v) const { return row(v)[u]; }
};

// Index mirrored at the ends of 0 .. size-1, the end itself not repeated: -1 is 1, size is size-2.
inline int reflect_101(int index, int size) {
  if (size == 1) return 0;
  while (index < 0 || index >= size) index = index < 0 ? -index : 2 * (size - 1) - index;
  return index;
}

}  // namespace arcstart::extraction
