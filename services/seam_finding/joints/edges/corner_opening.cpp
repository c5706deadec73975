#include "services/seam_finding/joints/edges/corner_opening.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/order_statistics.hpp"
#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// Of each stripe the face's point nearest to the line, and how far that is; mm.
struct Nearest {
  int point = -1;
  double from_line = std::numeric_limits<double>::infinity();
};
std::vector<Nearest> nearest_points(const ScanCloud& cloud, const Face& face, const Plane& other,
                                    const Line& line) {
  const Eigen::Vector3d& normal = face.plane.normal;
  const Eigen::Vector3d away = -(other.normal - other.normal.dot(normal) * normal).normalized();
  std::vector<Nearest> stripes(cloud.stripes.size());
  for (const int i : face.points) {
    Nearest& stripe = stripes[cloud.origins[i].stripe];
    if (const double r = away.dot(cloud.points[i] - line.point); r < stripe.from_line)
      stripe = {i, r};
  }
  return stripes;
}

}  // namespace

std::array<double, 2> corner_opening(const ScanCloud& cloud,
                                     const std::array<const Face*, 2>& faces, const Line& line,
                                     const Scales& scales) {
  if (!cloud.organised()) return {};
  std::array<std::vector<Nearest>, 2> nearest;
  for (int j = 0; j < 2; ++j)
    nearest[j] = nearest_points(cloud, *faces[j], faces[1 - j]->plane, line);
  std::array<std::vector<double>, 2> begins;
  std::vector<int> both;  // stripes
  for (int k = 0; k < std::ssize(cloud.stripes); ++k) {
    if (nearest[0][k].point < 0 || nearest[1][k].point < 0) continue;
    both.push_back(k);
    for (int j = 0; j < 2; ++j) begins[j].push_back(nearest[j][k].from_line);
  }
  if (std::ssize(both) < kModel.stripes_in_a_row) return {};
  std::array<double, 2> opening;
  for (int j = 0; j < 2; ++j) {
    opening[j] = median(begins[j]);
    if (opening[j] > kModel.widest_cut) return {};
    if (opening[j] <= scales.contact) opening[j] = 0;
  }
  const double deepest =
      std::hypot(opening[0], opening[1]) + std::max(scales.contact, scales.tolerance);
  const auto shows_edges = [&](int k) {
    const auto [first, last] = std::minmax(nearest[0][k].point, nearest[1][k].point);
    int between = 0;
    for (int i = first + 1; i < last; ++i, ++between)
      if (line.distance(cloud.points[i]) > deepest) return false;
    return between >= kModel.sure_points;
  };
  if (2 * std::count_if(both.begin(), both.end(), shows_edges) <= std::ssize(both)) return {};
  return opening;
}

}  // namespace arcstart::seam_finding
