#include "services/seam_finding/joints/parallel_joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/fit/order_statistics.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/parallel_edges.hpp"
#include "services/seam_finding/joints/straight_runs.hpp"
#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {
namespace {

// How far a point of a plate lies from its plane; mm.
double near_plate(const Scales& scales) {
  return std::min(scales.tolerance, std::max(kJoints.least_near, kFit.on_plane * scales.noise));
}

bool is_wanted(JointType type, const SeamFindingSettings& settings) {
  const auto wanted = wanted_types(settings.joint_type);
  return std::find(wanted.begin(), wanted.end(), type) != wanted.end();
}

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
                    int plate, double across_of_line, double slope, double contact) {
  const double outward = plate == 0 ? -1 : 1;
  JointPlate result;
  result.contact = contact;
  result.away = outward * candidate.frame.across;
  PlaneSums sums(candidate.frame.origin);
  const auto [first, last] = sections_of(candidate.transitions);
  for (const int i : face.points) {
    const Eigen::Vector3d p = candidate.frame.of(cloud.points[i]);
    const double away = outward * (p.y() - across_of_line - slope * p.x());
    if (away < 0) continue;
    result.points.push_back(i);
    // Beyond the seam's ends another plate may lie on this side.
    const int stripe = cloud.origins[i].stripe;
    if (candidate.by_runs && (stripe < first || stripe > last)) continue;
    if (away < kPlanes.fit_reach && !cloud.origins[i].segment_end) sums.add(cloud.points[i]);
  }
  result.plane = face.plane;
  if (sums.weight() >= 20) {
    const auto fit = sums.fit();
    if (fit.spread[0] > 1)
      result.plane = fit.plane.normal.dot(face.plane.normal) < 0 ? fit.plane.flipped() : fit.plane;
  }
  result.points = without_fragments(cloud, result.points);
  return result;
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

double reach_of(const ScanCloud& cloud, const JointPlate& plate, const Line& border) {
  std::vector<double> distances;
  for (const int i : plate.points)
    distances.push_back(std::abs(plate.away.dot(cloud.points[i] - border.point)));
  return quantile(distances, 0.9);
}

// The plates' edges make a lap: the upper one's lower edge on the lower one. False where there is
// no straight edge.
bool set_lap(const ScanCloud& cloud, const TransitionLine& candidate, const ParallelEdges& edges,
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
  const auto root = lap_root(cloud, candidate.transitions, frame, planes, upper, seam.step,
                             near_plate(scales), pitch);
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
  else if (seam.step > settings.lap_thickness_max_mm)
    joint.flaw = {Code::kLapThickness, seam.step};
  else if (width > kJoints.step_shadow * seam.step + 2 * pitch)
    joint.flaw = {Code::kPlatesDoNotTouch};
  else if (reach_of(cloud, joint.plates[upper], seam.edges[upper]) <
           kJoints.wider_than_high * seam.step)
    joint.flaw = {Code::kUpperPlateNarrow};
  return true;
}

// They make a butt joint or, where their edges slant, a groove: the seam runs in the middle.
void set_butt_or_groove(const TransitionLine& candidate, const ParallelEdges& edges,
                        const SeamFindingSettings& settings, double width, Joint& joint) {
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
  using Code = Reason::Code;
  if (!is_wanted(joint.type, settings))
    joint.flaw = {groove ? Code::kGrooveNotWanted : Code::kButtNotWanted};
  else if (groove && seam.half_angle > half_angle_max)
    joint.flaw = {Code::kGrooveAngle, 2 * seam.half_angle};
  else if (width > (groove ? settings.v_width_max_mm : settings.butt_gap_max_mm) ||
           width < -kJoints.overlap)
    joint.flaw = {Code::kGapWidth, width};
}

// Between the plates' edges something is seen that lies below both: there the lower one ends, too.
bool lower_plate_ends(const ScanCloud& cloud, const TransitionLine& candidate,
                      const std::array<Plane, 2>& planes, double near_mm) {
  const auto& all = candidate.transitions;
  return static_cast<double>(
             std::count_if(all.begin(), all.end(), [&](const Transition& transition) {
               return sees_below(cloud, transition, planes, near_mm);
             })) >= kJoints.seen_below * static_cast<double>(all.size());
}

// A step between the tops is a lap's or a mismatch: by its height alone where both are wanted, else
// as the one that is asked for may have it.
bool is_lap(const ScanCloud& cloud, const TransitionLine& candidate,
            const std::array<Plane, 2>& planes, double step, double near_mm,
            const SeamFindingSettings& settings) {
  const bool flush = is_wanted(JointType::kButt, settings) || is_wanted(JointType::kV, settings);
  const bool lap = is_wanted(JointType::kLap, settings);
  if (lap && !flush && step < settings.lap_thickness_min_mm)
    return step >= kJoints.least_step && !lower_plate_ends(cloud, candidate, planes, near_mm);
  if (flush && !lap) return step >= std::max(settings.lap_thickness_min_mm, kJoints.most_mismatch);
  return step >= settings.lap_thickness_min_mm;
}

// What joint the plates' edges make. False where they have none that is straight.
bool set_type(const ScanCloud& cloud, const TransitionLine& candidate, const Scales& scales,
              const SeamFindingSettings& settings, Joint& joint) {
  const PlateFrame& frame = candidate.frame;
  const std::array<Plane, 2> planes = {joint.plates[0].plane, joint.plates[1].plane};
  const ParallelEdges edges =
      edges_of(cloud, candidate.transitions, frame, planes, near_plate(scales), scales.contact / 2);
  if (!edges.plates[0] || !edges.plates[1]) return false;
  const LineFit &first = *edges.plates[0], &second = *edges.plates[1];
  const LineFit middle = middle_of(first, second);
  const Eigen::Vector3d place = on_plane(frame, middle, planes[0]).point;
  const double step = planes[0].signed_distance(place) - planes[1].signed_distance(place);
  const double width = second.across_at(middle.middle) - first.across_at(middle.middle);
  joint.parallel.emplace().seam = middle;
  if (is_lap(cloud, candidate, planes, std::abs(step), near_plate(scales), settings))
    return set_lap(cloud, candidate, edges, scales, settings, step, width, joint);
  set_butt_or_groove(candidate, edges, settings, width, joint);
  return true;
}

void judge(const ScanCloud& cloud, const TransitionLine& candidate, const Scales& scales,
           const SeamFindingSettings& settings, Joint& joint) {
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
  else if (joint.parallel->seam.variance > kJoints.unsteady * kJoints.unsteady)
    joint.flaw = {Code::kEdgesNotStraight};
  else if (reach < kJoints.least_reach)
    joint.flaw = {Code::kPlateNarrow};
  else if (joint.coverage.stripes < settings.stripes_min)
    joint.flaw = {Code::kFewStripesCross, static_cast<double>(joint.coverage.stripes)};
  else if (joint.coverage.covered < kJoints.shortest_doubtful)
    joint.flaw = {Code::kShortlySeen, joint.coverage.covered};
}

// A stripe that goes straight on across a gap runs over what lies flush beyond the seam's end, as a
// run-off tab: what it shows is neither plate. A bead between the plates is not as flat.
void leave_out_what_runs_across(const ScanCloud& cloud, const Scales& scales, Joint& joint) {
  if (!cloud.organised() || joint.type == JointType::kLap) return;
  const std::array<Line, 2>& edges = joint.parallel->edges;
  const Eigen::Vector3d across = joint.plates[1].away;
  struct Between {
    int count = 0;
    double least = std::numeric_limits<double>::infinity(), most = -least;
  };
  std::vector<Between> stripes(cloud.stripes.size());
  for (int i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    const double along = edges[0].along(p);
    const double from = across.dot(p - edges[0].at(along)),
                 to = across.dot(edges[1].at(edges[1].along(p)) - p);
    if (from < kJoints.off_border || to < kJoints.off_border) continue;
    Between& between = stripes[cloud.origins[i].stripe];
    const double height = joint.plates[from > to ? 1 : 0].plane.signed_distance(p);
    ++between.count;
    between.least = std::min(between.least, height), between.most = std::max(between.most, height);
  }
  const auto runs_across = [&](int i) {
    const Between& between = stripes[cloud.origins[i].stripe];
    return between.count >= kModel.sure_points && between.least > -scales.tolerance &&
           between.most < scales.tolerance && between.most - between.least < 2 * near_plate(scales);
  };
  for (JointPlate& plate : joint.plates) std::erase_if(plate.points, runs_across);
}

// In the middle of the scan's way a plate that a stripe leaves is there for the width alone.
void measure_gaps(const ScanCloud& cloud, const TransitionLine& candidate, Joint& joint) {
  ParallelSeam& flat = *joint.parallel;
  if (joint.type == JointType::kLap) return;
  const Eigen::Vector3d across = (joint.line.direction.cross(candidate.frame.normal)).normalized();
  const double width = std::abs(across.dot(flat.edges[1].point - flat.edges[0].point));
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
    flat.gaps.push_back({joint.line.along((a + b) / 2), seen});
  }
  if (flat.narrow) return;
  // Narrow gaps show where a point happens to lie in them: their stripes err alike.
  const double step = downsampled > 0 ? steps / downsampled : 0;
  flat.gap_deviation = std::sqrt(2.0) * std::hypot(kJoints.end_deviation, step / std::sqrt(12.0));
}

