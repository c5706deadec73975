// Values side by side in a register, for code compiled for several instruction sets.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "common/instruction_sets.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)  // builtins of GCC's own
#include <immintrin.h>
#endif

namespace arcstart::extraction {

// All of one size, but for Fours: a value for each four of the words.
template <int kFloats>
struct Register {
  typedef float Lanes __attribute__((vector_size(4 * kFloats)));
  typedef std::int32_t Mask __attribute__((vector_size(4 * kFloats)));
  typedef std::uint8_t Bytes __attribute__((vector_size(4 * kFloats)));
  typedef std::uint16_t Words __attribute__((vector_size(4 * kFloats)));
  typedef std::int16_t SignedWords __attribute__((vector_size(4 * kFloats)));
  typedef std::uint64_t Longs __attribute__((vector_size(4 * kFloats)));
  typedef std::uint16_t Fours __attribute__((vector_size(kFloats)));
};
template <int kFloats>
using Lanes = typename Register<kFloats>::Lanes;
template <int kFloats>
using Words = typename Register<kFloats>::Words;

template <class Vector, class Element>
ARCSTART_INLINE_BODY Vector load_as(const Element* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}
template <class Element, class Vector>
ARCSTART_INLINE_BODY void store(Element* to, Vector vector) {
  std::memcpy(to, &vector, sizeof vector);
}
template <class Vector>
ARCSTART_INLINE_BODY Vector higher_of(Vector a, Vector b) {
  return a > b ? a : b;
}

// Step by step: the compiler takes one step over both apart.
template <int kFloats>
ARCSTART_INLINE_BODY typename Register<kFloats>::Fours low_words(
    typename Register<kFloats>::Longs longs) {
  typedef std::uint32_t Halves __attribute__((vector_size(2 * kFloats)));
  return __builtin_convertvector(__builtin_convertvector(longs, Halves),
                                 typename Register<kFloats>::Fours);
}

// The highest of each four words.
template <int kFloats>
ARCSTART_INLINE_BODY typename Register<kFloats>::Fours highest_of_fours(Words<kFloats> words) {
  using Longs = typename Register<kFloats>::Longs;
  for (const int bits : {32, 16}) words = higher_of(words, (Words<kFloats>)((Longs)words >> bits));
  return low_words<kFloats>((Longs)words);
}

template <int kFloats>
ARCSTART_INLINE_BODY Lanes<kFloats> load(const float* from) {
  Lanes<kFloats> lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

// Bit i: value i is negative.
template <int kFloats>
ARCSTART_INLINE_BODY std::uint32_t signs_of(typename Register<kFloats>::Mask values) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)  // builtins of GCC's own
  if constexpr (kFloats == 16) {
    typedef int Ints __attribute__((vector_size(64)));
    return __builtin_ia32_cvtd2mask512((Ints)values);
  }
  if constexpr (kFloats == 8)
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps256((Lanes<8>)values));
#endif
  std::uint32_t bits = 0;
  for (int i = 0; i < kFloats; ++i) bits |= static_cast<std::uint32_t>(values[i] < 0) << i;
  return bits;
}

// Stores the values that bits name one behind the other. A register's room is written to.
template <int kFloats>
ARCSTART_INLINE_BODY void store_named(float* to, Lanes<kFloats> values, std::uint32_t bits) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)  // builtins of GCC's own
  if constexpr (kFloats == 16) {
    store(to,
          __builtin_ia32_compresssf512_mask(values, Lanes<16>{}, static_cast<std::uint16_t>(bits)));
    return;
  }
#endif
  float all[kFloats];
  store(all, values);
  for (; bits != 0; bits &= bits - 1) *to++ = all[std::countr_zero(bits)];
}

// Keeps a value in its register: used twice, it would be loaded twice.
template <int kFloats, class Vector>
ARCSTART_INLINE_BODY void keep([[maybe_unused]] Vector& lanes) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)  // builtins of GCC's own
  if constexpr (kFloats == 16)
    asm("" : "+v"(lanes));  // any of 32 registers
  else
    asm("" : "+x"(lanes));
#endif
}

}  // namespace arcstart::extraction
