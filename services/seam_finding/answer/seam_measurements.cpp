#include "services/seam_finding/answer/seam_measurements.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "services/seam_finding/answer/constants.hpp"
#include "services/seam_finding/gaps/root_gap.hpp"

namespace arcstart::seam_finding {
namespace {

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
    if (height >= kAnswer.tack_height && other.signed_distance(p) >= kAnswer.tack_height &&
        line.distance(p) <= kAnswer.tack_reach)
      visit(i, line.along(p));
  }
}

// Where neighbours differ by as much as all differ from the line, each stripe errs by itself: the
// work shakes, or the tool does. Then the line, by all of them, is where the seam runs.
void put_on_line_if_shaken(const Line& line, std::vector<SeamMeasurement>& places) {
  double off = 0, change = 0, count = 0, changes = 0;
  const SeamMeasurement* last = nullptr;
  for (const SeamMeasurement& place : places) {
    if (place.residual < 0) continue;
    off += place.residual * place.residual, ++count;
    if (last != nullptr) {
      const Eigen::Vector3d step =
          place.position - line.at(place.along) - (last->position - line.at(last->along));
      change += step.squaredNorm() / 2, ++changes;
    }
    last = &place;
  }
  // Of independent errors both mean squares are alike; of a course that both show, half is noise.
  if (changes == 0 || off / count > 2 * change / changes) return;
  for (SeamMeasurement& place : places) place.position = line.at(place.along);
}

// Where the stripes' heights over the two planes put the seam.
std::vector<SeamMeasurement> places_by_heights(const ScanCloud& cloud, const Joint& joint,
                                               double begin, double end, double spacing_mm) {
  const std::array<JointPlate, 2>& plates = joint.plates;
  const Line& line = joint.line;
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
      if (squared < kAnswer.straight_from * kAnswer.straight_from ||
          squared > kModel.beside_seam * kModel.beside_seam || cloud.origins[i].segment_end)
        continue;
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
  std::vector<SeamMeasurement> places;
  for (const auto& [stripe, seen] : by_stripe) {
    SeamMeasurement place;
    place.along = seen.place();
    if (cloud.organised()) place.stripe = stripe;
    place.position = line.at(place.along);
    place.tack = seen.bead >= kModel.sure_off_plate;
    if (seen.count[0] >= kModel.sure_points && seen.count[1] >= kModel.sure_points) {
      const Eigen::Vector3d off = inverse * Eigen::Vector3d(seen.height[0] / seen.count[0],
                                                            seen.height[1] / seen.count[1], 0);
      place.residual = off.norm();
      place.position += off;
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end(),
            [](const SeamMeasurement& a, const SeamMeasurement& b) { return a.along < b.along; });
  put_on_line_if_shaken(line, places);
  return places;
}

// A place for every station of the coverage.
std::vector<SeamMeasurement> places_by_stations(const ScanCloud& cloud, const Joint& joint,
                                                double begin, double end, double spacing_mm) {
  std::vector<SeamMeasurement> places;
  for (const Station& station : joint.coverage.stations.list) {
    if (!station.known || station.along < begin || station.along > end) continue;
    SeamMeasurement place;
    place.along = station.along;
    place.stripe = station.stripe;
    place.position = joint.line.at(place.along);
    for (const ParallelSeam::Gap& gap : joint.parallel->gaps)
      if (std::abs(gap.along - place.along) < spacing_mm / 2)
        place.gap = gap.width, place.gap_deviation = joint.parallel->gap_deviation;
    places.push_back(place);
  }
  std::vector<int> bead(places.size());
  for (const Eigen::Vector3d& point : cloud.points) {
    if (joint.line.distance(point) > kAnswer.tack_reach ||
        joint.plates[0].plane.signed_distance(point) < kAnswer.tack_height ||
        joint.plates[1].plane.signed_distance(point) < kAnswer.tack_height)
      continue;
    for (std::size_t i = 0; i < places.size(); ++i)
      bead[i] += std::abs(joint.line.along(point) - places[i].along) < spacing_mm / 2;
  }
  for (std::size_t i = 0; i < places.size(); ++i) places[i].tack = bead[i] >= kModel.sure_off_plate;
  return places;
}

// Of a tee, an inside corner and a lap; those of butt joints and grooves come with their stations.
std::vector<SeamMeasurement> with_root_gaps(const ScanCloud& scan, const Joint& joint,
                                            std::vector<SeamMeasurement> stations) {
  std::array<JointPlate, 2> plates = joint.plates;
  int standing = -1;
  if (joint.type == JointType::kLap) {
    // The upper plate's cut, square to the lower plate.
    const JointPlate& lower = plates[joint.parallel->lower];
    standing = 1 - joint.parallel->lower;
    plates[standing] = JointPlate{};
    plates[standing].plane = {lower.away, -lower.away.dot(joint.line.point)};
  } else if (joint.type != JointType::kTee && joint.type != JointType::kCorner) {
    return stations;
  }
  const auto gaps = root_gaps(scan, plates, joint.line, standing);
  for (SeamMeasurement& place : stations)
    if (place.stripe >= 0 && !place.tack && gaps[place.stripe])
      place.gap = gaps[place.stripe]->width, place.gap_deviation = gaps[place.stripe]->deviation;
  return stations;
}

}  // namespace

std::vector<SeamMeasurement> measure_seam(const ScanCloud& cloud, const Joint& joint, double begin,
                                          double end, double spacing_mm) {
  const auto places = joint.parallel ? places_by_stations : places_by_heights;
  return with_root_gaps(cloud, joint, places(cloud, joint, begin, end, spacing_mm));
}

Polyline polyline_through(const std::vector<SeamMeasurement>& places, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& end, double straight_mm) {
  Polyline polyline;
  polyline.points = {start, end};
  std::vector<Eigen::Vector3d> measured;
  for (const SeamMeasurement& place : places)
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
