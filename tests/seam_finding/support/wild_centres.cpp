#include "tests/seam_finding/support/wild_centres.hpp"

#include <algorithm>
#include <arcstart/profile_t.hpp>
#include <cmath>
#include <numbers>

namespace arcstart::seam_finding::synthetic {
namespace {

using cell_simulator::RandomStream, cell_simulator::WildSurface;
using Eigen::Vector2d;

constexpr double joined_px = 1.5;  // pieces whose ends lie so near are one segment
constexpr double run_px = 12;      // mean length of a dropout
constexpr int lost_px = 3;         // a longer one parts a segment

// A polygon line in the image: piece i runs from corners[i] to corners[i + 1].
struct Chain {
  std::vector<Vector2d> corners;
  std::vector<int> objects;
  std::vector<char> in_band;
  std::vector<double> arc;  // length up to each corner; px
  bool ghost = false;
};

std::vector<Chain> chains_of(const std::vector<WildPiece>& pieces) {
  std::vector<Chain> chains;
  for (const WildPiece& piece : pieces) {
    const bool on = !chains.empty() && chains.back().ghost == piece.ghost &&
                    (chains.back().corners.back() - piece.begin_px).norm() < joined_px;
    const int object = piece.ghost ? -1 : piece.object;
    if (!on) {
      chains.push_back({{piece.begin_px}, {}, {}, {0}, piece.ghost});
    }
    Chain& chain = chains.back();
    const double length = (piece.end_px - chain.corners.back()).norm();
    if (length < 1e-9) continue;
    chain.corners.push_back(piece.end_px);
    chain.objects.push_back(object);
    chain.in_band.push_back(piece.in_band);
    chain.arc.push_back(chain.arc.back() + length);
  }
  return chains;
}

// How far a Gaussian of this sigma carries a line off its bend, for each unit of change of its
// direction: the line convolved with it.
double rounding(double distance, double sigma) {
  const double s = distance / sigma;
  return sigma * (std::exp(-s * s / 2) / std::sqrt(2 * std::numbers::pi) -
                  s * 0.5 * std::erfc(s / std::sqrt(2.0)));
}

class Sampler {
 public:
  Sampler(const Chain& chain, double blur) : chain_(chain), blur_(blur) {
    const std::size_t pieces = chain.objects.size();
    for (std::size_t i = 0; i < pieces; ++i)
      ways_.push_back((chain.corners[i + 1] - chain.corners[i]).normalized());
    for (std::size_t i = 0; i + 1 < pieces; ++i)
      if ((ways_[i + 1] - ways_[i]).norm() > 0.02) bends_.push_back(i);
  }
  const Vector2d& way(std::size_t piece) const { return ways_[piece]; }

  // The line at a place along it, its bends rounded.
  Vector2d at(std::size_t piece, double along) {
    Vector2d p = chain_.corners[piece] + (along - chain_.arc[piece]) * ways_[piece];
    const double reach = 4 * blur_;
    while (first_bend_ < bends_.size() && chain_.arc[bends_[first_bend_] + 1] < along - reach)
      ++first_bend_;
    for (std::size_t k = first_bend_; k < bends_.size(); ++k) {
      const double distance = std::abs(chain_.arc[bends_[k] + 1] - along);
      if (distance > reach) break;
      p += rounding(distance, blur_) * (ways_[bends_[k] + 1] - ways_[bends_[k]]);
    }
    return p;
  }

