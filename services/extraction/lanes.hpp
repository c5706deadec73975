// Floats side by side in a register, for code compiled for several instruction sets.
#pragma once

#include <cstdint>
#include <cstring>

#include "services/extraction/instruction_sets.hpp"

namespace arcstart {

template <int kFloats>
struct Register {
  typedef float Lanes __attribute__((vector_size(4 * kFloats)));
  typedef std::int32_t Mask __attribute__((vector_size(4 * kFloats)));
};
template <int kFloats>
using Lanes = typename Register<kFloats>::Lanes;

template <int kFloats>
ARCSTART_INLINE_BODY Lanes<kFloats> load(const float* from) {
  Lanes<kFloats> lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class Vector>
ARCSTART_INLINE_BODY void store(float* to, Vector lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}

// Keeps a value in its register: used twice, it would be loaded twice.
template <int kFloats, class Vector>
ARCSTART_INLINE_BODY void keep([[maybe_unused]] Vector& lanes) {
#if defined(__x86_64__) && defined(__GNUC__)
  if constexpr (kFloats == 16)
    asm("" : "+v"(lanes));  // any of 32 registers
  else
    asm("" : "+x"(lanes));
#endif
}

}  // namespace arcstart
