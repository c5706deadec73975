#include "services/seam_finding/ends.hpp"

#include <cmath>
#include <optional>

namespace arcstart {
namespace {

constexpr double kSameEdge = 2.5;  // standard deviations of their difference
constexpr double kReach = 0.8;     // of an edge from the end that the stripes give, in spacings
constexpr double kLeastReach = 1;  // mm

}  // namespace

SeamEnd find_end(const ScanCloud& cloud, const std::array<Plate, 2>& plates, const Line& line,
                 const Course& course, SeamSide side, const EndSearch& search) {
  const bool begin = side == SeamSide::kBegin;
  const int missing = begin ? course.missing_before : course.missing_after;
  const double gap = search.spacing * (1 + missing);
  SeamEnd end;
  end.along = begin ? course.begin : course.end;
  end.variance = gap * gap / 12;
  end.visibility = EndVisibility::kSeen;
  if (begin ? course.begins_outside : course.ends_outside) end.visibility = EndVisibility::kOutside;
  if (end.visibility == EndVisibility::kOutside) return end;

  EdgeSearch edge_search;
  edge_search.expected = end.along;
  edge_search.reach = kLeastReach + kReach * gap;
  edge_search.tolerance = search.tolerance;
  edge_search.shortening_px = search.shortening_px;
  std::array<std::optional<PlateEdge>, 2> edges;
  for (int j = 0; j < 2; ++j)
    edges[j] = find_edge(cloud, plates[j], plates[1 - j], line, side, edge_search);
  if (!edges[0] && !edges[1]) return end;

  end.by_edges = true;
  PlateEdge edge = edges[0] ? *edges[0] : *edges[1];
  if (edges[0] && edges[1]) {
    const PlateEdge &a = *edges[0], &b = *edges[1];
    const double difference = a.along - b.along, variance = a.variance + b.variance;
    if (difference * difference <= kSameEdge * kSameEdge * variance && a.occluded == b.occluded) {
      edge.along = (a.along * b.variance + b.along * a.variance) / variance;
      edge.variance = a.variance * b.variance / variance;
    } else {
      edge = (a.along > b.along) == begin ? a : b;
    }
  }
  end.along = edge.along;
  end.variance = edge.variance;
  if (edge.occluded) end.visibility = EndVisibility::kHidden;
  return end;
}

}  // namespace arcstart