std::optional<Joint> joint_at(const ScanCloud& cloud, const std::vector<Face>& faces,
                              const TransitionLine& candidate, const Scales& scales,
                              const SeamFindingSettings& settings) {
  if (static_cast<int>(candidate.transitions.size()) < settings.stripes_min) return std::nullopt;
  std::vector<LinePlace> places;
  for (const Transition& transition : candidate.transitions) {
    const Eigen::Vector3d p = place_of(cloud, candidate.frame, transition);
    places.push_back({p.x(), p.y(), 0, 1});
  }
  const auto rough = fit_line(places, 1);
  if (!rough) return std::nullopt;
  Joint joint;
  joint.faces = candidate.faces;
  for (int j = 0; j < 2; ++j)
    joint.plates[j] = plate_of(cloud, candidate, faces[candidate.faces[j]], j, rough->across_at(0),
                               rough->slope, scales.contact);
  if (joint.faces[0] == joint.faces[1]) keep_own_height(cloud, near_plate(scales), joint.plates);
  if (joint.plates[0].points.empty() || joint.plates[1].points.empty()) return std::nullopt;
  if (!set_type(cloud, candidate, scales, settings, joint)) return std::nullopt;
  for (int j = 0; j < 2; ++j)
    joint.plates[j].away =
        (j == 0 ? -1 : 1) * candidate.frame.normal.cross(joint.line.direction).normalized();
  leave_out_what_runs_across(cloud, scales, joint);
  if (joint.plates[0].points.empty() || joint.plates[1].points.empty()) return std::nullopt;
  judge(cloud, candidate, scales, settings, joint);
  if (!joint.flaw) measure_gaps(cloud, candidate, joint);
  return joint;
}

