#include "services/seam_finding/joints/parallel_joint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "common/order_statistics.hpp"
#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/parallel_joint_type.hpp"
#include "services/seam_finding/planes/robust_plane.hpp"

namespace arcstart::seam_finding {
namespace {

// The first and the last of the sections that the transitions lie in.
std::pair<int, int> sections_of(const std::vector<Transition>& transitions) {
  const auto [first, last] = std::minmax_element(
      transitions.begin(), transitions.end(),
      [](const Transition& a, const Transition& b) { return a.section < b.section; });
  return {first->section, last->section};
}

// Where one face holds two plates at unlike heights, a plate that goes on behind the other's end
// lies on the other's side, too: there it is not the other plate.
void keep_own_height(const ScanCloud& cloud, double near_mm, std::array<JointPlate, 2>& plates) {
  for (int j = 0; j < 2; ++j)
    std::erase_if(plates[j].points, [&](int i) {
      return std::abs(plates[j].plane.signed_distance(cloud.points[i])) >
             std::abs(plates[1 - j].plane.signed_distance(cloud.points[i])) + 2 * near_mm;
    });
}

// A plate's points on its own side of its border, and the plane through those near it.
JointPlate plate_of(const ScanCloud& cloud, const TransitionLine& candidate, const Face& face,
                    int plate, const LineFit& border, const Scales& scales) {
  const double outward = plate == 0 ? -1 : 1;
  JointPlate result;
  result.contact = scales.contact;
  result.away = outward * candidate.frame.across;
  std::vector<int> flat;
  const auto [first, last] = sections_of(candidate.transitions);
  for (const int i : face.points) {
    const Eigen::Vector3d p = candidate.frame.of(cloud.points[i]);
    const double away = outward * (p.y() - border.across_at(p.x()));
    if (away < 0) continue;
    result.points.push_back(i);
    // Beyond the seam's ends another plate may lie on this side.
    const int stripe = cloud.origins[i].stripe;
    if (candidate.by_runs && (stripe < first || stripe > last)) continue;
    if (away < kPlanes.fit_reach && !cloud.origins[i].segment_end) flat.push_back(i);
  }
  // A stripe's turn at either edge is rounded: there it lies off the plane.
  const Line along{candidate.frame.origin + border.across_at(0) * candidate.frame.across,
                   (candidate.frame.along + border.slope * candidate.frame.across).normalized()};
  result.plane = robust_plane(cloud, flat, along, face.plane, scales.noise);
  result.points = without_fragments(cloud, result.points);
  return result;
}

// Whether the transitions lie on the line itself. Those that noise makes within one face are spread
// over the band about it in which they are sought: half of them farther off than half of its half
// width.
bool on_the_line(const TransitionLine& candidate, const std::vector<LinePlace>& places,
                 const LineFit& line) {
  if (candidate.faces[0] != candidate.faces[1]) return true;
  std::vector<double> off;
  for (const LinePlace& place : places)
    off.push_back(std::abs(place.across - line.across_at(place.along)));
  return median(off) < kJoints.on_line / 4;  // by the best of many lines: half of that half
}

void judge(const ScanCloud& cloud, const TransitionLine& candidate, bool straight,
           const Scales& scales, const SeamFindingSettings& settings, Joint& joint) {
  joint.coverage = find_coverage(stations_of_both(stations_by_edge(cloud, joint, scales)), scales);
  const std::array<Line, 2>& edges = joint.parallel->edges;
  const double reach = std::min(reach_of(cloud, joint.plates[0], edges[0]),
                                reach_of(cloud, joint.plates[1], edges[1]));
  const double share = std::min(1.0, candidate.share);
  joint.score = joint.coverage.covered * share * share * std::min(1.0, reach / kJoints.full_reach) *
                (joint.parallel->root_hidden ? kJoints.hidden_root : 1);
  if (joint.flaw) return;
  using Code = Reason::Code;
  if (angle_between(joint.plates[0].plane.normal, joint.plates[1].plane.normal) >
      settings.parallel_tolerance_deg * kDegree)
    joint.flaw = {Code::kNotParallel};
  else if (share < kJoints.through)
    joint.flaw = {Code::kFewStripesShow, share};
  else if (!straight || joint.parallel->seam.variance > kJoints.unsteady * kJoints.unsteady)
    joint.flaw = {Code::kEdgesNotStraight};
  else if (reach < kJoints.least_reach)
    joint.flaw = {Code::kPlateNarrow};
  else if (joint.coverage.stripes < settings.stripes_min)
    joint.flaw = {Code::kFewStripesCross, static_cast<double>(joint.coverage.stripes)};
  else if (joint.coverage.covered < kJoints.shortest_doubtful)
    joint.flaw = {Code::kShortlySeen, joint.coverage.covered};
}

// Whether a stripe goes straight on across the gap, at the plates' level.
class GoesStraightOn {
 public:
  GoesStraightOn(const ScanCloud& cloud, const Joint& joint, const Scales& scales)
      : cloud_(cloud),
        joint_(joint),
        tolerance_(scales.tolerance),
        rough_(2 * near_plate(scales)) {}

