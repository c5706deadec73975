#include "services/seam_finding/joints/parallel_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"
#include "services/seam_finding/joints/parallel_edges.hpp"
#include "services/seam_finding/joints/transition_line.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kThrough = 0.6;          // share of the sections in which a seam shows
constexpr double kFullReach = 10;         // as in joints.cpp; mm
constexpr double kWiderThanHigh = 1.5;    // the upper plate of a lap
constexpr double kBeside = 60;            // a plate's plane is fitted to what lies so near; mm
constexpr double kNearNoise = 4;          // of a point on a plate, over the noise
constexpr double kLeastNear = 0.15;       // mm
constexpr double kEndDeviation = 0.25;    // of a stripe's end at a gap, standard; mm
constexpr double kNarrowDeviation = 0.1;  // of a gap that no stripe tells alone; mm
constexpr double kUnsteady = 0.4;         // deviation of a seam across; mm
constexpr double kLeastReach = 15;        // of a plate away from the seam; mm
constexpr double kHiddenFoot = 0.5;       // of a lap's score: whoever scans one looks at its foot
constexpr double kShadow = 2;             // beside a step, over its height

// A plate's points on its own side of its border, and the plane through those near it.
JointPlate plate_of(const ScanCloud& cloud, const PassageLine& candidate, const Face& face,
                    int plate, double across_of_line, double slope, double contact) {
  const double outward = plate == 0 ? -1 : 1;
  JointPlate result;
  result.contact = contact;
  result.away = outward * candidate.frame.across;
  PlaneSums sums(candidate.frame.origin);
  for (const int i : face.points) {
    const Eigen::Vector3d p = candidate.frame.of(cloud.points[i]);
    const double away = outward * (p.y() - across_of_line - slope * p.x());
    if (away < 0) continue;
    result.points.push_back(i);
    if (away < kBeside && !cloud.origins[i].segment_end) sums.add(cloud.points[i]);
  }
  result.plane = face.plane;
  if (sums.weight() >= 20) {
    const auto fit = sums.fit();
    if (fit.spread[0] > 1)
      result.plane = fit.plane.normal.dot(face.plane.normal) < 0 ? fit.plane.flipped() : fit.plane;
  }
  result.points = without_scraps(cloud, result.points);
  return result;
}

// A border as a line on a plane.
Line on_plane(const PlateFrame& frame, const BorderFit& border, const Plane& plane) {
  const auto at = [&](double along) -> Eigen::Vector3d {
    const Eigen::Vector3d p =
        frame.origin + along * frame.along + border.across_at(along) * frame.across;
    return p - plane.signed_distance(p) / plane.normal.dot(frame.normal) * frame.normal;
  };
  const Eigen::Vector3d from = at(border.middle - 50), to = at(border.middle + 50);
  return {at(border.middle), (to - from).normalized()};
}

BorderFit middle_of(const BorderFit& a, const BorderFit& b) {
  BorderFit fit;
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
  if (distances.empty()) return 0;
  const auto high =
      distances.begin() + static_cast<std::ptrdiff_t>(9 * (distances.size() - 1) / 10);
  std::nth_element(distances.begin(), high, distances.end());
  return *high;
}

