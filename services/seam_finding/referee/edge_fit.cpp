#include "services/seam_finding/referee/edge_fit.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kSame = 1e-6;  // sums of weights that differ less are the same
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// The foot that an edge of some slope would have at each mark.
double outermost(const std::vector<EdgeMark>& marks, double slope) {
  double foot = -kInfinite;
  for (const EdgeMark& mark : marks) foot = std::max(foot, mark.out - slope * mark.away);
  return foot;
}
double innermost(const std::vector<EdgeMark>& marks, double slope) {
  double foot = kInfinite;
  for (const EdgeMark& mark : marks) foot = std::min(foot, mark.out - slope * mark.away);
  return foot;
}

// All stripes' together, on the edge's two sides: enough for an edge that none contradicts.
struct Marks {
  std::vector<EdgeMark> inside, outside;
  std::vector<std::size_t> parted;  // where in `outside` each stripe's end
};
Marks marks_of(const std::vector<EdgeEvidence>& all) {
  Marks marks;
  const auto append = [](const std::vector<EdgeMark>& more, std::vector<EdgeMark>& to) {
    to.insert(to.end(), more.begin(), more.end());
  };
  for (const EdgeEvidence& evidence : all) {
    append(evidence.on, marks.inside);
    append(evidence.off, marks.outside);
    append(evidence.dark, marks.outside);
    marks.parted.push_back(marks.outside.size());
  }
  return marks;
}

// Of one slope, where no stripe contradicts an edge; empty where some do.
EdgeFoot foot_of(const Marks& marks, double slope, double play) {
  EdgeFoot foot;
  foot.least = outermost(marks.inside, slope) - play;
  std::size_t i = 0;
  for (const std::size_t behind : marks.parted) {
    double most = kInfinite;
    for (; i < behind; ++i)
      most = std::min(most, marks.outside[i].out - slope * marks.outside[i].away);
    foot.most_but_one = std::min(foot.most_but_one, std::max(most + play, foot.most));
    foot.most = std::min(foot.most, most + play);
  }
  return foot;
}

// Where a straight edge of one slope may meet the seam so that as few stripes as possible
// contradict it.
struct Limit {
  double at;
  bool least;
  double weight;
};
void set_limits(const std::vector<EdgeEvidence>& all, double slope, double play,
                std::vector<Limit>& limits) {
  limits.clear();
  for (const EdgeEvidence& evidence : all) {
    const double least = outermost(evidence.on, slope), most = innermost(evidence.off, slope),
                 dark = innermost(evidence.dark, slope);
    if (std::isfinite(least)) limits.push_back({least - play, true, 1});
    if (std::isfinite(most)) limits.push_back({most + play, false, 1});
    if (std::isfinite(dark)) limits.push_back({dark + play, false, kReferee.dark_weight});
  }
}
double narrow(std::vector<Limit>& limits, EdgeFoot& result) {
  std::sort(limits.begin(), limits.end(), [](const Limit& a, const Limit& b) {
    return a.at != b.at ? a.at < b.at : a.least > b.least;
  });
  double wrong = 0;  // at minus infinity
  for (const Limit& limit : limits) wrong += limit.least ? limit.weight : 0;
  double best = wrong;
  result = {-kInfinite, limits.empty() ? kInfinite : limits.front().at};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    wrong += limits[i].least ? -limits[i].weight : limits[i].weight;
    const double next = i + 1 < limits.size() ? limits[i + 1].at : kInfinite;
    if (wrong < best - kSame)
      best = wrong, result = {limits[i].at, next};
    else if (wrong < best + kSame)
      result.most = std::max(result.most, next);
  }
  for (const Limit& limit : limits)
    if (!limit.least && limit.at > result.most) {
      result.most_but_one = limit.at;
      break;
    }
  return best;
}

}  // namespace

// The slopes from square to steepest, to both sides by turns: a square edge is found first, and
// then slopes that contradict stripes need not be looked at.
EdgeFit fit_edge(const std::vector<EdgeEvidence>& all, double play) {
  EdgeFit fit;
  for (const EdgeEvidence& evidence : all) fit.crossings += evidence.crosses();
  fit.contradicting = kInfinite;
  const Marks marks = marks_of(all);
  std::vector<Limit> limits;
  const int steps = static_cast<int>(std::lround(kModel.steepest_edge / kReferee.steepness_step));
  for (int i = 0; i <= 2 * steps; ++i) {
    const double slope = (i % 2 == 0 ? i / 2 : -(i + 1) / 2) * kReferee.steepness_step;
    EdgeFoot foot = foot_of(marks, slope, play);
    double contradicting = 0;
    if (foot.least > foot.most) {
      if (fit.contradicting < kSame) continue;
      set_limits(all, slope, play, limits);
      contradicting = narrow(limits, foot);
    }
    if (contradicting < fit.contradicting - kSame) {
      fit.contradicting = contradicting;
      fit.foot = foot;
    } else if (contradicting < fit.contradicting + kSame) {
      fit.foot.least = std::min(fit.foot.least, foot.least);
      fit.foot.most = std::max(fit.foot.most, foot.most);
      fit.foot.most_but_one = std::max(fit.foot.most_but_one, foot.most_but_one);
    }
  }
  return fit;
}

EdgeFit fit_waved_edge(const std::vector<EdgeEvidence>& all) {
  EdgeFit fit = fit_edge(all, kReferee.place);
  for (double play = 2 * kReferee.place; fit.contradicting > 1 && play <= kReferee.largest_wave;
       play *= 2) {
    EdgeFit waved = fit_edge(all, play);
    if (waved.contradicting > fit.contradicting - kSame) continue;
    waved.foot.least -= play, waved.foot.most += play,
        waved.foot.most_but_one += play;  // it may have a wave right at the seam
    fit = waved;
  }
  return fit;
}

}  // namespace arcstart::seam_finding
