#include "services/seam_finding/joints/parallel_joint_type.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/order_statistics.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/edges/lap_root.hpp"
#include "services/seam_finding/joints/parallel_edges.hpp"

namespace arcstart::seam_finding {
namespace {

bool is_wanted(JointType type, const SeamFindingSettings& settings) {
  const auto wanted = wanted_types(settings.joint_type);
  return std::find(wanted.begin(), wanted.end(), type) != wanted.end();
}

// A border as a line on a plane.
Line on_plane(const PlateFrame& frame, const LineFit& border, const Plane& plane) {
  const auto at = [&](double along) -> Eigen::Vector3d {
    const Eigen::Vector3d p =
        frame.origin + along * frame.along + border.across_at(along) * frame.across;
    return p - plane.signed_distance(p) / plane.normal.dot(frame.normal) * frame.normal;
  };
  const Eigen::Vector3d from = at(border.middle - 50), to = at(border.middle + 50);
  return {at(border.middle), (to - from).normalized()};
}

LineFit middle_of(const LineFit& a, const LineFit& b) {
  LineFit fit;
  fit.middle = (a.middle + b.middle) / 2;
  fit.at_middle = (a.across_at(fit.middle) + b.across_at(fit.middle)) / 2;
  fit.slope = (a.slope + b.slope) / 2;
  fit.variance = (a.variance_at(fit.middle) + b.variance_at(fit.middle)) / 4;
  fit.slope_variance = (a.slope_variance + b.slope_variance) / 4;
  fit.places = std::min(a.places, b.places);
  return fit;
}

// The plates' edges make a lap: the upper one's lower edge on the lower one. False where there is
// no straight edge.
bool set_lap(const ScanCloud& cloud, const TransitionLine& candidate,
             const std::vector<Transition>& showing, const ParallelEdges& edges,
             const Scales& scales, const SeamFindingSettings& settings, double step, double width,
             Joint& joint) {
  const PlateFrame& frame = candidate.frame;
  const std::array<Plane, 2> planes = {joint.plates[0].plane, joint.plates[1].plane};
  const double pitch = scales.contact / 2;
  ParallelSeam& seam = *joint.parallel;
  const int upper = step > 0 ? 1 : 0, lower = 1 - upper;
  joint.type = JointType::kLap;
  joint.angle = M_PI;
  seam.step = std::abs(step);
  seam.lower = lower;
  const auto root =
      lap_root(cloud, showing, frame, planes, upper, seam.step, near_plate(scales), pitch);
  if (!root) return false;
  seam.seam = root->fit;
  // A thin sheet's cut may show no point though it faces the camera.
  seam.root_hidden =
      !root->seen && (root->faces_away || seam.step >= settings.lap_thickness_min_mm);
  seam.edges[upper] = on_plane(frame, root->fit, planes[upper]);
  seam.edges[lower] = on_plane(frame, edges.plates[lower].value(), planes[lower]);
  joint.line = on_plane(frame, root->fit, planes[lower]);
  using Code = Reason::Code;
  if (!is_wanted(JointType::kLap, settings))
    joint.flaw = {Code::kLapNotWanted};
  else if (seam.step > settings.lap_thickness_max_mm + kJoints.most_root_gap)
    joint.flaw = {Code::kLapThickness, seam.step};
  else if (width > kJoints.step_shadow * seam.step + 2 * pitch)
    joint.flaw = {Code::kPlatesDoNotTouch};
  else if (reach_of(cloud, joint.plates[upper], seam.edges[upper]) <
           kJoints.wider_than_high * seam.step)
    joint.flaw = {Code::kUpperPlateNarrow};
  return true;
}

// Between the edges at the two ends of what shows them, the smaller first; mm.
std::array<double, 2> widths_of(const PlateFrame& frame, const ScanCloud& cloud,
                                const std::vector<Transition>& showing, const LineFit& first,
                                const LineFit& second) {
  std::array<double, 2> widths{std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};
  for (const Transition& transition : showing) {
    const double along = place_of(cloud, frame, transition).x();
    const double width = second.across_at(along) - first.across_at(along);
    widths = {std::min(widths[0], width), std::max(widths[1], width)};
  }
  return widths;
}

// They make a butt joint or, where their edges slant, a groove: the seam runs in the middle.
void set_butt_or_groove(const TransitionLine& candidate, const ParallelEdges& edges,
                        const SeamFindingSettings& settings, const std::array<double, 2>& widths,
                        Joint& joint) {
  const PlateFrame& frame = candidate.frame;
  const std::array<Plane, 2> planes = {joint.plates[0].plane, joint.plates[1].plane};
  const LineFit &first = *edges.plates[0], &second = *edges.plates[1];
  ParallelSeam& seam = *joint.parallel;
  seam.edges = {on_plane(frame, first, planes[0]), on_plane(frame, second, planes[1])};
  seam.narrow = edges.together;
  seam.gap_deviation =
      std::hypot(kJoints.narrow_deviation, std::sqrt(first.variance + second.variance));
  const Line low = on_plane(frame, seam.seam, planes[0]),
             high = on_plane(frame, seam.seam, planes[1]);
  joint.line = {(low.point + high.point) / 2, (low.direction + high.direction).normalized()};
  for (const auto& slant : edges.slants)
    if (slant) seam.half_angle = std::max(seam.half_angle, *slant);
  const bool groove =
      seam.half_angle > (settings.v_angle_deg - settings.v_angle_tolerance_deg) / 2 * kDegree;
  joint.type = groove ? JointType::kV : JointType::kButt;
  if (edges.slants[0] && edges.slants[1] && groove)
    seam.half_angle = (*edges.slants[0] + *edges.slants[1]) / 2;
  joint.angle = groove ? 2 * seam.half_angle : M_PI;
  const double half_angle_max =
      (settings.v_angle_deg + settings.v_angle_tolerance_deg) / 2 * kDegree;
  // Across it lies one side as deep as it was seen, and no more than that throws shadow on.
  const double widest_groove = std::min(
      settings.v_width_max_mm, (std::tan(seam.half_angle) + kJoints.step_shadow) * edges.depth);
  using Code = Reason::Code;
  if (!is_wanted(joint.type, settings))
    joint.flaw = {groove ? Code::kGrooveNotWanted : Code::kButtNotWanted};
  else if (groove && seam.half_angle > half_angle_max)
    joint.flaw = {Code::kGrooveAngle, 2 * seam.half_angle};
  else if (widths[1] > (groove ? widest_groove : settings.butt_gap_max_mm))
    joint.flaw = {Code::kGapWidth, widths[1]};
  else if (widths[0] < -kJoints.overlap)
    joint.flaw = {Code::kGapWidth, widths[0]};
}

// Between the plates' edges something is seen that lies below both: there the lower one ends, too.
// Some stripes show it beyond doubt, or half of all do: a lap's shadow ends on the lower plate.
bool lower_plate_ends(const ScanCloud& cloud, const TransitionLine& candidate,
                      const std::array<Plane, 2>& planes, double near_mm) {
  const auto& all = candidate.transitions;
  const auto seen = std::count_if(all.begin(), all.end(), [&](const Transition& transition) {
    return sees_below(cloud, transition, planes, near_mm);
  });
  std::vector<double> lowest;
  for (const Transition& transition : all) {
    lowest.push_back(0);
    for (const int i : transition.between)
      lowest.back() = std::min(lowest.back(), std::max(planes[0].signed_distance(cloud.points[i]),
                                                       planes[1].signed_distance(cloud.points[i])));
  }
  return static_cast<double>(seen) >= kJoints.seen_below * static_cast<double>(all.size()) ||
         quantile(lowest, 0.5) < -2 * near_mm;
}

// A step between the tops is a lap's or a mismatch: a mismatch where the lower plate is seen to
// end, else by its height alone where both are wanted, and as the one that is asked for may have it
// where not.
bool is_lap(const ScanCloud& cloud, const TransitionLine& candidate,
            const std::array<Plane, 2>& planes, double step, double near_mm,
            const SeamFindingSettings& settings) {
  if (step < kJoints.most_offset && lower_plate_ends(cloud, candidate, planes, near_mm))
    return false;
  const bool flush = is_wanted(JointType::kButt, settings) || is_wanted(JointType::kV, settings);
  const bool lap = is_wanted(JointType::kLap, settings);
  if (lap && !flush) return step >= kJoints.least_step;
  if (flush && !lap) return step >= settings.mismatch_max_mm;
  return step >= settings.lap_thickness_min_mm;
}

}  // namespace

double near_plate(const Scales& scales) {
  return std::min(scales.tolerance, std::max(kJoints.least_near, kFit.on_plane * scales.noise));
}

double reach_of(const ScanCloud& cloud, const JointPlate& plate, const Line& border) {
  std::vector<double> distances;
  for (const int i : plate.points)
    distances.push_back(std::abs(plate.away.dot(cloud.points[i] - border.point)));
  return quantile(distances, 0.9);
}

bool set_type(const ScanCloud& cloud, const TransitionLine& candidate, const Scales& scales,
              const SeamFindingSettings& settings, Joint& joint) {
  const PlateFrame& frame = candidate.frame;
  const std::array<Plane, 2> planes = {joint.plates[0].plane, joint.plates[1].plane};
  const auto showing = showing_edges(cloud, candidate.transitions, planes, near_plate(scales));
  const ParallelEdges edges =
      edges_of(cloud, showing, frame, planes, near_plate(scales), scales.contact / 2);
  if (!edges.plates[0] || !edges.plates[1]) return false;
  const LineFit &first = *edges.plates[0], &second = *edges.plates[1];
  const LineFit middle = middle_of(first, second);
  const Eigen::Vector3d place = on_plane(frame, middle, planes[0]).point;
  const double step = planes[0].signed_distance(place) - planes[1].signed_distance(place);
  const double width = second.across_at(middle.middle) - first.across_at(middle.middle);
  joint.parallel.emplace().seam = middle;
  if (is_lap(cloud, candidate, planes, std::abs(step), near_plate(scales), settings))
    return set_lap(cloud, candidate, showing, edges, scales, settings, step, width, joint);
  set_butt_or_groove(candidate, edges, settings, widths_of(frame, cloud, showing, first, second),
                     joint);
  return true;
}

}  // namespace arcstart::seam_finding
