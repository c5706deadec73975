// Crossing faces that are no two plates: the sides of a groove and the edge of a block. Of faces
// drawn as grids of points.
#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/joints/block_edge.hpp"
#include "services/seam_finding/joints/groove_faces.hpp"
#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using Eigen::Vector3d;

namespace {

constexpr double length = 42;  // mm; of the seam, along x

struct DrawnFaces {
  ScanCloud cloud;
  std::vector<Face> faces;
  Joint joint;
  Scales scales = scales_of_test(3, 0.5);

  // Points 1.5 mm apart from a corner along two edges, where `there` says so.
  template <class There>
  void add(const Vector3d& corner, const Vector3d& u, const Vector3d& v, const Vector3d& normal,
           There there) {
    Face face;
    face.plane = {normal.normalized(), -normal.normalized().dot(corner)};
    face.spacing = 1.5;
    for (double a = 0; a <= u.norm(); a += 1.5)
      for (double b = 0; b <= v.norm(); b += 1.5) {
        const Vector3d point = corner + a * u.normalized() + b * v.normalized();
        if (!there(point)) continue;
        face.points.push_back(cloud.size());
        cloud.points.push_back(point);
        cloud.origins.emplace_back();
      }
    faces.push_back(face);
  }
  void add(const Vector3d& corner, const Vector3d& u, const Vector3d& v, const Vector3d& normal) {
    add(corner, u, v, normal, [](const Vector3d&) { return true; });
  }

  // Of the first two faces, along x through that place.
  void set_joint(const Vector3d& at, JointType type) {
    joint.type = type;
    joint.faces = {0, 1};
    joint.line = {at, Vector3d::UnitX()};
    joint.coverage.begin = 0, joint.coverage.end = length;
    for (int j = 0; j < 2; ++j)
      joint.plates[j].plane = faces[j].plane, joint.plates[j].points = faces[j].points;
  }
};

// Of two plates that open by 60 deg, 6 mm deep; one of their tops tilted along the seam's line.
DrawnFaces groove_sides(double tilt_deg) {
  DrawnFaces drawn;
  const double depth = 6, half = depth * std::tan(30 * kDegree), tilt = tilt_deg * kDegree;
  const Vector3d root(0, 0, -depth), along(length, 0, 0);
  drawn.add(root, along, {0, -half, depth}, {0, depth, half});
  drawn.add(root, along, {0, half, depth}, {0, -depth, half});
  drawn.add({0, -half, 0}, along, {0, -30, 0}, {0, 0, 1});
  drawn.add({0, half, 0}, along, 30 * Vector3d(0, std::cos(tilt), std::sin(tilt)),
            {0, -std::sin(tilt), std::cos(tilt)});
  drawn.set_joint(root, JointType::kTee);
  return drawn;
}

// A lying plate and one that stands on it, with the standing one's top.
DrawnFaces tee() {
  DrawnFaces drawn;
  const Vector3d along(length, 0, 0);
  drawn.add({0, 0, 0}, along, {0, 40, 0}, {0, 0, 1});
  drawn.add({0, 0, 0}, along, {0, 0, 40}, {0, 1, 0});
  drawn.add({0, 0, 40}, along, {0, -8, 0}, {0, 0, 1});
  drawn.set_joint({0, 0, 0}, JointType::kTee);
  return drawn;
}

// An edge seen from outside: top and front, and the face that closes its end, `thick` deep behind
// either.
DrawnFaces edge(double thick, double end_at = length) {
  DrawnFaces drawn;
  const Vector3d along(length, 0, 0);
  drawn.add({0, 0, 0}, along, {0, -40, 0}, {0, 0, 1});
  drawn.add({0, 0, 0}, along, {0, 0, -40}, {0, 1, 0});
  drawn.add({end_at, 0, 0}, {0, -40, 0}, {0, 0, -40}, {1, 0, 0},
            [&](const Vector3d& p) { return p.y() > -thick || p.z() > -thick; });
  drawn.set_joint({0, 0, 0}, JointType::kOutsideCorner);
  return drawn;
}

bool are_sides(const DrawnFaces& drawn) {
  return are_sides_of_groove(drawn.cloud, drawn.faces, drawn.joint, 4 * kDegree, drawn.scales);
}

bool is_block(const DrawnFaces& drawn) {
  return is_edge_of_block(drawn.cloud, drawn.faces, drawn.joint, drawn.scales);
}

}  // namespace

TEST_CASE("two sides that end at parallel tops are a groove's") {
  CHECK(are_sides(groove_sides(0)));
  CHECK(are_sides(groove_sides(3)));
  CHECK_FALSE(are_sides(groove_sides(12)));  // tops 12 deg from parallel are no plates side by side
}

TEST_CASE("where one top is missing, or the plates stand square, it is no groove") {
  DrawnFaces drawn = groove_sides(0);
  drawn.faces.pop_back();
  CHECK_FALSE(are_sides(drawn));
  CHECK_FALSE(are_sides(tee()));
}

TEST_CASE("an end's face that is deep behind both plates closes a block, their cuts two plates") {
  CHECK(is_block(edge(40)));
  CHECK_FALSE(is_block(edge(8)));
  // Nor does a face that is not at the seam's end say anything.
  CHECK_FALSE(is_block(edge(40, length + 30)));
}
