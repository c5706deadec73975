// Which line the transitions from plate to plate draw, and how many stripes bear it out. The truth
// is where the transitions were put.
#include "services/seam_finding/joints/transitions.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace arcstart::seam_finding;
using Eigen::Vector3d;

namespace {

constexpr int sections = 21;
constexpr double pitch = 4;  // mm

PlateFrame plain_frame() {
  return {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
}

// Two points of plates, a millimetre apart, about that place across.
Transition add(ScanCloud& cloud, int section, double across) {
  Transition transition;
  transition.section = section;
  for (const double beside : {-0.5, 0.5}) {
    (beside < 0 ? transition.last : transition.first) = cloud.size();
    cloud.points.emplace_back(pitch * section, across + beside, 0);
  }
  return transition;
}

// Up to 2 mm off, as if by chance; the same always.
double stray(int section) { return 2 * std::sin(2.4 * section); }

double across_of(const ScanCloud& cloud, const std::vector<Transition>& transitions) {
  double sum = 0;
  for (const Transition& transition : transitions)
    sum += place_of(cloud, plain_frame(), transition).y();
  return sum / static_cast<double>(transitions.size());
}

}  // namespace

TEST_CASE("an edge that a stripe does not show is chosen before strays that each stripe shows") {
  ScanCloud cloud;
  std::vector<Transition> transitions;
  for (int k = 0; k < sections; ++k) {
    if (k != 10) transitions.push_back(add(cloud, k, 0));
    transitions.push_back(add(cloud, k, 20 + stray(k)));
  }
  const auto chosen = on_one_line(cloud, plain_frame(), transitions);
  CHECK(chosen.size() == sections - 1);
  CHECK(std::abs(across_of(cloud, chosen)) < 0.1);
}

TEST_CASE("where something stands before the plates no line is drawn, but the stripe is kept") {
  ScanCloud cloud;
  std::vector<Transition> transitions;
  for (int k = 0; k < sections; ++k) {
    transitions.push_back(add(cloud, k, 20));
    transitions.back().covered = true;
    if (k % 2 == 0) transitions.push_back(add(cloud, k, 0));
    if (k % 2 == 0) transitions.back().covered = k == 4;
  }
  const auto chosen = on_one_line(cloud, plain_frame(), transitions);
  CHECK(std::abs(across_of(cloud, chosen)) < 0.1);
  CHECK(chosen.size() == (sections + 1) / 2);
}

TEST_CASE("stripes that do not see both plates say nothing of how many show a seam") {
  ScanCloud cloud;
  TransitionLine line;
  line.frame = plain_frame();
  line.faces = {0, 0};
  std::vector<Section> stripes;
  for (int k = 0; k < sections; ++k) {
    // In each third stripe the plates go on into each other, in another a bar lies over both.
    const double far = k % 3 == 2 ? 30 : 3;
    stripes.emplace_back();
    if (k % 3 == 0) line.transitions.push_back(add(cloud, k, 0));
    for (const double side : {-far, far}) {
      stripes.back().push_back(cloud.size());
      cloud.points.emplace_back(pitch * k, side, 0);
    }
  }
  const std::vector<int> face_of(cloud.points.size(), 0);
  CHECK(share_of_sections(cloud, stripes, face_of, line) == Approx(0.5).margin(0.05));
}
