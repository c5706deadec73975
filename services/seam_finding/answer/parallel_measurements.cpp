#include "services/seam_finding/answer/parallel_measurements.hpp"

#include <cmath>

namespace arcstart::seam_finding {
namespace {

constexpr double kTackReach = 6;   // a bead lies so near the seam; mm
constexpr double kTackHeight = 1;  // and stands so far before both plates; mm
constexpr int kTackPoints = 2;

}  // namespace

std::vector<SurveyPlace> survey_flat(const ScanCloud& cloud, const Joint& joint,
                                     const Stations& stations, double begin, double end,
                                     double spacing_mm) {
  std::vector<SurveyPlace> places;
  for (const Station& station : stations.list) {
    if (!station.known || station.along < begin || station.along > end) continue;
    SurveyPlace place;
    place.along = station.along;
    place.stripe = station.stripe;
    place.position = joint.line.at(place.along);
    for (const FlatSeam::Gap& gap : joint.flat->gaps)
      if (std::abs(gap.along - place.along) < spacing_mm / 2)
        place.gap = gap.width, place.gap_deviation = joint.flat->gap_deviation;
    places.push_back(place);
  }
  std::vector<int> bead(places.size());
  for (const Eigen::Vector3d& point : cloud.points) {
    if (joint.line.distance(point) > kTackReach ||
        joint.plates[0].plane.signed_distance(point) < kTackHeight ||
        joint.plates[1].plane.signed_distance(point) < kTackHeight)
      continue;
    for (std::size_t i = 0; i < places.size(); ++i)
      bead[i] += std::abs(joint.line.along(point) - places[i].along) < spacing_mm / 2;
  }
  for (std::size_t i = 0; i < places.size(); ++i) places[i].tack = bead[i] >= kTackPoints;
  return places;
}

}  // namespace arcstart::seam_finding
