#include "services/seam_finding/ends/parallel_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/ends/plate_end.hpp"
#include "services/seam_finding/visibility/plate_extent.hpp"

namespace arcstart::seam_finding {
namespace {

// Between which stripes a plate ends, counted outward; mm.
struct Enclosed {
  double inner = 0, outer = 0;
};

// From a place within the seam outward.
std::optional<Enclosed> enclose(const Stations& stations, int plate, double within,
                                double outward) {
  std::vector<std::pair<double, bool>> places;  // and whether the plate is there
  for (const Station& station : stations.list)
    if (station.known && outward * (station.along - within) >= 0)
      places.emplace_back(outward * station.along, station.nearest[plate] <= stations.near[plate]);
  std::sort(places.begin(), places.end());
  Enclosed enclosed{outward * within, outward * within};
  bool shown = false;
  // A plate goes on behind a short interruption, and behind a single stripe that does not show it.
  const auto goes_on = [&](std::size_t from) {
    if (from + 1 < places.size() && places[from + 1].second) return true;
    int seen = 0;
    for (std::size_t i = from;
         i < places.size() && places[i].first < places[from].first + kCoverage.bridge; ++i)
      seen += places[i].second;
    return seen >= 2;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].second) {
      enclosed.inner = places[i].first, shown = true;
      continue;
    }
    if (!shown || goes_on(i)) continue;
    enclosed.outer = places[i].first;
    return enclosed;
  }
  return std::nullopt;
}

// The first stripe beyond a place that does not show the plate, counted outward; infinite for none.
double first_without(const Stations& stations, int plate, double beyond, double outward) {
  double first = std::numeric_limits<double>::infinity();
  for (const Station& station : stations.list)
    if (station.known && station.nearest[plate] > stations.near[plate] &&
        outward * station.along > beyond)
      first = std::min(first, outward * station.along);
  return first;
}

// How stripes cross a plate: mm outward along the seam for each mm away from it.
double slant_of(const ScanCloud& cloud, const JointPlate& plate, const Line& border,
                double outward) {
  double squares = 0, products = 0;
  for (std::size_t i = 1; i < plate.points.size(); ++i) {
    const int a = plate.points[i - 1], b = plate.points[i];
    if (b != a + 1 || cloud.origins[a].stripe != cloud.origins[b].stripe) continue;
    const Eigen::Vector3d step = cloud.points[b] - cloud.points[a];
    const double away = plate.away.dot(step);
    squares += away * away, products += away * outward * border.direction.dot(step);
  }
  return squares > 0 ? products / squares : 0;
}

// A plate's end: anywhere between two places, all alike, counted outward; mm.
struct PlateEnd {
  double low, high;
  bool by_edge;

  double share_beyond(double place) const {
    return std::clamp((high - place) / (high - low), 0.0, 1.0);
  }
};

// By what is seen on the plate and past it, counted along its border; `on_seam` counts along the
// seam.
template <class OnSeam>
void narrow(PlateEnd& end, const PlateExtent& extent, OnSeam&& on_seam) {
  const double low = std::isfinite(extent.on) ? std::max(end.low, on_seam(extent.on)) : end.low;
  const double high =
      std::isfinite(extent.past) ? std::min(end.high, on_seam(extent.past)) : end.high;
  if (low < high) end.low = low, end.high = high;
}

// Of two plates the one that ends first, counted from within.
void first_of(const PlateEnd& a, const PlateEnd& b, double& mean, double& variance) {
  const double low = std::min(a.low, b.low), high = std::min(a.high, b.high);
  const double step = (high - low) / kEnds.integral_steps;
  double sum = 0, squares = 0;
  for (int i = 0; i < kEnds.integral_steps; ++i) {
    const double from = low + i * step, middle = from + step / 2;
    const double share = a.share_beyond(from) * b.share_beyond(from) -
                         a.share_beyond(from + step) * b.share_beyond(from + step);
    sum += share * middle, squares += share * middle * middle;
  }
  mean = sum;
  variance = std::max(squares - sum * sum, 0.0);
}

