#include "services/seam_finding/answer/seam_measurements.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

namespace arcstart::seam_finding {
namespace {

constexpr double kFrom = 4,
                 kTo = 20;  // from the seam: where a plate is straight again, and local; mm
constexpr int kLeastPoints = 3;
constexpr double kTackReach = 8;   // a bead lies so near the seam; mm
constexpr double kTackHeight = 1;  // and stands so far before both plates; mm

struct Seen {
  double height[2] = {0, 0};
  double along = 0;
  int count[2] = {0, 0};
  int bead = 0;

  double place() const { return along / std::max(1, count[0] + count[1]); }
};

// Visits each of the points from `first` to `last` that is metal standing before both plates at the
// seam, with its place along it.
template <class Visit>
void for_each_on_bead(const ScanCloud& cloud, int first, int last,
                      const std::array<JointPlate, 2>& plates, const Line& line, Visit visit) {
  const Plane one = plates[0].plane, other = plates[1].plane;
  for (int i = first; i < last; ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    // Component by component: most of a scan's points end here.
    const double height =
        one.normal.x() * p.x() + one.normal.y() * p.y() + one.normal.z() * p.z() + one.offset;
    if (height >= kTackHeight && other.signed_distance(p) >= kTackHeight &&
        line.distance(p) <= kTackReach)
      visit(i, line.along(p));
  }
}

}  // namespace

std::vector<SurveyPlace> survey_seam(const ScanCloud& cloud,
                                     const std::array<JointPlate, 2>& plates, const Line& line,
                                     double begin, double end, double spacing_mm) {
  std::map<int, Seen> by_stripe;
  const auto key = [&](int i, double along) {
    return cloud.organised() ? cloud.origins[i].stripe
                             : static_cast<int>(std::floor((along - begin) / spacing_mm));
  };
  Seen* last = nullptr;  // points of a stripe follow each other
  int last_place = 0;
  for (int j = 0; j < 2; ++j)
    for (const int i : plates[j].points) {
      const Eigen::Vector3d p = cloud.points[i] - line.point;
      const double along = line.direction.dot(p), squared = p.squaredNorm() - along * along;
      if (squared < kFrom * kFrom || squared > kTo * kTo || cloud.origins[i].segment_end) continue;
      const int place = key(i, along);
      if (last == nullptr || place != last_place) last = &by_stripe[place], last_place = place;
      Seen& seen = *last;
      seen.height[j] += plates[j].plane.signed_distance(cloud.points[i]);
      seen.along += along;
      ++seen.count[j];
    }
  std::erase_if(by_stripe, [&](const auto& one) {
    return one.second.place() < begin || one.second.place() > end;
  });
  const auto count_bead = [&](int i, double along) {
    if (along < begin || along > end) return;
    const auto found = by_stripe.find(key(i, along));
    if (found != by_stripe.end()) ++found->second.bead;
  };
  if (cloud.organised()) {
    for (const auto& [k, seen] : by_stripe) {
      const ScanStripe& stripe = cloud.stripes[k];
      for_each_on_bead(cloud, stripe.first, stripe.first + stripe.count, plates, line, count_bead);
    }
  } else {
    for_each_on_bead(cloud, 0, cloud.size(), plates, line, count_bead);
  }

  // A point in front of the planes by two heights, seen along the seam.
  Eigen::Matrix3d rows;
  rows << plates[0].plane.normal.transpose(), plates[1].plane.normal.transpose(),
      line.direction.transpose();
  const Eigen::Matrix3d inverse = rows.inverse();
  std::vector<SurveyPlace> places;
  for (const auto& [stripe, seen] : by_stripe) {
    SurveyPlace place;
    place.along = seen.place();
    if (cloud.organised()) place.stripe = stripe;
    place.position = line.at(place.along);
    place.tack = seen.bead >= 2;
    if (seen.count[0] >= kLeastPoints && seen.count[1] >= kLeastPoints) {
      const Eigen::Vector3d off = inverse * Eigen::Vector3d(seen.height[0] / seen.count[0],
                                                            seen.height[1] / seen.count[1], 0);
      place.residual = off.norm();
      place.position += off;
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end(),
            [](const SurveyPlace& a, const SurveyPlace& b) { return a.along < b.along; });
  return places;
}

Polyline polyline_through(const std::vector<SurveyPlace>& places, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& end, double straight_mm) {
  Polyline polyline;
  polyline.points = {start, end};
  std::vector<Eigen::Vector3d> measured;
  for (const SurveyPlace& place : places)
    if (place.residual >= 0) measured.push_back(place.position);
  if (measured.size() < 3) return polyline;
  const Line line{start, (end - start).normalized()};
  std::vector<Eigen::Vector3d> smooth;
  for (std::size_t i = 1; i + 1 < measured.size(); ++i) {
    smooth.push_back((measured[i - 1] + measured[i] + measured[i + 1]) / 3);
    polyline.deviation = std::max(polyline.deviation, line.distance(smooth.back()));
  }
  if (polyline.deviation <= straight_mm) return polyline;
  polyline.points.insert(polyline.points.begin() + 1, smooth.begin(), smooth.end());
  polyline.deviation = 0;
  for (std::size_t i = 1; i + 1 < measured.size(); ++i)
    polyline.deviation = std::max(polyline.deviation, (measured[i] - smooth[i - 1]).norm());
  return polyline;
}

}  // namespace arcstart::seam_finding