bool parallel(const Face& a, const Face& b, double tolerance) {
  return angle_between(a.plane.normal, b.plane.normal) < 2 * tolerance;
}

// Half of a face's points are no farther from another's plane than plates side by side may be.
bool level_with(const ScanCloud& cloud, const Face& face, const Plane& plane) {
  std::vector<double> off;
  for (const int i : face.points) off.push_back(std::abs(plane.signed_distance(cloud.points[i])));
  return quantile(off, 0.5) < kJoints.one_level;
}

// Two plates side by side at one level may have been laid out as a face that holds a part of both,
// and one that holds the rest. Such faces together, for each group of two or more.
std::vector<Face> level_faces(const ScanCloud& cloud, const std::vector<Face>& faces,
                              double tolerance) {
  std::vector<int> group(faces.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a + 1; b < faces.size(); ++b)
      if (parallel(faces[a], faces[b], tolerance) && level_with(cloud, faces[a], faces[b].plane) &&
          level_with(cloud, faces[b], faces[a].plane))
        std::replace(group.begin(), group.end(), group[b], group[a]);
  std::vector<Face> together;
  for (int g = 0; g < static_cast<int>(faces.size()); ++g) {
    if (std::count(group.begin(), group.end(), g) < 2) continue;
    Face face;
    std::size_t most = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (group[f] != g) continue;
      face.points.insert(face.points.end(), faces[f].points.begin(), faces[f].points.end());
      if (faces[f].points.size() > most) most = faces[f].points.size(), face.plane = faces[f].plane;
    }
    std::sort(face.points.begin(), face.points.end());
    together.push_back(std::move(face));
  }
  return together;
}

std::vector<int> face_of_points(const ScanCloud& cloud, const std::vector<Face>& faces) {
  std::vector<int> face_of(cloud.points.size(), -1);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (const int i : faces[f].points) face_of[i] = f;
  return face_of;
}

