// Slips in poses are named; sets in closed form, with an erring robot and an erring eye.
#include "services/calibration/stages/pose_slips.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/calibration/support/usual_pose_slips.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using Catch::Matchers::Contains;
using namespace arcstart::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

using Poses = std::vector<PairedPose>;

Target chessboard() {
  Target plate;
  plate.pattern = TargetPattern::chessboard;
  plate.columns = 9;
  plate.rows = 6;
  plate.pitch_mm = 12;
  return plate;
}

// A camera on a tool before a plate, both turned anyhow: 20 poses tilted to all sides, of which the
// fourth does not show the plate. The robot errs by 0.2 mm and 0.02 deg, the eye by 0.1 and 0.05.
struct Cell {
  RigidTransform T_tool_camera, T_base_plate;
  Poses poses;
};

Cell cell(unsigned seed, int count = 20) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-1, 1);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    return Vector3d(size * share(random), size * share(random), size * share(random));
  };
  const auto noise = [&](double mm, double deg) {
    const Vector3d turn = deg * kDegree * Vector3d(normal(random), normal(random), normal(random));
    return placed(about(turn.normalized(), turn.norm()),
                  mm * Vector3d(normal(random), normal(random), normal(random)));
  };
  Cell result;
  result.T_tool_camera = placed(about(vector(1).normalized(), 2.5 * share(random)), vector(120));
  result.T_base_plate = placed(about_z(3 * share(random)) * about_x(3.1 + 0.3 * share(random)),
                               Vector3d(900, 0, 50) + vector(200));
  for (int i = 0; i < count; ++i) {
    const double azimuth = 6.28 * (i + share(random)) / count;
    const Vector3d axis(std::cos(azimuth), std::sin(azimuth), 0);
    const Matrix3d turn = about(axis, 0.5 + 0.2 * share(random)) * about_z(1.5 * share(random));
    const RigidTransform T_camera_plate =
        placed(turn, Vector3d(0, 0, 300) + vector(60) - turn * Vector3d(48, 30, 0));
    PairedPose pose;
    pose.T_base_tool = result.T_base_plate * T_camera_plate.inverse() *
                       result.T_tool_camera.inverse() * noise(0.2, 0.02);
    if (i != 3) pose.T_camera_plate = T_camera_plate * noise(0.1, 0.05);
    result.poses.push_back(pose);
  }
  return result;
}

}  // namespace

TEST_CASE("right poses are not called a slip, few wrong ones either") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CHECK(pose_slip(chessboard(), cell(seed).poses).empty());
    Poses poses = cell(seed).poses;
    std::swap(poses[2].T_base_tool, poses[12].T_base_tool);
    poses[7].T_base_tool.translation().x() += 1500;
    CHECK(pose_slip(chessboard(), poses).empty());
    // A wrong pitch is no slip of the poses.
    poses = cell(seed).poses;
    for (PairedPose& pose : poses)
      if (pose.T_camera_plate) pose.T_camera_plate->translation() *= 1.5;
    CHECK(pose_slip(chessboard(), poses).empty());
  }
}

TEST_CASE("each usual slip of a pose is named as what it is") {
  for (const PoseSlip& slip : usual_pose_slips())
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Poses poses = cell(seed).poses;
      for (PairedPose& pose : poses) slip.change(pose.T_base_tool);
      INFO(slip.named << ", seed " << seed);
      CHECK_THAT(pose_slip(chessboard(), poses), Contains(slip.named));
    }
}

TEST_CASE("poses that stand with other images are named") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Poses right = cell(seed).poses;
    const std::size_t n = right.size();
    Poses next = right, last = right, reversed = right;
    for (std::size_t i = 0; i < n; ++i) {
      next[i].T_base_tool = right[(i + 1) % n].T_base_tool;
      last[i].T_base_tool = right[(i + n - 1) % n].T_base_tool;
      reversed[i].T_base_tool = right[n - 1 - i].T_base_tool;
    }
    CHECK_THAT(pose_slip(chessboard(), next), Contains("the pose before the one"));
    CHECK_THAT(pose_slip(chessboard(), last), Contains("the pose after the one"));
    CHECK_THAT(pose_slip(chessboard(), reversed), Contains("from the last to the first"));
  }
}

TEST_CASE("a plate on the robot before a camera that stands is named, and where it stands") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    // Camera and plate change places: what the camera sees of the plate is as before.
    const Cell right = cell(seed);
    Poses poses = right.poses;
    const RigidTransform T_base_camera = placed(about_x(2.8), Vector3d(1100, -300, 900));
    for (PairedPose& pose : poses)
      pose.T_base_tool =
          T_base_camera *
          (right.T_base_plate.inverse() * pose.T_base_tool * right.T_tool_camera).inverse() *
          placed(about_y(0.4), Vector3d(10, 30, 60)).inverse();
    CHECK_THAT(pose_slip(chessboard(), poses), Contains("eye-to-hand") &&
                                                   Contains("stands still") &&
                                                   Contains("more than a metre from base"));
  }
}

TEST_CASE("two slips at once are both named") {
  Poses poses = cell(3).poses;
  for (PairedPose& pose : poses) {
    pose.T_base_tool = pose.T_base_tool.inverse();
    pose.T_base_tool.translation() /= 1000;
  }
  CHECK_THAT(pose_slip(chessboard(), poses),
             Contains("base lies in the tool") && Contains("positions in metres"));
}

TEST_CASE("what no slip explains is refused without a number that nobody can use") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Poses poses = cell(seed).poses;
    const Poses other = cell(seed + 50).poses;  // of another day
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].T_base_tool = other[i].T_base_tool;
    CHECK_THAT(pose_slip(chessboard(), poses), Contains("None of the usual slips"));
  }
}