 private:
  const Chain& chain_;
  double blur_;
  std::vector<Vector2d> ways_;
  std::vector<std::size_t> bends_;  // before which piece's end
  std::size_t first_bend_ = 0;
};

// Places along the chain, ascending: its begin, wherever it crosses a whole column (or row, where
// it runs steeply), its end.
struct Place {
  std::size_t piece;
  double along;
};
std::vector<Place> places_on(const Chain& chain) {
  std::vector<Place> places{{0, 0}};
  for (std::size_t i = 0; i < chain.objects.size(); ++i) {
    const Vector2d &a = chain.corners[i], &b = chain.corners[i + 1], way = b - a;
    const int axis = std::abs(way.x()) >= std::abs(way.y()) ? 0 : 1;
    const double from = a[axis], to = b[axis], length = chain.arc[i + 1] - chain.arc[i];
    const int sense = to > from ? 1 : -1;
    for (double whole = sense > 0 ? std::ceil(from) : std::floor(from); sense * (to - whole) > 0;
         whole += sense) {
      const double along = chain.arc[i] + length * (whole - from) / (to - from);
      if (along > places.back().along + 0.5) places.push_back({i, along});
    }
  }
  if (chain.arc.back() > places.back().along + 0.5)
    places.push_back({chain.objects.size() - 1, chain.arc.back()});
  else if (places.size() > 1)
    places.back() = {chain.objects.size() - 1, chain.arc.back()};
  return places;
}

bool at_border(const Vector2d& p, const WildExtraction& extraction) {
  constexpr double near_px = 1.5;
  return p.x() < near_px || p.y() < near_px || p.x() > extraction.width - 1 - near_px ||
         p.y() > extraction.height - 1 - near_px;
}

// Columns in which something lit directly is seen: there extraction takes a ghost for what it is.
std::vector<char> direct_columns(const std::vector<WildPiece>& pieces, int width) {
  std::vector<char> direct(width, 0);
  for (const WildPiece& piece : pieces) {
    if (piece.ghost) continue;
    const auto [low, high] = std::minmax(piece.begin_px.x(), piece.end_px.x());
    for (int u = std::max(0, static_cast<int>(low)); u <= std::min(width - 1.0, high); ++u)
      direct[u] = 1;
  }
  return direct;
}

}  // namespace

std::vector<WildCentre> centres_of(const std::vector<WildPiece>& pieces,
                                   const std::vector<WildSurface>& surfaces,
                                   const WildExtraction& extraction, RandomStream& random) {
  std::vector<WildCentre> centres;
  const std::vector<char> direct = direct_columns(pieces, extraction.width);
  int segment = 0;
  for (const Chain& chain : chains_of(pieces)) {
    if (chain.objects.empty() || chain.arc.back() < extraction.least_length_px) continue;
    Sampler line(chain, extraction.bend_blur_px);
    std::size_t first = centres.size();
    const auto close = [&] {
      if (centres.size() == first) return;
      if (static_cast<double>(centres.size() - first) < extraction.least_length_px) {
        centres.resize(first);
        return;
      }
      for (std::size_t i : {first, centres.size() - 1})
        if (centres[i].segment_end == profile_t::CONTINUES)
          centres[i].segment_end =
              at_border(centres[i].pixel, extraction) ? profile_t::BORDER : profile_t::GAP;
      ++segment;
      first = centres.size();
    };
    const std::vector<Place> places = places_on(chain);
    int dropped = 0, to_drop = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& place = places[i];
      const int object = chain.objects[place.piece];
      const bool in_band = chain.in_band[place.piece] != 0;
      const WildSurface surface =
          object < 0 ? WildSurface{} : surfaces[object + (in_band ? surfaces.size() / 2 : 0)];
      if (surface.dropout_share > 0 && to_drop == 0 &&
          random.uniform() < surface.dropout_share / run_px)
        to_drop = 1 + static_cast<int>(-run_px * std::log(1 - random.uniform()));
      const int column = static_cast<int>(chain.corners[place.piece].x());
      if (chain.ghost && column >= 0 && column < extraction.width && direct[column]) to_drop = 1;
      if (to_drop > 0) {
        --to_drop;
        if (++dropped > lost_px) close();
        continue;
      }
      dropped = 0;
      const Vector2d& way = line.way(place.piece);
      const Vector2d across(-way.y(), way.x());
      const double deviation = surface.noise_px * extraction.noise_factor;
      Vector2d pixel = line.at(place.piece, place.along) + deviation * random.normal() * across;
      const bool end = i == 0 || i + 1 == places.size();
      std::int8_t why = profile_t::CONTINUES;
      if (end) {
        why = at_border(pixel, extraction) ? profile_t::BORDER : profile_t::EDGE;
        pixel += extraction.end_noise_px * random.normal() * way;
      }
      centres.push_back({pixel, across, deviation, segment, why, object});
    }
    close();
  }
  return centres;
}

std::vector<WildCentre> thinned(const std::vector<WildCentre>& centres, int keep_every,
                                double bend_px) {
  std::vector<char> kept(centres.size(), 0);
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  std::size_t first = 0, before = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const bool begins = i == 0 || centres[i].segment != centres[i - 1].segment;
    const bool ends = i + 1 == centres.size() || centres[i].segment != centres[i + 1].segment;
    if (begins) first = i;
    if ((i - first) % static_cast<std::size_t>(keep_every) != 0 && !ends) continue;
    kept[i] = 1;
    if (!begins && bend_px > 0) spans.emplace_back(before, i);
    before = i;
  }
  while (!spans.empty()) {
    const auto [from, to] = spans.back();
    spans.pop_back();
    const Vector2d &a = centres[from].pixel, way = centres[to].pixel - a;
    const double length = way.norm();
    if (length <= 0) continue;
    double most = bend_px;
    std::size_t farthest = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const Vector2d off = centres[i].pixel - a;
      const double distance = std::abs(off.x() * way.y() - off.y() * way.x()) / length;
      if (distance > most) most = distance, farthest = i;
    }
    if (farthest == from) continue;
    kept[farthest] = 1;
    spans.emplace_back(from, farthest);
    spans.emplace_back(farthest, to);
  }
  std::vector<WildCentre> result;
  for (std::size_t i = 0; i < centres.size(); ++i)
    if (kept[i]) result.push_back(centres[i]);
  return result;
}

}  // namespace arcstart::seam_finding::synthetic
