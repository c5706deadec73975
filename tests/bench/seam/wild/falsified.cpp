#include "tests/bench/seam/wild/falsified.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <utility>

#include "common/geometry.hpp"

namespace arcstart {

using Eigen::Vector3d;
using namespace seam_finding;
namespace {

constexpr double beside_mm = 40;  // of the seam's line: what the scan shows there goes on

// How far beyond an end the scan goes on; mm.
double room_beyond(const SeamResult& seam, const ScanCloud& cloud, bool start) {
  const Vector3d outward = start ? Vector3d(-seam.direction) : seam.direction;
  const Vector3d& end = start ? seam.start : seam.end;
  double farthest = 0;
  for (const Vector3d& point : cloud.points) {
    const double beyond = outward.dot(point - end);
    if (beyond > farthest && (point - end - beyond * outward).norm() < beside_mm) farthest = beyond;
  }
  return farthest;
}

double deviation_along(const SeamResult& seam, bool start) {
  if (!seam.accuracy) return 0;
  const Eigen::Matrix3d& covariance = start ? seam.accuracy->start : seam.accuracy->end;
  return std::sqrt(std::max(0.0, seam.direction.dot(covariance * seam.direction)));
}

class Falsifier {
 public:
  Falsifier(const SeamResult& seam, const ScanCloud& cloud, double spacing, std::uint64_t seed)
      : seam_(seam), cloud_(cloud), spacing_(spacing), random_(seed) {}

  std::vector<Falsified> all() {
    for (const bool start : {true, false}) {
      if ((start ? seam_.start_visibility : seam_.end_visibility) != EndVisibility::kSeen) continue;
      const double room = room_beyond(seam_, cloud_, start);
      const double near = 1.5 * spacing_ + 3 * deviation_along(seam_, start);
      std::uniform_real_distribution<double> spacings(2, 8);
      for (const double way : {-1.0, 1.0}) {
        move("moved", start, way * near, room);
        move("neighbour", start, way * spacings(random_) * spacing_, room);
      }
    }
    for (const int plate : {0, 1})
      for (const double way : {-1.0, 1.0}) turn(plate, way * kDegree);
    if (!same_faces()) swap();
    return std::move(all_);
  }

 private:
  // Of a butt joint without mismatch either is the other's.
  bool same_faces() const {
    constexpr double turned_rad = kDegree, apart_mm = 0.5;
    const Plane &one = seam_.faces[0].plane, &other = seam_.faces[1].plane;
    const Vector3d middle = (seam_.start + seam_.end) / 2;
    return angle_between(one.normal, other.normal) < turned_rad &&
           std::abs(one.normal.dot(middle) + one.offset -
                    (other.normal.dot(middle) + other.offset)) < apart_mm;
  }

  void swap() {
    SeamResult swapped = seam_;
    std::swap(swapped.normals[0], swapped.normals[1]);
    std::swap(swapped.faces[0].plane, swapped.faces[1].plane);
    all_.push_back({"swapped", "faces swapped", ClaimedEnd::kNone, 0, std::move(swapped)});
  }

  // outward: above 0.
  void move(const char* kind, bool start, double outward, double room) {
    const double length = (seam_.end - seam_.start).norm();
    if (outward > room || -outward > length / 2) return;
    SeamResult moved = seam_;
    (start ? moved.start : moved.end) += (start ? -outward : outward) * seam_.direction;
    all_.push_back({kind,
                    fmt::format("{} {:.1f} mm {}", start ? "start" : "end", std::abs(outward),
                                outward > 0 ? "out" : "in"),
                    start ? ClaimedEnd::kStart : ClaimedEnd::kEnd, outward, std::move(moved)});
  }

  // About the line that the plate's face has in common with the seam, its own edge.
  void turn(int plate, double angle) {
    SeamResult turned = seam_;
    SeamPlate& face = turned.faces[plate];
    const Eigen::AngleAxisd by(angle, seam_.direction);
    const Vector3d on = seam_.start + face.inset * face.away;
    const Vector3d foot = on - (face.plane.normal.dot(on) + face.plane.offset) * face.plane.normal;
    face.plane.normal = by * face.plane.normal;
    face.plane.offset = -face.plane.normal.dot(foot);
    face.away = by * face.away;
    turned.normals[plate] = by * seam_.normals[plate];
    all_.push_back({"turned", fmt::format("plate {} by {:+.0f} deg", plate + 1, angle / kDegree),
                    ClaimedEnd::kNone, 0, std::move(turned)});
  }

  const SeamResult& seam_;
  const ScanCloud& cloud_;
  double spacing_;
  std::mt19937_64 random_;
  std::vector<Falsified> all_;
};

}  // namespace

std::vector<Falsified> falsified(const SeamResult& seam, const ScanCloud& cloud, double spacing,
                                 std::uint64_t seed) {
  return Falsifier(seam, cloud, spacing, seed).all();
}

}  // namespace arcstart