SeamEnd find_parallel_end(const ScanCloud& cloud, const Joint& joint,
                          const std::array<Stations, 2>& stations, SeamSide side,
                          const Scales& scales, const SeamFindingSettings& settings) {
  const bool begin = side == SeamSide::kBegin;
  const double outward = begin ? -1 : 1;
  const Coverage& course = joint.coverage;
  SeamEnd end;
  end.along = begin ? course.begin : course.end;
  end.visibility = EndVisibility::kOutside;
  if (begin ? course.begins_outside : course.ends_outside) return end;

  std::vector<PlateEnd> ends;
  std::vector<PlateEdge> edges;
  for (int j = 0; j < 2; ++j) {
    const auto enclosed = enclose(stations[j], j, (course.begin + course.end) / 2, outward);
    if (!enclosed) continue;  // runs on beyond the scan
    const Line& border = joint.parallel->edges[j];
    // A stripe that leaves the plate shortly before it reaches the border seems to show it there,
    // and one that lies on it shortly beside the border is too short to show it.
    const double slant = slant_of(cloud, joint.plates[j], border, outward);
    PlateEnd plate_end{
        enclosed->inner - std::max(0.0, -slant) * stations[j].near[j],
        enclosed->outer + std::max(0.0, slant) * kEnds.shortest_shown * stations[j].near[j], false};
    const double from =
                     border.along(joint.line.at(outward * plate_end.low)) - outward * kEnds.margin,
                 to =
                     border.along(joint.line.at(outward * plate_end.high)) + outward * kEnds.margin;
    const EdgeWindow window{std::min(from, to), std::max(from, to)};
    const PlateStripes stripes =
        plate_stripes(cloud, joint.plates[j], joint.plates[1 - j], border, scales);
    auto edge = find_edge(cloud, stripes, side, window, scales, settings);
    if (edge) {
      edge->along = joint.line.along(border.at(edge->along));
      edge->variance =
          kEnds.parallel_factor * edge->variance + kEnds.parallel_floor * kEnds.parallel_floor;
      const double half = std::sqrt(3 * edge->variance);  // of as wide an even distribution
      plate_end = {outward * edge->along - half, outward * edge->along + half, true};
      edges.push_back(*edge);
    } else {
      const auto on_seam = [&](double place) {
        return outward * joint.line.along(border.at(outward * place));
      };
      const PlateExtent extent =
          plate_extent(cloud, stripes, side, border.along(joint.line.at(end.along)), 0, scales);
      // A stripe may miss the plate beside the border and show it farther off.
      if (std::isfinite(extent.on) && on_seam(extent.on) > plate_end.high) {
        const double next = first_without(stations[j], j, on_seam(extent.on), outward);
        if (std::isfinite(next)) plate_end.high = next;
      }
      narrow(plate_end, extent, on_seam);
    }
    ends.push_back(plate_end);
  }
  if (ends.empty()) return end;
  end.visibility = EndVisibility::kSeen;
  if (edges.size() == 2) {
    const CommonEnd both = end_of_both(edges[0], edges[1], side);
    end.along = both.along;
    end.variance = both.variance;
    end.by_edges = true;
    return end;
  }
  double place = 0;
  first_of(ends.front(), ends.back(), place, end.variance);
  if (ends.size() == 1) {
    place = (ends[0].low + ends[0].high) / 2;
    end.variance = std::pow(ends[0].high - ends[0].low, 2) / 12;
  }
  end.along = outward * place;
  end.by_edges = std::all_of(ends.begin(), ends.end(), [&](const PlateEnd& plate_end) {
    return plate_end.by_edge || plate_end.low > place;
  });
  return end;
}

}  // namespace

std::array<SeamEnd, 2> find_parallel_ends(const ScanCloud& cloud, const Joint& joint,
                                          const Scales& scales,
                                          const SeamFindingSettings& settings) {
  const auto stations = stations_by_edge(cloud, joint, scales);
  return {find_parallel_end(cloud, joint, stations, SeamSide::kBegin, scales, settings),
          find_parallel_end(cloud, joint, stations, SeamSide::kEnd, scales, settings)};
}

}  // namespace arcstart::seam_finding
