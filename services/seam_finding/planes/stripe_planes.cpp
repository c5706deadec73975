#include "services/seam_finding/planes/stripe_planes.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "services/seam_finding/fit/plane_fit.hpp"
#include "services/seam_finding/planes/constants.hpp"

namespace arcstart::seam_finding {
namespace {

struct Piece {
  int stripe = 0;
  Eigen::Vector3d from, to;  // its ends
  Eigen::Vector3d middle, direction;
  double length = 0;
  PlaneSums sums;
  bool taken = false;

  Piece(const ScanCloud& cloud, std::span<const int> points)
      : stripe(cloud.origins[points.front()].stripe),
        from(cloud.points[points.front()]),
        to(cloud.points[points.back()]),
        middle((from + to) / 2),
        direction((to - from).normalized()),
        length((to - from).norm()),
        sums(from) {
    for (const int i : points) sums.add(cloud.points[i]);
  }
};

// Parts a run where it is farthest from its chord, until it is nowhere farther than the tolerance.
void part(const ScanCloud& cloud, std::span<const int> run, double tolerance,
          std::vector<Piece>& pieces) {
  if (run.size() < kModel.sure_points) return;
  const Eigen::Vector3d& from = cloud.points[run.front()];
  const Eigen::Vector3d chord = cloud.points[run.back()] - from;
  if (!(chord.norm() > tolerance)) return;
  const Eigen::Vector3d along = chord.normalized();
  double farthest = tolerance * tolerance;
  std::size_t corner = 0;
  for (std::size_t k = 1; k + 1 < run.size(); ++k) {
    const Eigen::Vector3d off = cloud.points[run[k]] - from;
    const double t = off.dot(along), squared = off.squaredNorm() - t * t;
    if (squared > farthest) farthest = squared, corner = k;
  }
  if (corner == 0) {
    pieces.emplace_back(cloud, run);
    return;
  }
  part(cloud, run.first(corner + 1), tolerance, pieces);
  part(cloud, run.subspan(corner), tolerance, pieces);
}

// Stripe by stripe, of each in its order: its runs without a gap, in parts that bound the work.
std::vector<Piece> straight_pieces(const ScanCloud& cloud, const std::vector<int>& indices,
                                   double tolerance) {
  std::vector<Piece> pieces, of_stripe;
  const auto close_stripe = [&] {
    if (of_stripe.size() > kPlanes.stripe_pieces) {
      std::stable_sort(of_stripe.begin(), of_stripe.end(),
                       [](const Piece& a, const Piece& b) { return a.length > b.length; });
      of_stripe.resize(kPlanes.stripe_pieces, of_stripe.front());
    }
    std::move(of_stripe.begin(), of_stripe.end(), std::back_inserter(pieces));
    of_stripe.clear();
  };
  for (std::size_t first = 0, last = 0; first < indices.size(); first = last) {
    const PointOrigin& origin = cloud.origins[indices[first]];
    for (last = first + 1; last < indices.size() && last - first < kPlanes.piece_points; ++last)
      if (cloud.origins[indices[last]].stripe != origin.stripe ||
          cloud.origins[indices[last]].segment != origin.segment ||
          indices[last] - indices[last - 1] > kModel.sure_points)
        break;
    if (!of_stripe.empty() && of_stripe.front().stripe != origin.stripe) close_stripe();
    part(cloud, std::span(indices).subspan(first, last - first), tolerance, of_stripe);
  }
  close_stripe();
  return pieces;
}

bool beside(const Piece& a, const Piece& b, double connection) {
  const double shift = std::abs(a.direction.dot(b.middle - a.middle));
  return shift - (a.length + b.length) / 2 <= connection;
}

bool parallel(const Piece& a, const Piece& b, double tolerance) {
  const double open = kPlanes.parallel_pieces + 2 * tolerance * (1 / a.length + 1 / b.length);
  return a.direction.cross(b.direction).norm() <= open;
}

// Pieces that follow a first one in its plane.
struct Chain {
  PlaneSums sums;
  Plane plane;
  std::vector<Piece*> pieces;
};

Chain chain_from(Piece& first, std::span<Piece> behind, const PlaneSearch& search) {
  Chain chain{first.sums, {}, {&first}};
  Piece* next = nullptr;
  double nearest = 0;
  const auto join = [&] {
    if (next == nullptr) return;
    chain.sums.add(next->sums);
    chain.plane = chain.sums.fit().plane;
    chain.pieces.push_back(next);
    next = nullptr;
  };
  int stripe = first.stripe;
  for (Piece& piece : behind) {
    if (piece.stripe != stripe) join(), stripe = piece.stripe;
    const Piece& last = *chain.pieces.back();
    if (piece.stripe > last.stripe + kModel.stripes_in_a_row) break;
    if (piece.stripe == last.stripe || piece.taken || !beside(last, piece, search.connection))
      continue;
    if (chain.pieces.size() == 1
            ? !parallel(last, piece, search.tolerance)
            : std::abs(chain.plane.signed_distance(piece.from)) > search.tolerance ||
                  std::abs(chain.plane.signed_distance(piece.to)) > search.tolerance)
      continue;
    const double distance = (piece.middle - last.middle).squaredNorm();
    if (next == nullptr || distance < nearest) next = &piece, nearest = distance;
  }
  join();
  return chain;
}

}  // namespace

std::vector<Plane> planes_of_stripes(const ScanCloud& cloud, const std::vector<int>& indices,
                                     const PlaneSearch& search) {
  if (!cloud.organised()) return {};
  std::vector<Piece> pieces = straight_pieces(cloud, indices, search.tolerance);
  std::vector<std::pair<double, Plane>> found;  // by their points
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].taken) continue;
    const Chain chain = chain_from(pieces[i], std::span(pieces).subspan(i + 1), search);
    if (chain.pieces.size() < kModel.stripes_in_a_row) continue;
    for (Piece* piece : chain.pieces) piece->taken = true;
    if (!search.accept || search.accept(chain.plane))
      found.emplace_back(chain.sums.weight(), chain.plane);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Plane> planes;
  for (const auto& [points, plane] : found)
    if (planes.size() < static_cast<std::size_t>(search.hypotheses)) planes.push_back(plane);
  return planes;
}

}  // namespace arcstart::seam_finding