  // By what lies between the plates; or, where the gap is so wide that stripes show it, by the
  // piece that reaches from one side of it to the other.
  bool operator()(const ScanStripe& stripe) const {
    std::vector<int> between;
    int from = -1, side = 0;  // the last point beside the gap, and on which plate's side it lies
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
      const auto [past_first, before_second] = to_borders(cloud_.points[i]);
      if (std::min(past_first, before_second) >= kJoints.off_border) between.push_back(i);
      const int now = past_first < 0 ? -1 : before_second < 0 ? 1 : 0;
      if (now == 0) continue;
      if (from >= 0 && now != side && past_first + before_second > 2 * kJoints.off_border &&
          cloud_.origins[from].segment == cloud_.origins[i].segment && is_flat(from, i))
        return true;
      from = i, side = now;
    }
    return std::ssize(between) >= kModel.sure_points && is_flat(between);
  }

 private:
  // From the first plate's border and to the second's; mm. Their sum is the gap's width.
  std::pair<double, double> to_borders(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d& across = joint_.plates[1].away;
    const std::array<Line, 2>& edges = joint_.parallel->edges;
    return {across.dot(p - edges[0].at(edges[0].along(p))),
            across.dot(edges[1].at(edges[1].along(p)) - p)};
  }
  bool is_flat(int from, int to) const {
    std::vector<int> points(static_cast<std::size_t>(to - from + 1));
    std::iota(points.begin(), points.end(), from);
    return is_flat(points);
  }
  // A bead between the plates is not as flat.
  bool is_flat(const std::vector<int>& points) const {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const int i : points) {
      const auto [past_first, before_second] = to_borders(cloud_.points[i]);
      const JointPlate& nearer = joint_.plates[past_first > before_second ? 1 : 0];
      const double height = nearer.plane.signed_distance(cloud_.points[i]);
      least = std::min(least, height), most = std::max(most, height);
    }
    return least > -tolerance_ && most < tolerance_ && most - least < rough_;
  }

  const ScanCloud& cloud_;
  const Joint& joint_;
  double tolerance_, rough_;
};

// Beyond the stripes that show the seam those that go straight on across its gap run over what lies
// flush there, as a run-off tab: what they show is neither plate. Where those that are to show the
// seam do so as well, the points are too few to tell.
void leave_out_what_runs_across(const ScanCloud& cloud, const TransitionLine& candidate,
                                const Scales& scales, Joint& joint) {
  if (!cloud.organised() || joint.type == JointType::kLap) return;
  const GoesStraightOn goes_straight_on(cloud, joint, scales);
  const auto runs_across = [&](int stripe) { return goes_straight_on(cloud.stripes[stripe]); };
  std::vector<int> told;
  for (const Transition& transition : candidate.transitions)
    if (const int stripe = cloud.origins[transition.last].stripe; !runs_across(stripe))
      told.push_back(stripe);
  if (told.empty() || static_cast<double>(told.size()) <
                          kJoints.through * static_cast<double>(candidate.transitions.size()))
    return;
  const auto [first, last] = std::minmax_element(told.begin(), told.end());
  std::vector<bool> across(cloud.stripes.size());
  for (int k = 0; k < std::ssize(cloud.stripes); ++k)
    across[k] = (k < *first || k > *last) && runs_across(k);
  for (JointPlate& plate : joint.plates)
    std::erase_if(plate.points, [&](int i) { return across[cloud.origins[i].stripe]; });
}

