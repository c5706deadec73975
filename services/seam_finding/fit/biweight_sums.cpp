#include "services/seam_finding/fit/biweight_sums.hpp"

#include <algorithm>
#include <cstring>

#include "common/instruction_sets.hpp"
#include "services/seam_finding/fit/constants.hpp"

namespace arcstart::seam_finding {
namespace {

struct Task {
  PlacedHeights points;
  float offset, along, across;  // of the plane
  float share;                  // one over the limit; 1/mm
  BiweightSums& sums;
};

template <int kFloats>
struct FloatRegister {
  typedef float Floats __attribute__((vector_size(4 * kFloats)));
};

template <int kFloats>
ARCSTART_INLINE_BODY void add_up_body(const Task& task) {
  using Floats = typename FloatRegister<kFloats>::Floats;
  BiweightSums& sums = task.sums;
  for (std::size_t first = 0; first < task.points.count; first += kFit.sum_block) {
    Floats w{}, a{}, b{}, aa{}, ab{}, bb{}, r{}, ra{}, rb{};
    const std::size_t last = std::min(first + kFit.sum_block, task.points.count);
    for (std::size_t i = first; i < last; i += kFloats) {
      Floats pa, pb, off;
      std::memcpy(&pa, task.points.a + i, sizeof pa);
      std::memcpy(&pb, task.points.b + i, sizeof pb);
      std::memcpy(&off, task.points.h + i, sizeof off);
      off -= task.offset + task.along * pa + task.across * pb;
      const Floats rest = 1 - (off * task.share) * (off * task.share);
      const Floats inside = rest > 0 ? rest : Floats{};
      const Floats weight = inside * inside;
      const Floats wa = weight * pa, wb = weight * pb, wr = weight * off;
      w += weight, a += wa, b += wb, r += wr;
      aa += wa * pa, ab += wa * pb, bb += wb * pb, ra += wr * pa, rb += wr * pb;
    }
    const auto total = [](const Floats& lanes) {
      double sum = 0;
      for (int k = 0; k < kFloats; ++k) sum += static_cast<double>(lanes[k]);
      return sum;
    };
    sums.w += total(w), sums.a += total(a), sums.b += total(b), sums.r += total(r);
    sums.aa += total(aa), sums.ab += total(ab), sums.bb += total(bb);
    sums.ra += total(ra), sums.rb += total(rb);
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(add_up, (const Task& task), (task))

}  // namespace

BiweightSums biweight_sums(const PlacedHeights& points, double offset, double along, double across,
                           double limit) {
  BiweightSums sums;
  add_up({points, static_cast<float>(offset), static_cast<float>(along), static_cast<float>(across),
          static_cast<float>(1 / limit), sums});
  return sums;
}

}  // namespace arcstart::seam_finding
