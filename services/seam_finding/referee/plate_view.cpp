#include "services/seam_finding/referee/plate_view.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// The seam carried square to the plate onto its plane, and the directions in which places count.
struct Frame {
  Plane plane;
  Eigen::Vector3d origin, along, away;
};

Frame frame_of(const SeamResult& seam, const SeamPlate& plate) {
  Frame frame;
  frame.plane = plate.plane;
  frame.origin = seam.start - plate.plane.signed_distance(seam.start) * plate.plane.normal;
  frame.along =
      (seam.direction - seam.direction.dot(plate.plane.normal) * plate.plane.normal).normalized();
  frame.away = plate.away;
  return frame;
}

// The light of one stripe, over a plate.
struct LightOver {
  Eigen::Vector3d source;
  double height;  // of the source; mm
};

// Where the light to a point meets the plane; false where it does not, or in too flat an angle.
bool set_place(const Frame& frame, const LightOver& light, const Eigen::Vector3d& point,
               Place& place) {
  place.height = frame.plane.signed_distance(point);
  Eigen::Vector3d at = point - place.height * frame.plane.normal;
  if (std::abs(place.height) > kReferee.bend) {
    const double share = light.height / (light.height - place.height);  // of the way to the point
    if (!std::isfinite(share) || share <= 0) return false;
    at = light.source + share * (point - light.source);
  }
  place.away = frame.away.dot(at - frame.origin);
  if (place.away < -kReferee.near_seam || place.away > kReferee.reach) return false;
  place.along = frame.along.dot(at - frame.origin);
  return true;
}

// Along the seam for each mm toward the plate, of a ray from there to a place on it.
double slant_of(const Frame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& place) {
  return std::abs(frame.along.dot(from - place) / frame.plane.signed_distance(from));
}

// The light's trace on the plate; false where it runs along the seam, or light or camera are behind
// the plate.
bool set_trace(const Frame& frame, const StripeLight& light, const Eigen::Vector3d& camera,
               StripeOnPlate& stripe) {
  if (frame.plane.signed_distance(light.source) <= 0 || frame.plane.signed_distance(camera) <= 0)
    return false;
  const double slope = light.plane.normal.dot(frame.along);
  stripe.crossing = -light.plane.signed_distance(frame.origin) / slope;
  stripe.lean = -light.plane.normal.dot(frame.away) / slope;
  const Eigen::Vector3d place = frame.origin + stripe.crossing * frame.along;
  stripe.shadow = std::max(slant_of(frame, light.source, place), slant_of(frame, camera, place));
  return std::abs(stripe.lean) < kReferee.flattest;
}

// scratch: keeps its memory from stripe to stripe, for fresh memory costs more than the places.
void add_places(std::span<const ThinnedPoint> points, const Frame& frame, const StripeLight& light,
                std::vector<Place>& scratch, StripeOnPlate& stripe) {
  scratch.clear();
  const LightOver over{light.source, frame.plane.signed_distance(light.source)};
  Place place;
  for (const ThinnedPoint& point : points) {
    if (!set_place(frame, over, point.at, place)) continue;
    place.ends = point.ends, place.point = point.index, place.segment = point.segment;
    scratch.push_back(place);
  }
  sort_by(&Place::away, scratch);
  stripe.places = scratch;
}

// Of the stripes between the ends that nothing covers: the first of two places in a row
// that lie on the claimed plane and along it, as on a round edge they do not. Beside the seam
// itself the other plate comes as near to it. One stripe of four shows the plate so near: others
// may leave a tack or a tool there.
double begin_of(const PlateView& view, double length) {
  const double at_seam = view.plate.inset + kReferee.step / 2;
  std::vector<double> begins, steps;
  for (const StripeOnPlate& stripe : view.stripes) {
    if (stripe.crossing < 0 || stripe.crossing > length) continue;
    const Place* last = nullptr;
    for (const Place& place : stripe.places) {
      if (place.away < at_seam) continue;
      if (place.height > kReferee.bend) break;  // covered
      const bool on = std::abs(place.height) < kReferee.bend;
      if (on && last && std::abs(place.height - last->height) < kReferee.least_tolerance) {
        begins.push_back(last->away), steps.push_back(place.away - last->away);
        break;
      }
      last = on ? &place : nullptr;
    }
  }
  if (begins.empty()) return view.plate.inset;
  const double begin = upper_quantile(begins, 0.25);
  // As near as chance puts the first of places that stand so far apart is the seam itself.
  if (begin < at_seam + median(steps) / 2) return view.plate.inset;
  return std::min(begin, view.plate.inset + kModel.widest_round);
}

}  // namespace

void thin_out(const ScanCloud& cloud, ThinnedScan& thinned) {
  const std::vector<Eigen::Vector3d>& points = cloud.points;
  const std::vector<PointOrigin>& origins = cloud.origins;
  for (std::size_t k = thinned.behind.size(); k < cloud.stripes.size(); ++k) {
    const ScanStripe& stripe = cloud.stripes[k];
    const int behind = stripe.first + stripe.count;
    for (int i = stripe.first; i < behind;) {
      thinned.points.push_back({points[i], i, origins[i].segment, origins[i].segment_end});
      // So far as neighbours lie within a step, but not over a segment's end. Noise parts direct
      // neighbours more than the way along the stripe does.
      int jump = kReferee.longest_jump;
      while (jump > 1 && (i + jump >= behind || origins[i + jump].segment != origins[i].segment))
        jump /= 2;
      while (jump > 1 &&
             (points[i + jump] - points[i]).squaredNorm() > kReferee.step * kReferee.step)
        jump /= 2;
      i += jump;
    }
    thinned.behind.push_back(thinned.points.size());
  }
}

PlateView view_of(const ScanCloud& cloud, const ThinnedScan& thinned,
                  const std::vector<std::optional<StripeLight>>& lights, const SeamResult& seam,
                  int plate) {
  PlateView view;
  view.plate = seam.faces[plate];
  const Frame frame = frame_of(seam, view.plate);
  const double length = (seam.end - seam.start).norm();
  view.stripes.reserve(lights.size());
  std::vector<Place> scratch;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    if (!lights[k]) continue;
    StripeOnPlate stripe;
    stripe.stripe = static_cast<int>(k);
    if (!set_trace(frame, *lights[k], cloud.stripes[k].camera_centre, stripe)) continue;
    if (stripe.crossing < -kReferee.reach || stripe.crossing > length + kReferee.reach) continue;
    add_places(thinned.of_stripe(k), frame, *lights[k], scratch, stripe);
    view.stripes.push_back(std::move(stripe));
  }
  std::sort(view.stripes.begin(), view.stripes.end(),
            [](const StripeOnPlate& a, const StripeOnPlate& b) { return a.crossing < b.crossing; });
  view.begin = begin_of(view, length);
  return view;
}

}  // namespace arcstart::seam_finding
