#include "services/seam_finding/ends/end_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "services/seam_finding/ends/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// By a normal distribution, as repeated steps to the neighbours.
std::vector<double> blurred(std::vector<double> values, double deviation, double step) {
  const double variance = deviation * deviation / (step * step);  // of cells
  const int times = static_cast<int>(std::ceil(variance / kEnds.blur_variance));
  for (int pass = 0; pass < times; ++pass) {
    const double aside = variance / times / 2;
    double before = values.front();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double here = values[i], after = values[std::min(i + 1, values.size() - 1)];
      values[i] = (1 - 2 * aside) * here + aside * (before + after);
      before = here;
    }
  }
  return values;
}

// That the plate ends farther out than each place: as long as the grid tells nothing more, over
// `kEnds.offsets` beyond it.
std::vector<double> beyond(const std::vector<double>& values, double step) {
  std::vector<double> sums(values.size());
  double sum = values.back() * kEnds.offsets;
  for (std::size_t i = values.size(); i-- > 0;) {
    sum += values[i] * step / 2;
    sums[i] = sum;
    sum += values[i] * step / 2;
  }
  return sums;
}

}  // namespace

std::vector<EndMode> seam_end_modes(const std::array<FootLikelihood, 2>& plates,
                                    const PlaceGrid& grid) {
  const auto a = blurred(plates[0].at, plates[0].deviation, grid.step),
             b = blurred(plates[1].at, plates[1].deviation, grid.step);
  const auto a_beyond = beyond(a, grid.step), b_beyond = beyond(b, grid.step);
  const double flush = kEnds.flush_share, apart = (1 - flush) / (2 * kEnds.offsets);
  std::vector<double> density(a.size());
  // Of both beyond the grid, on average.
  double total = apart * a.back() * b.back() * kEnds.offsets * kEnds.offsets;
  for (std::size_t i = 0; i < density.size(); ++i) {
    density[i] = flush * a[i] * b[i] + apart * (a[i] * b_beyond[i] + b[i] * a_beyond[i]);
    total += density[i] * grid.step;
  }

  std::vector<EndMode> modes;
  const double least = kEnds.least_density * total;
  for (std::size_t i = 0; i < density.size();) {
    if (density[i] < least) {
      ++i;
      continue;
    }
    double sum = 0, places = 0, squares = 0;
    const double origin = grid.at(static_cast<double>(i));
    for (; i < density.size() && density[i] >= least; ++i) {
      const double place = grid.at(static_cast<double>(i)) - origin;
      sum += density[i], places += density[i] * place, squares += density[i] * place * place;
    }
    const double mean = places / sum;
    modes.push_back(
        {origin + mean, std::max(0.0, squares / sum - mean * mean), sum * grid.step / total});
  }
  std::sort(modes.begin(), modes.end(),
            [](const EndMode& one, const EndMode& other) { return one.weight > other.weight; });
  return modes;
}

}  // namespace arcstart::seam_finding
