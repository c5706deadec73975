// Poses as controllers write them, against rotations worked out by hand.
#include "services/command_line/imports/pose_format.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace arcstart;
using namespace arcstart::command_line;
using Catch::Matchers::Contains;

namespace {

RigidTransform good(PoseFormat format, double unit_mm, const std::vector<double>& numbers) {
  std::string why;
  const RigidTransform pose = pose_of(format, unit_mm, numbers, why);
  CHECK(why.empty());
  return pose;
}

std::string why_not(PoseFormat format, const std::vector<double>& numbers) {
  std::string why;
  pose_of(format, 1, numbers, why);
  return why;
}

bool is(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& x, const Eigen::Vector3d& y,
        const Eigen::Vector3d& z) {
  Eigen::Matrix3d wanted;
  wanted << x, y, z;
  return (rotation - wanted).cwiseAbs().maxCoeff() < 1e-12;
}

const Eigen::Vector3d X = Eigen::Vector3d::UnitX(), Y = Eigen::Vector3d::UnitY(),
                      Z = Eigen::Vector3d::UnitZ();

}  // namespace

TEST_CASE("each format turns the tool's axes where its controller means") {
  const double h = std::sqrt(0.5);
  // A quarter turn about x: y goes to z.
  CHECK(is(good(PoseFormat::kWxyz, 1, {0, 0, 0, h, h, 0, 0}).linear(), X, Z, -Y));
  CHECK(is(good(PoseFormat::kXyzw, 1, {0, 0, 0, h, 0, 0, h}).linear(), X, Z, -Y));
  CHECK(is(good(PoseFormat::kRotvec, 1, {0, 0, 0, M_PI / 2, 0, 0}).linear(), X, Z, -Y));
  CHECK(is(good(PoseFormat::kWpr, 1, {0, 0, 0, 90, 0, 0}).linear(), X, Z, -Y));
  CHECK(is(good(PoseFormat::kMatrix, 1, {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0}).linear(), X, Z, -Y));
  CHECK(is(good(PoseFormat::kRotvec, 1, {0, 0, 0, 0, 0, 0}).linear(), X, Y, Z));
  // W first, then P, then R, about axes that stay: x to y to y; y to z to x to y ...
  CHECK(is(good(PoseFormat::kWpr, 1, {0, 0, 0, 90, 90, 0}).linear(), -Z, X, -Y));
  CHECK(is(good(PoseFormat::kWpr, 1, {0, 0, 0, 90, 0, 90}).linear(), Y, Z, X));
  CHECK(is(good(PoseFormat::kWpr, 1, {0, 0, 0, 0, 90, 90}).linear(), -Z, -X, Y));
  // tool0 of a FANUC arm with all joints at 0: its wrist points ahead, P is singular.
  CHECK(is(good(PoseFormat::kWpr, 1, {1085, 0, 1040, 180, -90, 0}).linear(), Z, -Y, X));
}

TEST_CASE("positions are carried to millimetres") {
  const Eigen::Vector3d wanted(25.4, -50.8, 254);
  CHECK(good(PoseFormat::kWpr, length_units().at("inch"), {1, -2, 10, 0, 0, 0})
            .translation()
            .isApprox(wanted, 1e-12));
  CHECK(good(PoseFormat::kMatrix, length_units().at("m"),
             {1, 0, 0, 0.0254, 0, 1, 0, -0.0508, 0, 0, 1, 0.254, 0, 0, 0, 1})
            .translation()
            .isApprox(wanted, 1e-12));
  CHECK(good(PoseFormat::kWxyz, length_units().at("mm"), {25.4, -50.8, 254, 1, 0, 0, 0})
            .translation()
            .isApprox(wanted, 1e-12));
}

TEST_CASE("numbers that are no pose of their format are told from one") {
  CHECK_THAT(why_not(PoseFormat::kWxyz, {0, 0, 0, 1, 0.1, 0, 0}), Contains("length 1.005, not 1"));
  CHECK_THAT(why_not(PoseFormat::kXyzw, {0, 0, 0, 0, 0, 0, 0}), Contains("length 0, not 1"));
  CHECK_THAT(why_not(PoseFormat::kRotvec, {0, 0, 0, 180, 0, 0}), Contains("wpr"));
  CHECK_THAT(why_not(PoseFormat::kMatrix, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0}),
             Contains("mirrors"));
  CHECK_THAT(why_not(PoseFormat::kMatrix, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0}),
             Contains("no rotation"));
  // Column by column: the position stands in the last row.
  CHECK_THAT(why_not(PoseFormat::kMatrix, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}),
             Contains("row by row"));
  CHECK(is_pose_size(PoseFormat::kMatrix, 12));
  CHECK(is_pose_size(PoseFormat::kMatrix, 16));
  CHECK_FALSE(is_pose_size(PoseFormat::kMatrix, 9));
  CHECK_FALSE(is_pose_size(PoseFormat::kWpr, 7));
  CHECK_FALSE(is_pose_size(PoseFormat::kXyzw, 6));
}

TEST_CASE("a header that contradicts format or unit is told, one that fits is not") {
  using Header = std::vector<std::string>;
  const Header wxyz{"utime", "x", "y", "z", "qw", "qx", "qy", "qz"};
  const Header xyzw{"utime", "X", "Y", "Z", "qx", "qy", "qz", "qw"};
  const Header wpr{"utime", "x_mm", "y_mm", "z_mm", "W_deg", "P_deg", "R_deg"};
  CHECK(header_error(PoseFormat::kWxyz, "mm", wxyz).empty());
  CHECK(header_error(PoseFormat::kXyzw, "m", xyzw).empty());
  CHECK(header_error(PoseFormat::kWpr, "mm", wpr).empty());
  CHECK_THAT(header_error(PoseFormat::kWxyz, "mm", xyzw),
             Contains("--pose-format xyzw") && Contains("not of wxyz"));
  CHECK_THAT(header_error(PoseFormat::kXyzw, "mm", wxyz), Contains("--pose-format wxyz"));
  CHECK_THAT(header_error(PoseFormat::kRotvec, "mm", wpr), Contains("--pose-format wpr"));
  CHECK_THAT(header_error(PoseFormat::kMatrix, "mm", wpr), Contains("--pose-format wpr"));
  CHECK_THAT(header_error(PoseFormat::kWpr, "m", wpr),
             Contains("x_mm is in mm") && Contains("--pose-units says m"));
  CHECK_THAT(header_error(PoseFormat::kRotvec, "mm",
                          {"utime", "x", "y", "z", "rx_deg", "ry_deg", "rz_deg"}),
             Contains("rx_deg is in deg") && Contains("wants rad"));
  CHECK_THAT(header_error(PoseFormat::kWxyz, "mm", {"time", "x", "y", "z", "qw", "qx", "qy", "qz"}),
             Contains("time, not utime"));
  CHECK_THAT(
      header_error(PoseFormat::kWxyz, "mm", {"utime", "y", "x", "z", "qw", "qx", "qy", "qz"}),
      Contains("utime,x,y,z,qw,qx,qy,qz"));
}
