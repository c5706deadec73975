// The calibration plate: which points it carries and where they lie.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace arcstart::calibration {

enum class TargetPattern { circles, asymmetric_circles, chessboard };

// Plate frame: origin in the first point, x along a row, y from row to row, z into the plate.
struct Target {
  TargetPattern pattern = TargetPattern::circles;
  int columns = 0, rows = 0;        // points along a row, and rows; a chessboard's inner corners
  double pitch_mm = 0;              // OpenCV's square size: between rows; between columns too,
                                    // but for asymmetric circles, whose columns stand at twice that
  double radius_mm = 0;             // of the circles
  double origin_dot_radius_mm = 0;  // of the first circle where it is larger, else 0

  bool has_circles() const { return pattern != TargetPattern::chessboard; }
  int size() const { return columns * rows; }

  // Row by row, in plate; mm.
  std::vector<Eigen::Vector3d> points() const;

  // Of a point's circle; 0 for a corner. mm
  double radius(int point) const;

  // Points on one straight line, at least three, by their numbers: rows and columns.
  std::vector<std::vector<int>> lines() const;

  // How many turns about z leave the pattern as it is: 1 where it is unambiguous, else 2 or 4.
  int symmetry() const;
};

// The points' numbers after turns of 360 / symmetry deg: what was seen as point i is point
// result[i] of the turned plate.
std::vector<int> turned_points(const Target& plate, int turns);

}  // namespace arcstart::calibration