void set_type(const ScanCloud& cloud, const PassageLine& candidate, const FlatSearch& search,
              const Scales& scales, double near, Joint& joint) {
  const PlateFrame& frame = candidate.frame;
  const std::array<Plane, 2> planes = {joint.plates[0].plane, joint.plates[1].plane};
  FlatSeam& flat = joint.flat.emplace();
  const double pitch = scales.contact / 2;
  const FlatBorders borders = borders_of(cloud, candidate.passages, frame, planes, near, pitch);
  if (!borders.plates[0] || !borders.plates[1]) {
    joint.flaw = "its edges are not straight";
    return;
  }
  const BorderFit &first = *borders.plates[0], &second = *borders.plates[1];
  const BorderFit middle = middle_of(first, second);
  const Eigen::Vector3d place = on_plane(frame, middle, planes[0]).point;
  const double step = planes[0].signed_distance(place) - planes[1].signed_distance(place);
  const double width = second.across_at(middle.middle) - first.across_at(middle.middle);
  flat.seam = middle;

  if (std::abs(step) >= search.step_min) {
    joint.type = JointType::kLap;
    const int upper = step > 0 ? 1 : 0;
    flat.step = std::abs(step);
    flat.lower = 1 - upper;
    joint.angle = M_PI;
    const auto foot =
        lap_foot(cloud, candidate.passages, frame, planes, upper, flat.step, near, pitch);
    if (!foot) {
      joint.flaw = "its edges are not straight";
      return;
    }
    flat.seam = foot->fit;
    flat.foot_hidden = !foot->seen;
    flat.borders[upper] = on_plane(frame, foot->fit, planes[upper]);
    flat.borders[1 - upper] = on_plane(frame, borders.plates[1 - upper].value(), planes[1 - upper]);
    joint.line = on_plane(frame, foot->fit, planes[1 - upper]);
    if (!search.lap)
      joint.flaw = "a lap is not wanted";
    else if (flat.step > search.step_max)
      joint.flaw = fmt::format("its step is {:.1f} mm", flat.step);
    else if (width > kShadow * flat.step + 2 * pitch)
      joint.flaw = "the plates do not touch";
    else if (reach_of(cloud, joint.plates[upper], flat.borders[upper]) < kWiderThanHigh * flat.step)
      joint.flaw = "the upper plate is narrower than a plate is";
    return;
  }
  flat.borders = {on_plane(frame, first, planes[0]), on_plane(frame, second, planes[1])};
  flat.narrow = borders.together;
  flat.gap_deviation = std::hypot(kNarrowDeviation, std::sqrt(first.variance + second.variance));
  const Line low = on_plane(frame, middle, planes[0]), high = on_plane(frame, middle, planes[1]);
  joint.line = {(low.point + high.point) / 2, (low.direction + high.direction).normalized()};
  for (const auto& slant : borders.slants)
    if (slant) flat.half_angle = std::max(flat.half_angle, *slant);
  const bool v = flat.half_angle > search.half_angle_min;
  joint.type = v ? JointType::kV : JointType::kButt;
  if (borders.slants[0] && borders.slants[1] && v)
    flat.half_angle = (*borders.slants[0] + *borders.slants[1]) / 2;
  joint.angle = v ? 2 * flat.half_angle : M_PI;
  if (v ? !search.v : !search.butt)
    joint.flaw = v ? "a groove is not wanted" : "a butt joint is not wanted";
  else if (v && flat.half_angle > search.half_angle_max)
    joint.flaw = fmt::format("its groove opens by {:.0f} deg", 2 * flat.half_angle * 180 / M_PI);
  else if (width > (v ? search.width_max : search.gap_max) || width < 0)
    joint.flaw = fmt::format("its gap is {:.1f} mm", width);
}

void judge(const ScanCloud& cloud, const PassageLine& candidate, const FlatSearch& search,
           const Scales& scales, Joint& joint) {
  const CourseSearch course{scales.spacing, scales.tolerance};
  joint.course = find_course(stations_of_both(stations_by_border(cloud, joint, course)), course);
  const std::array<Line, 2>& borders = joint.flat->borders;
  const double reach = std::min(reach_of(cloud, joint.plates[0], borders[0]),
                                reach_of(cloud, joint.plates[1], borders[1]));
  const double share = std::min(1.0, candidate.share);
  joint.concavity = joint.explained = share;
  joint.score = joint.course.covered * share * share * std::min(1.0, reach / kFullReach) *
                (joint.flat->foot_hidden ? kHiddenFoot : 1);
  if (!joint.flaw.empty()) return;
  if (angle_between(joint.plates[0].plane.normal, joint.plates[1].plane.normal) > search.parallel)
    joint.flaw = "its plates are not parallel";
  else if (share < kThrough)
    joint.flaw = fmt::format("it shows in {:.0f} % of the stripes only", 100 * share);
  else if (joint.flat->seam.variance > kUnsteady * kUnsteady)
    joint.flaw = "its edges are not straight";
  else if (reach < kLeastReach)
    joint.flaw = "one of its plates is too narrow";
  else if (joint.course.stripes < search.stripes_min)
    joint.flaw = fmt::format("only {} stripes cross both plates", joint.course.stripes);
  else if (joint.course.covered < search.length_min)
    joint.flaw = fmt::format("both plates were seen on {:.0f} mm only", joint.course.covered);
}

