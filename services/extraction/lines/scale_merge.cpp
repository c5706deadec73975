#include "services/extraction/lines/scale_merge.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::extraction {
namespace {

constexpr int kMeanOver = 15;        // points to each side
constexpr float kLikeCosine = 0.8f;  // of the directions: 37 degrees, as in linking
// Times as strong: below that both are kept, so that a line has no hole where one scale takes over.
constexpr float kClearly = 1.25f;
constexpr int kCell = 8;  // px, of the grid in which neighbours are looked for

// Mean curvature of each chained point's neighbours in its chain.
FrameVector<float> mean_curvatures(const ScaledLines& lines, Memory memory) {
  FrameVector<float> means(lines.points.size(), 0, memory);
  for (const Chain& chain : lines.chains) {
    const int size = static_cast<int>(chain.size());
    double sum = 0;
    int begin = 0, end = 0;
    for (int i = 0; i < size; ++i) {
      while (end < std::min(size, i + kMeanOver + 1)) sum += lines.points[chain[end++]].curvature;
      while (begin < i - kMeanOver) sum -= lines.points[chain[begin++]].curvature;
      means[chain[i]] = static_cast<float>(sum / (end - begin));
    }
  }
  return means;
}

// Chained points by the cell they lie in.
class Cells {
 public:
  Cells(const ScaledLines& lines, Memory memory) : begin_(memory), points_(memory) {
    int right = 0, below = 0;
    for (const RidgePoint& p : lines.points)
      right = std::max(right, p.column), below = std::max(below, p.row);
    columns_ = right / kCell + 1;
    rows_ = below / kCell + 1;
    begin_.assign(static_cast<std::size_t>(columns_ * rows_ + 1), 0);
    const auto for_each = [&](auto&& act) {
      for (const Chain& chain : lines.chains)
        for (const int i : chain)
          act(i, lines.points[i].row / kCell * columns_ + lines.points[i].column / kCell);
    };
    for_each([&](int, int cell) { ++begin_[cell + 1]; });
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    points_.resize(begin_.back());
    FrameVector<int> next(begin_.begin(), begin_.end() - 1, memory);
    for_each([&](int i, int cell) { points_[next[cell]++] = i; });
  }

  template <class Found>
  bool any_about(const RidgePoint& p, int reach, Found&& found) const {
    const int left = std::max(0, (p.column - reach) / kCell),
              right = std::min(columns_ - 1, (p.column + reach) / kCell),
              above = std::max(0, (p.row - reach) / kCell),
              below = std::min(rows_ - 1, (p.row + reach) / kCell);
    for (int row = above; row <= below; ++row)
      for (int k = begin_[row * columns_ + left]; k < begin_[row * columns_ + right + 1]; ++k)
        if (found(points_[k])) return true;
    return false;
  }

 private:
  int columns_ = 0, rows_ = 0;
  FrameVector<int> begin_, points_;
};

}  // namespace

void ScaledLines::clear() {
  points.clear();
  sigmas.clear();
  chains.clear();
}

void ScaledLines::add(const std::vector<RidgePoint>& found, const std::vector<Chain>& found_chains,
                      double sigma, double strength, double factor, Memory memory) {
  const int first = static_cast<int>(points.size());
  for (RidgePoint p : found) {
    p.curvature *= static_cast<float>(strength / factor);
    points.push_back(p);
  }
  sigmas.resize(points.size(), static_cast<float>(sigma));
  for (const Chain& chain : found_chains) {
    Chain& added = chains.emplace_back(chain.begin(), chain.end(), memory);
    for (int& i : added) i += first;
  }
}

void keep_best_scale(ScaledLines& lines, int fewest_points, Memory memory) {
  const FrameVector<float> means = mean_curvatures(lines, memory);
  const Cells cells(lines, memory);
  const float widest =
      lines.sigmas.empty() ? 0 : *std::max_element(lines.sigmas.begin(), lines.sigmas.end());
  const auto outdone = [&](int i) {
    const RidgePoint& p = lines.points[i];
    return cells.any_about(p, static_cast<int>(std::ceil(widest)), [&](int j) {
      const RidgePoint& q = lines.points[j];
      if (lines.sigmas[j] == lines.sigmas[i] || means[j] <= kClearly * means[i]) return false;
      const float reach = std::max(lines.sigmas[i], lines.sigmas[j]);
      const float du = q.u - p.u, dv = q.v - p.v;
      return du * du + dv * dv < reach * reach &&
             std::abs(p.normal_u * q.normal_u + p.normal_v * q.normal_v) > kLikeCosine;
    });
  };
  std::vector<Chain> kept;
  for (const Chain& chain : lines.chains) {
    Chain part(memory);
    const auto close = [&] {
      if (std::ssize(part) >= fewest_points) kept.push_back(part);
      part.clear();
    };
    for (const int i : chain)
      if (outdone(i))
        close();
      else
        part.push_back(i);
    close();
  }
  lines.chains.swap(kept);
}

}  // namespace arcstart::extraction