// Axes in the face, along the search; nothing where that leads out of it.
std::optional<PlateFrame> frame_of(const ScanCloud& cloud, const Face& face,
                                   const Eigen::Vector3d& way) {
  const Eigen::Vector3d& normal = face.plane.normal;
  const Eigen::Vector3d along = way - way.dot(normal) * normal;
  if (along.norm() < 0.5) return std::nullopt;
  PlateFrame frame;
  frame.origin = cloud.points[face.points[face.points.size() / 2]];
  frame.along = along.normalized();
  frame.normal = normal;
  frame.across = frame.normal.cross(frame.along);
  return frame;
}

// The joint that the transitions on one line make.
std::optional<Joint> joint_through(const ScanCloud& cloud, const std::vector<Face>& faces,
                                   const std::array<int, 2>& sides, const PlateFrame& frame,
                                   const std::vector<Section>& sections,
                                   const std::vector<Transition>& transitions, bool by_runs,
                                   const Scales& scales, const SeamFindingSettings& settings) {
  TransitionLine candidate;
  candidate.frame = frame;
  candidate.faces = sides;
  candidate.by_runs = by_runs;
  candidate.transitions = on_one_line(cloud, frame, transitions);
  if (candidate.transitions.empty()) return std::nullopt;
  candidate.share = share_of_sections(cloud, sections, candidate.transitions);
  return joint_at(cloud, faces, candidate, scales, settings);
}

// Than one that was found in the plainer way.
bool clearly_better(const Joint& joint, const Joint& plain) {
  if (static_cast<bool>(joint.flaw) != static_cast<bool>(plain.flaw)) return !joint.flaw;
  if (joint.score > kJoints.clearly_better * plain.score) return true;
  return kJoints.clearly_better * joint.score > plain.score &&
         joint.parallel->seam.variance < kJoints.clearly_closer * plain.parallel->seam.variance;
}

// The joints between each face and those behind it in the list, where `pairs`, and within each.
void add_joints(const ScanCloud& cloud, const std::vector<Face>& faces, bool pairs,
                const Eigen::Vector3d& way, const Scales& scales,
                const SeamFindingSettings& settings, std::vector<Joint>& joints) {
  const std::vector<int> face_of = face_of_points(cloud, faces);
  const int count = static_cast<int>(faces.size());
  for (int a = 0; a < count; ++a) {
    const auto frame = frame_of(cloud, faces[a], way);
    if (!frame) continue;
    const auto sections = sections_across(cloud, *frame, scales.spacing);
    for (int b = a; b < (pairs ? count : a + 1); ++b) {
      if (!parallel(faces[a], faces[b], settings.parallel_tolerance_deg * kDegree)) continue;
      const auto all =
          transitions_between(cloud, sections, face_of, faces, a, b, near_plate(scales));
      for (const bool rising : {true, false}) {
        if (a == b && !rising) continue;
        std::vector<Transition> transitions;
        for (const Transition& transition : all)
          if (transition.rising == rising || a == b) transitions.push_back(transition);
        const std::array<int, 2> sides =
            rising ? std::array<int, 2>{a, b} : std::array<int, 2>{b, a};
        auto joint = joint_through(cloud, faces, sides, *frame, sections, transitions, false,
                                   scales, settings);
        if (a == b && cloud.organised()) {
          auto by_runs = joint_through(
              cloud, faces, sides, *frame, sections,
              transitions_within(cloud, sections, *frame, face_of, a, b, near_plate(scales)), true,
              scales, settings);
          if (by_runs && (!joint || clearly_better(*by_runs, *joint))) joint = std::move(by_runs);
        }
        if (joint) joints.push_back(std::move(*joint));
      }
    }
  }
}

}  // namespace

std::vector<Joint> find_parallel_joints(const ScanCloud& cloud, const std::vector<Face>& faces,
                                        const Scales& scales, const SeamFindingSettings& settings) {
  std::vector<Joint> joints;
  const auto way = search_direction(cloud);
  if (!way) return joints;
  add_joints(cloud, faces, true, *way, scales, settings, joints);
  if (!cloud.organised()) return joints;
  std::vector<Joint> together;
  add_joints(cloud, level_faces(cloud, faces, settings.parallel_tolerance_deg * kDegree), false,
             *way, scales, settings, together);
  const std::size_t plain = joints.size();
  for (Joint& joint : together)
    if (std::all_of(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(plain),
                    [&](const Joint& other) { return clearly_better(joint, other); }))
      joints.push_back(std::move(joint));
  return joints;
}

}  // namespace arcstart::seam_finding
