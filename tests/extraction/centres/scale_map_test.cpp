#include "services/extraction/centres/scale_map.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace arcstart::extraction;

namespace {

Branch branch_of(int first, int count, bool chosen = true) {
  Branch branch{FrameVector<int>(static_cast<std::size_t>(count)), chosen};
  std::iota(branch.points.begin(), branch.points.end(), first);
  return branch;
}

}  // namespace

TEST_CASE("each place wants the sigma of its own width, a quarter of an octave from it at most") {
  std::vector<float> widths(600, 0);
  for (int i = 0; i < 400; ++i) widths[i] = static_cast<float>(std::exp2(i / 133.0));  // 1 to 8
  widths[200] = 60;                                                                    // a speckle
  for (int i = 400; i < 500; ++i) widths[i] = 3;
  std::vector<float> sigmas;
  map_scales({branch_of(0, 400), branch_of(400, 100, false), branch_of(500, 100)}, widths,
             {1.5, 2, 9}, sigmas, heap());
  REQUIRE(sigmas.size() == 600);
  for (int i = 40; i < 360; ++i) {
    INFO(i);
    const double wanted = std::min(9.0, std::max(2.0, 1.5 * std::exp2(i / 133.0)));
    CHECK(std::abs(std::log2(sigmas[i] / wanted)) < 0.125 + 0.07);  // half a step; eight share one
  }
  CHECK(sigmas.front() < 2.2);
  CHECK(sigmas[450] == 0);  // not chosen
  CHECK(sigmas[550] == 0);  // of no known width
}
