#include "tests/bench/seam/wild/judgement.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace arcstart;
using cell_simulator::WildSeam;
using cell_simulator::WildTruth;
using Eigen::Vector3d;

namespace {

// Along x, the first plate level, the second upright.
WildTruth level_tee() {
  WildSeam seam;
  seam.joint_type = "tee";
  seam.start.point = {900, 0, 10};
  seam.end.point = {1000, 0, 10};
  seam.direction = Vector3d::UnitX();
  seam.normals = {Vector3d::UnitZ(), -Vector3d::UnitY()};
  WildTruth truth;
  truth.seams.push_back(seam);
  return truth;
}

// The truth with a deviation of 0.1 mm and 0.1 deg in everything.
seam_t true_answer() {
  const double degree = M_PI / 180;
  seam_t seam{};
  seam.verdict = seam_t::FOUND;
  seam.joint_type = "tee";
  const double start[] = {900, 0, 10}, end[] = {1000, 0, 10}, direction[] = {1, 0, 0};
  std::copy(start, start + 3, seam.start);
  std::copy(end, end + 3, seam.end);
  std::copy(direction, direction + 3, seam.direction);
  seam.normals[0][2] = 1;
  seam.normals[1][1] = -1;
  for (int i = 0; i < 3; ++i) seam.start_covariance[i][i] = seam.end_covariance[i][i] = 0.01;
  seam.direction_deviation = 0.1 * degree;
  seam.normal_deviations[0] = seam.normal_deviations[1] = 0.1 * degree;
  seam.start_visibility = seam.end_visibility = seam_t::SEEN;
  return seam;
}

using Where = SilentError::Where;

}  // namespace

TEST_CASE("the truth is right and nothing of it silent") {
  const WildJudgement judgement = judge(true_answer(), level_tee());
  CHECK(judgement.right);
  CHECK(judgement.silent.empty());
  CHECK(judgement.worst_ratio == 0);
  CHECK(judgement.start.deviation == Approx(0.1));
}

TEST_CASE("an end that is off by more than three deviations and than matters is silent") {
  seam_t seam = true_answer();
  seam.start[0] += 1.1;
  CHECK(judge(seam, level_tee()).silently(Where::kStart));
  seam.start_visibility = seam_t::NOT_DETERMINED;  // its deviation counts all the same
  CHECK(judge(seam, level_tee()).silently(Where::kStart));
  seam.start_covariance[0][0] = 0.16;
  CHECK_FALSE(judge(seam, level_tee()).silently(Where::kStart));

  seam = true_answer();
  seam.end[0] -= 0.9;
  CHECK(judge(seam, level_tee()).silent.empty());
  seam.end[2] += 0.6;
  CHECK(judge(seam, level_tee()).silently(Where::kEnd));
  for (auto& row : seam.end_covariance) std::fill(std::begin(row), std::end(row), -1);
  CHECK(judge(seam, level_tee()).silent.empty());
}

TEST_CASE("what the truth leaves open along the seam is no error") {
  WildTruth truth = level_tee();
  truth.seams[0].start.play_mm = 0.5;
  seam_t seam = true_answer();
  seam.start[0] += 1.4;
  CHECK(judge(seam, truth).silent.empty());
  seam.start[0] += 0.2;
  CHECK(judge(seam, truth).silently(Where::kStart));
}

TEST_CASE("what is within the robot's own error is silent, but marked") {
  seam_t seam = true_answer();
  seam.start[1] += 0.7;
  CHECK_FALSE(judge(seam, level_tee()).by_robot);
  CHECK_FALSE(judge(seam, level_tee(), 0.1).by_robot);  // 0.7 - 0.14 mm
  const WildJudgement by_robot = judge(seam, level_tee(), 0.4);
  CHECK(by_robot.by_robot);
  CHECK(by_robot.silently(Where::kStart));
  seam.end[0] += 5;
  CHECK_FALSE(judge(seam, level_tee(), 0.4).by_robot);
}

TEST_CASE("bent plates are not judged in height") {
  seam_t seam = true_answer();
  seam.start[2] += 0.7;
  WildTruth truth = level_tee();
  CHECK(judge(seam, truth).silently(Where::kStart));
  truth.seams[0].bow_mm = 0.5;
  CHECK(judge(seam, truth).silent.empty());
  seam.start[1] += 0.7;
  CHECK(judge(seam, truth).silently(Where::kStart));
}

TEST_CASE("direction, normals and stations are judged") {
  seam_t seam = true_answer();
  const double by = 1.2 * M_PI / 180;
  seam.direction[0] = std::cos(by), seam.direction[1] = std::sin(by);
  CHECK(judge(seam, level_tee()).silently(Where::kElse));

  seam = true_answer();
  seam.normals[0][2] = std::cos(2 * by), seam.normals[0][1] = std::sin(2 * by);
  CHECK(judge(seam, level_tee()).silently(Where::kElse));
  seam.normal_deviations[0] = by;
  CHECK(judge(seam, level_tee()).silent.empty());

  seam = true_answer();
  std::swap(seam.normals[0], seam.normals[1]);  // either order of the plates
  CHECK(judge(seam, level_tee()).silent.empty());

  seam_station_t station{};
  station.distance = 40;
  station.position[0] = 940, station.position[1] = 0.6, station.position[2] = 10;
  seam.stations.push_back(station);
  CHECK(judge(seam, level_tee()).silently(Where::kElse));
}

TEST_CASE("another seam, or one where there is none, is wrong") {
  seam_t seam = true_answer();
  for (double* end : {seam.start, seam.end}) end[1] += 8;
  const WildJudgement beside = judge(seam, level_tee());
  CHECK(beside.found);
  CHECK_FALSE(beside.right);
  CHECK(beside.silently(Where::kElse));
  const WildTruth none{{}, true};
  CHECK_FALSE(judge(true_answer(), none).right);
  seam_t refused{};
  refused.verdict = seam_t::REFUSED;
  CHECK_FALSE(judge(refused, none).found);
  CHECK(judge(refused, none).silent.empty());

  // Of two workpieces either.
  WildTruth both = level_tee();
  both.seams.push_back(both.seams[0]);
  for (auto* end : {&both.seams[0].start, &both.seams[0].end}) end->point.y() += 60;
  const WildJudgement second = judge(true_answer(), both);
  CHECK(second.right);
  CHECK(second.seam == 1);
}