// In the middle of the scan's way a plate that a stripe leaves is there for the width alone.
void measure_gaps(const ScanCloud& cloud, const TransitionLine& candidate, Joint& joint) {
  ParallelSeam& flat = *joint.parallel;
  if (joint.type == JointType::kLap) return;
  const Eigen::Vector3d across = (joint.line.direction.cross(candidate.frame.normal)).normalized();
  const double width = std::abs(across.dot(flat.edges[1].point - flat.edges[0].point));
  const auto width_at = [&](double along) {
    const Eigen::Vector3d place = candidate.frame.origin + along * candidate.frame.along;
    const std::array<Line, 2>& edges = flat.edges;
    return std::abs(
        across.dot(edges[1].at(edges[1].along(place)) - edges[0].at(edges[0].along(place))));
  };
  double steps = 0;  // across, between a thinned-out stripe's points at the gap
  int downsampled = 0;
  for (const Transition& transition : candidate.transitions) {
    const Eigen::Vector3d &a = cloud.points[transition.last], &b = cloud.points[transition.first];
    double seen = std::abs(across.dot(b - a));
    if (!cloud.origins[transition.last].segment_end ||
        !cloud.origins[transition.first].segment_end) {
      steps += seen / static_cast<double>(transition.between.size() + 1);
      ++downsampled;
      seen = width;  // such a stripe tells no more than the lines through all of them
    }
    // What is dark there beside the gap is something's shadow.
    const double along = candidate.frame.of((a + b) / 2).x();
    if (transition.covered || seen > width_at(along) + kJoints.on_line) continue;
    flat.gaps.push_back({joint.line.along((a + b) / 2), seen});
  }
  if (flat.narrow) return;
  // Narrow gaps show where a point happens to lie in them: their stripes err alike.
  const double step = downsampled > 0 ? steps / downsampled : 0;
  flat.gap_deviation = std::sqrt(2.0) * std::hypot(kJoints.end_deviation, step / std::sqrt(12.0));
}

}  // namespace

std::optional<Joint> joint_at(const ScanCloud& cloud, const std::vector<Face>& faces,
                              const TransitionLine& candidate, const Scales& scales,
                              const SeamFindingSettings& settings) {
  std::vector<LinePlace> places;
  for (const Transition& transition : candidate.transitions) {
    if (transition.covered) continue;
    const Eigen::Vector3d p = place_of(cloud, candidate.frame, transition);
    places.push_back({p.x(), p.y(), 0, 1});
  }
  if (static_cast<int>(places.size()) < settings.stripes_min) return std::nullopt;
  const auto rough = fit_line(places, 1);
  if (!rough) return std::nullopt;
  Joint joint;
  joint.faces = candidate.faces;
  for (int j = 0; j < 2; ++j)
    joint.plates[j] = plate_of(cloud, candidate, faces[candidate.faces[j]], j, *rough, scales);
  if (joint.faces[0] == joint.faces[1]) keep_own_height(cloud, near_plate(scales), joint.plates);
  if (joint.plates[0].points.empty() || joint.plates[1].points.empty()) return std::nullopt;
  if (!set_type(cloud, candidate, scales, settings, joint)) return std::nullopt;
  for (int j = 0; j < 2; ++j)
    joint.plates[j].away =
        (j == 0 ? -1 : 1) * candidate.frame.normal.cross(joint.line.direction).normalized();
  leave_out_what_runs_across(cloud, candidate, scales, joint);
  if (joint.plates[0].points.empty() || joint.plates[1].points.empty()) return std::nullopt;
  judge(cloud, candidate, on_the_line(candidate, places, *rough), scales, settings, joint);
  if (!joint.flaw) measure_gaps(cloud, candidate, joint);
  return joint;
}

}  // namespace arcstart::seam_finding
