#include "services/seam_finding/referee/ruling.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace arcstart::seam_finding;

namespace {

using Code = Reason::Code;

SeamResult answer(double deviation) {
  SeamResult seam;
  seam.verdict = SeamResult::Verdict::kFound;
  seam.direction = Eigen::Vector3d::UnitX();
  seam.end = 100 * seam.direction;
  seam.normals = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()};
  seam.start_visibility = seam.end_visibility = EndVisibility::kSeen;
  seam.accuracy.emplace();
  seam.accuracy->start = seam.accuracy->end = deviation * deviation * Eigen::Matrix3d::Identity();
  return seam;
}

Examination bounded(double least, double most) {
  Examination examination;
  examination.stripes = 30, examination.spacing = 3.6, examination.explained = 0.97;
  examination.ends[0].anchored = examination.ends[1].anchored = true;
  examination.ends[0].least = least, examination.ends[0].most = most;
  examination.ends[1].least = -0.3, examination.ends[1].most = 0.3;
  return examination;
}

double along(const Eigen::Matrix3d& covariance) { return std::sqrt(covariance(0, 0)); }

bool remarked(const SeamResult& seam, Code code) {
  for (const Reason& remark : seam.remarks)
    if (remark.code == code) return true;
  return false;
}

}  // namespace

TEST_CASE("an end within its bounds stays as it was claimed") {
  SeamResult seam = answer(0.1);
  rule(bounded(-0.4, 0.5), seam);
  CHECK(seam.start_visibility == EndVisibility::kSeen);
  CHECK(along(seam.accuracy->start) == Approx(0.1));
  CHECK(seam.remarks.empty());
  CHECK(seam.checked.stripes == 30);
  CHECK(seam.checked.explained == Approx(0.97));
  CHECK(seam.checked.worst == 0);
}

TEST_CASE("an end that may be farther off than it claims says so") {
  SeamResult seam = answer(0.1);
  rule(bounded(-0.4, 3), seam);
  CHECK(seam.start_visibility == EndVisibility::kSeen);
  CHECK(3 * along(seam.accuracy->start) == Approx(3));
  CHECK(std::sqrt(seam.accuracy->start(1, 1)) == Approx(0.1));  // across as before
  CHECK(remarked(seam, Code::kStartBounded));
  CHECK(along(seam.accuracy->end) == Approx(0.1));
}

TEST_CASE("an end outside its bounds is not determined, and lies where they say") {
  SeamResult seam = answer(0.1);
  rule(bounded(4, 6), seam);
  CHECK(seam.start_visibility == EndVisibility::kNotDetermined);
  CHECK(seam.accuracy->start(0, 0) == -1);
  CHECK(seam.start_second.place.x() == Approx(-5));  // outward of the start
  CHECK(seam.start_second.weight == 0.5);
  CHECK(seam.checked.worst == 4);
  CHECK(remarked(seam, Code::kStartContradicted));
  CHECK(seam.end_visibility == EndVisibility::kSeen);
}

TEST_CASE("an end that owns up to its error is not contradicted by it") {
  SeamResult seam = answer(2);
  rule(bounded(4, 6), seam);
  CHECK(seam.start_visibility == EndVisibility::kSeen);
  CHECK(along(seam.accuracy->start) == Approx(2));
}

TEST_CASE("an end that hardly anything bounds is not determined; a hidden one has no deviation") {
  SeamResult loose = answer(0.1);
  rule(bounded(-0.4, 20), loose);
  CHECK(loose.start_visibility == EndVisibility::kNotDetermined);
  CHECK(loose.start_second.weight == 0);
  SeamResult hidden = answer(0.1);
  hidden.start_visibility = EndVisibility::kHidden;
  rule(bounded(-0.4, 20), hidden);
  CHECK(hidden.start_visibility == EndVisibility::kHidden);
  CHECK(hidden.accuracy->start(0, 0) == -1);
  SeamResult unseen = answer(0.1);
  Examination nothing = bounded(0, 0);
  nothing.ends[0].anchored = false;
  rule(nothing, unseen);
  CHECK(remarked(unseen, Code::kStartNotShown));
}

TEST_CASE("a seam that is contradicted as a whole is refused, its alternatives kept") {
  SeamResult seam = answer(0.1);
  seam.alternatives.resize(2);
  Examination examination = bounded(0, 0);
  examination.contradiction = {Code::kPlateRound, 12};
  rule(examination, seam);
  CHECK(seam.verdict == SeamResult::Verdict::kRefused);
  CHECK(seam.reason.code == Code::kPlateRound);
  CHECK(seam.alternatives.size() == 2);
  CHECK(seam.checked.stripes == 30);
}

TEST_CASE("edges that lie beside the seam widen it across") {
  SeamResult seam = answer(0.1);
  Examination examination = bounded(0, 0);
  for (int j = 0; j < 2; ++j) {
    seam.faces[j].away = (j == 0 ? -1 : 1) * Eigen::Vector3d::UnitY();
    examination.edges[j].emplace();
    examination.edges[j]->known = true;
    examination.edges[j]->at_start = (j == 0 ? -0.6 : 0.6);  // both edges shifted to +y
  }
  rule(examination, seam);
  CHECK(std::sqrt(seam.accuracy->start(1, 1)) == Approx(std::hypot(0.1, 0.6)));
  CHECK(std::sqrt(seam.accuracy->end(1, 1)) == Approx(0.1));
  CHECK(along(seam.accuracy->start) == Approx(0.1));
}

TEST_CASE("edges that are turned against the seam widen its direction, those beside it do not") {
  for (const double at_end : {2.0, 0.6}) {
    SeamResult seam = answer(0.1);
    seam.accuracy->direction = 0.005;
    Examination examination = bounded(0, 0);
    for (int j = 0; j < 2; ++j) {
      seam.faces[j].away = (j == 0 ? -1 : 1) * Eigen::Vector3d::UnitY();
      examination.edges[j].emplace();
      examination.edges[j]->known = true;
      examination.edges[j]->at_start = (j == 0 ? -0.6 : 0.6);
      examination.edges[j]->at_end = (j == 0 ? -at_end : at_end);
    }
    rule(examination, seam);
    // Over 100 mm.
    const double turned = at_end > 1 ? 1.4 / 100 : 0;
    CHECK(seam.accuracy->direction == Approx(std::hypot(0.005, turned)));
  }
}
