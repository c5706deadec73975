#include "services/seam_finding/referee/edge_line.hpp"

#include <cmath>
#include <utility>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

struct Line {
  double foot = 0, slope = 0;
  double off(const EdgeMark& mark) const { return mark.out - foot - slope * mark.away; }
};

std::vector<EdgeMark> most_on_a_line(const std::vector<EdgeMark>& marks) {
  std::vector<EdgeMark> most;
  const auto look = [&](const Line& line) {
    std::vector<EdgeMark> on;
    for (const EdgeMark& mark : marks)
      if (std::abs(line.off(mark)) < kReferee.place) on.push_back(mark);
    if (on.size() > most.size()) most = std::move(on);
  };
  for (const EdgeMark& mark : marks) look({mark.out, 0});
  for (std::size_t i = 0; i < marks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double slope = (marks[i].out - marks[j].out) / (marks[i].away - marks[j].away);
      if (std::abs(slope) <= kModel.steepest_edge)
        look({marks[i].out - slope * marks[i].away, slope});
    }
  return most;
}

}  // namespace

std::optional<EdgeLine> line_through(const std::vector<EdgeMark>& crossings) {
  const std::vector<EdgeMark> marks = most_on_a_line(crossings);
  const double n = static_cast<double>(marks.size());
  if (n < 2 || n < kReferee.shown_share * static_cast<double>(crossings.size()))
    return std::nullopt;
  double away = 0, out = 0, spread = 0, common = 0;
  for (const EdgeMark& mark : marks) away += mark.away / n, out += mark.out / n;
  for (const EdgeMark& mark : marks) {
    spread += (mark.away - away) * (mark.away - away);
    common += (mark.away - away) * (mark.out - out);
  }
  // What a place is off by, at most, is as many of its deviations as an outlier; so it is here with
  // the deviation of a slope.
  const double slope = spread > 0 ? common / spread : 0;
  if (std::abs(slope) * std::sqrt(spread) < kReferee.place)
    return EdgeLine{out, kReferee.place / (kFit.outlier * std::sqrt(n))};
  // Few places of a rough edge look like a slanting one: each may be off by the most.
  return EdgeLine{out - slope * away, kReferee.place * std::sqrt(1 / n + away * away / spread)};
}

}  // namespace arcstart::seam_finding
