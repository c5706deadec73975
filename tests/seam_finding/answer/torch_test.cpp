#include "services/seam_finding/answer/torch.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return angle_between(a, b) / kDegree;
}

}  // namespace

TEST_CASE("the torch stands between the plates, leans back, and comes clear of both") {
  const Eigen::Vector3d start(10, 20, 30), ahead = Eigen::Vector3d::UnitX();
  for (const double joint : {60.0, 90.0, 120.0}) {
    // The upright's face, by turning it about the seam.
    const Eigen::Vector3d base(0, 0, 1);
    const Eigen::Vector3d upright(0, -std::sin(joint * kDegree), -std::cos(joint * kDegree));
    for (const bool swapped : {false, true}) {
      const auto normals =
          swapped ? std::array{upright, base} : std::array<Eigen::Vector3d, 2>{base, upright};
      const TorchPose pose = torch_at(start, ahead, normals, {0, 10 * kDegree, 100});
      const Eigen::Vector3d wire = pose.orientation * Eigen::Vector3d::UnitZ();
      // The wire makes the same angle with both plates, and 80 deg with the seam.
      CHECK(wire.dot(base) == Approx(wire.dot(upright)));
      CHECK(wire.dot(base) < 0);
      CHECK(degrees_between(wire, ahead) == Approx(80));
      CHECK((pose.orientation * Eigen::Vector3d::UnitX()).dot(ahead) > 0.9);
      CHECK((pose.approach - start).norm() == Approx(100));
      CHECK((pose.approach - start).dot(base) > 25);
      CHECK((pose.approach - start).dot(upright) > 25);
      CHECK(pose.position == start);
    }
  }
}

TEST_CASE("the work angle counts from the flatter plate and keeps off both") {
  const std::array<Eigen::Vector3d, 2> normals{Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1)};
  const auto wire_at = [&](double work_deg) -> Eigen::Vector3d {
    return torch_at({0, 0, 0}, {1, 0, 0}, normals, {work_deg * kDegree, 0, 50}).orientation *
           Eigen::Vector3d::UnitZ();
  };
  CHECK(degrees_between(-wire_at(35), {0, -1, 0}) == Approx(35));  // the base's own direction
  CHECK(degrees_between(-wire_at(140), {0, -1, 0}) == Approx(81));
  CHECK(degrees_between(-wire_at(2), {0, -1, 0}) == Approx(9));
}