// In the middle of the scan's way a plate that a stripe leaves is there for the width alone.
void measure_gaps(const ScanCloud& cloud, const PassageLine& candidate, Joint& joint) {
  FlatSeam& flat = *joint.flat;
  if (joint.type == JointType::kLap) return;
  const Eigen::Vector3d across = (joint.line.direction.cross(candidate.frame.normal)).normalized();
  const double width = std::abs(across.dot(flat.borders[1].point - flat.borders[0].point));
  double steps = 0;  // across, between a thinned-out stripe's points at the gap
  int thinned = 0;
  for (const Passage& passage : candidate.passages) {
    const Eigen::Vector3d &a = cloud.points[passage.last], &b = cloud.points[passage.first];
    double seen = std::abs(across.dot(b - a));
    if (!cloud.origins[passage.last].segment_end || !cloud.origins[passage.first].segment_end) {
      steps += seen / static_cast<double>(passage.between.size() + 1);
      ++thinned;
      seen = width;  // such a stripe tells no more than the lines through all of them
    }
    flat.gaps.push_back({joint.line.along((a + b) / 2), seen});
  }
  if (flat.narrow) return;
  // Narrow gaps show where a point happens to lie in them: their stripes err alike.
  const double step = thinned > 0 ? steps / thinned : 0;
  flat.gap_deviation = std::sqrt(2.0) * std::hypot(kEndDeviation, step / std::sqrt(12.0));
}

std::optional<Joint> joint_at(const ScanCloud& cloud, const std::vector<Face>& faces,
                              const PassageLine& candidate, const FlatSearch& search,
                              const Scales& scales, double near) {
  if (static_cast<int>(candidate.passages.size()) < search.stripes_min) return std::nullopt;
  std::vector<BorderPlace> places;
  for (const Passage& passage : candidate.passages) {
    const Eigen::Vector3d p = place_of(cloud, candidate.frame, passage);
    places.push_back({p.x(), p.y(), 0, 1});
  }
  const auto rough = fit_border(places, 1);
  if (!rough) return std::nullopt;
  Joint joint;
  joint.faces = candidate.faces;
  for (int j = 0; j < 2; ++j)
    joint.plates[j] = plate_of(cloud, candidate, faces[candidate.faces[j]], j, rough->across_at(0),
                               rough->slope, scales.contact);
  if (joint.plates[0].points.empty() || joint.plates[1].points.empty()) return std::nullopt;
  set_type(cloud, candidate, search, scales, near, joint);
  for (int j = 0; j < 2; ++j)
    joint.plates[j].away =
        (j == 0 ? -1 : 1) * candidate.frame.normal.cross(joint.line.direction).normalized();
  const std::array<Line, 2>& borders = joint.flat->borders;
  if (borders[0].direction == borders[1].direction && joint.flaw == "its edges are not straight")
    return std::nullopt;
  judge(cloud, candidate, search, scales, joint);
  if (joint.flaw.empty()) measure_gaps(cloud, candidate, joint);
  return joint;
}

bool parallel(const Face& a, const Face& b, double tolerance) {
  return angle_between(a.plane.normal, b.plane.normal) < 2 * tolerance;
}

}  // namespace

std::vector<Joint> find_flat_joints(const ScanCloud& cloud, const std::vector<Face>& faces,
                                    const FlatSearch& search, const Scales& scales) {
  std::vector<Joint> joints;
  const auto way = search_direction(cloud);
  if (!way) return joints;
  std::vector<int> face_of(cloud.points.size(), -1);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (const int i : faces[f].points) face_of[i] = f;
  const double near = std::min(scales.tolerance, std::max(kLeastNear, kNearNoise * scales.noise));
  for (int a = 0; a < static_cast<int>(faces.size()); ++a) {
    const Plane& plane = faces[a].plane;
    const Eigen::Vector3d along = *way - way->dot(plane.normal) * plane.normal;
    if (along.norm() < 0.5) continue;
    PlateFrame frame;
    frame.origin = cloud.points[faces[a].points[faces[a].points.size() / 2]];
    frame.along = along.normalized();
    frame.normal = plane.normal;
    frame.across = frame.normal.cross(frame.along);
    const auto sections = sections_across(cloud, frame, scales.spacing);
    for (int b = a; b < static_cast<int>(faces.size()); ++b) {
      if (!parallel(faces[a], faces[b], search.parallel)) continue;
      const auto all = passages_between(cloud, sections, face_of, faces, a, b, near);
      for (const bool rising : {true, false}) {
        if (a == b && !rising) continue;
        std::vector<Passage> passages;
        for (const Passage& passage : all)
          if (passage.rising == rising || a == b) passages.push_back(passage);
        PassageLine candidate;
        candidate.frame = frame;
        candidate.faces = rising ? std::array<int, 2>{a, b} : std::array<int, 2>{b, a};
        candidate.passages = on_one_line(cloud, frame, passages);
        if (candidate.passages.empty()) continue;
        candidate.share = share_of_sections(cloud, sections, candidate.passages);
        if (auto joint = joint_at(cloud, faces, candidate, search, scales, near))
          joints.push_back(std::move(*joint));
      }
    }
  }
  return joints;
}

}  // namespace arcstart::seam_finding
