#include "services/extraction/lines/chain_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace arcstart::extraction {
namespace {

// A chain's end, seen on from it: lines that leave a corner at a small angle are told apart only
// some way from it.
struct Outlook {
  float u, v, du, dv, reach;

  Outlook(const std::vector<RidgePoint>& points, const Chain& chain, bool last, double reach_px)
      : reach(static_cast<float>(reach_px)) {
    const int size = static_cast<int>(chain.size()), step = std::min(10, size - 1);
    const RidgePoint& tip = points[last ? chain.back() : chain.front()];
    const RidgePoint& inner = points[last ? chain[size - 1 - step] : chain[step]];
    const float length = std::max(1e-3f, std::hypot(tip.u - inner.u, tip.v - inner.v));
    u = tip.u;
    v = tip.v;
    du = (tip.u - inner.u) / length;
    dv = (tip.v - inner.v) / length;
  }
  float far_u() const { return u + 4 * reach * du; }
  float far_v() const { return v + 4 * reach * dv; }
  // Whether it lies no farther than reach from the stretch of four times that before the end, and
  // its pixel's row does not lie below all of that.
  bool sees(const RidgePoint& p) const {
    if (static_cast<float>(p.row) > std::max(v, far_v()) + reach) return false;
    const float along = std::clamp((p.u - u) * du + (p.v - v) * dv, 0.0f, 4 * reach);
    const float beside_u = std::abs(p.u - u - along * du),
                beside_v = std::abs(p.v - v - along * dv);
    return beside_u <= reach && beside_v <= reach && std::hypot(beside_u, beside_v) <= reach;
  }
  float from_end(const RidgePoint& p) const { return std::hypot(p.u - u, p.v - v); }
};

// The chains' points by where they lie, so that those near a place are found without looking at the
// others.
class PointGrid {
 public:
  PointGrid(const std::vector<RidgePoint>& points, const std::vector<Chain>& chains, Memory memory)
      : cell_begin_(memory), points_(memory) {
    int last_column = 0, last_row = 0;
    for (const Chain& chain : chains)
      for (const int i : chain) {
        last_column = std::max(last_column, points[i].column);
        last_row = std::max(last_row, points[i].row);
      }
    columns_ = last_column / kCell + 1;
    rows_ = last_row / kCell + 1;
    cell_begin_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    const auto cell_of = [&](int i) {
      return points[i].row / kCell * columns_ + points[i].column / kCell;
    };
    for (const Chain& chain : chains)
      for (const int i : chain) ++cell_begin_[cell_of(i)];
    std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());
    points_.resize(static_cast<std::size_t>(cell_begin_.back()));
    for (const Chain& chain : chains)
      for (const int i : chain) points_[--cell_begin_[cell_of(i)]] = i;
  }

  template <class Take>
  void for_each_seen(const Outlook& outlook, const std::vector<RidgePoint>& points,
                     Take take) const {
    const auto cell = [&](float at, int cells) {
      return std::clamp(static_cast<int>(at) / kCell, 0, cells - 1);
    };
    const float margin = outlook.reach + 1;  // a point lies up to half a pixel beside its pixel
    const int left = cell(std::min(outlook.u, outlook.far_u()) - margin, columns_),
              right = cell(std::max(outlook.u, outlook.far_u()) + margin, columns_),
              top = cell(std::min(outlook.v, outlook.far_v()) - margin, rows_),
              bottom = cell(std::max(outlook.v, outlook.far_v()) + margin, rows_);
    for (int row = top; row <= bottom; ++row)
      for (int k = cell_begin_[row * columns_ + left]; k < cell_begin_[row * columns_ + right + 1];
           ++k)
        if (outlook.sees(points[points_[k]])) take(points_[k]);
  }

 private:
  static constexpr int kCell = 8;  // px
  int columns_ = 0, rows_ = 0;
  FrameVector<int> cell_begin_;  // the first of each cell's points, and the end
  FrameVector<int> points_;
};

}  // namespace

FrameVector<ChainContact> find_contacts(const std::vector<RidgePoint>& points,
                                        const std::vector<Chain>& chains,
                                        const FrameVector<ChainPlace>& places, double reach,
                                        Memory memory) {
  const PointGrid grid(points, chains, memory);
  FrameVector<ChainContact> meetings(memory);
  FrameVector<int> nearest(chains.size(), -1, memory);     // point of each chain
  FrameVector<float> lowest(chains.size(), 0.0f, memory);  // its distance from the end
  FrameVector<int> met(memory);                            // chains
  for (const Chain& chain : chains)
    for (const bool last : {false, true}) {
      const Outlook outlook(points, chain, last, reach);
      const int end = last ? chain.back() : chain.front();
      met.clear();
      grid.for_each_seen(outlook, points, [&](int i) {
        const int other = places[i].chain;
        if (other == places[end].chain) return;
        const float distance = outlook.from_end(points[i]);
        int& best = nearest[other];
        if (best < 0) met.push_back(other);
        if (best >= 0 && (distance > lowest[other] || (distance == lowest[other] && i > best)))
          return;
        best = i;
        lowest[other] = distance;
      });
      std::sort(met.begin(), met.end());
      for (const int other : met) meetings.push_back({end, std::exchange(nearest[other], -1)});
    }
  return meetings;
}

}  // namespace arcstart::extraction
