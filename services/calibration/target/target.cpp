#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

std::vector<Eigen::Vector3d> Target::points() const {
  const bool staggered = pattern == TargetPattern::asymmetric_circles;
  std::vector<Eigen::Vector3d> result;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      result.push_back({pitch_mm * (staggered ? 2 * column + row % 2 : column), pitch_mm * row, 0});
  return result;
}

double Target::radius(int point) const {
  if (!has_circles()) return 0;
  return point == 0 && origin_dot_radius_mm > 0 ? origin_dot_radius_mm : radius_mm;
}

std::vector<std::vector<int>> Target::lines() const {
  const int step = pattern == TargetPattern::asymmetric_circles ? 2 : 1;
  std::vector<std::vector<int>> result;
  for (int row = 0; row < rows; ++row) {
    std::vector<int> line;
    for (int column = 0; column < columns; ++column) line.push_back(row * columns + column);
    if (line.size() >= 3) result.push_back(line);
  }
  for (int first = 0; first < step; ++first)
    for (int column = 0; column < columns; ++column) {
      std::vector<int> line;
      for (int row = first; row < rows; row += step) line.push_back(row * columns + column);
      if (line.size() >= 3) result.push_back(line);
    }
  return result;
}

int Target::symmetry() const {
  switch (pattern) {
    case TargetPattern::asymmetric_circles:
      return rows % 2 == 0 ? 2 : 1;  // with an odd number of rows a half turn is no other label
    case TargetPattern::circles:
      if (origin_dot_radius_mm > 0) return 1;
      return rows == columns ? 4 : 2;
    case TargetPattern::chessboard:
      if ((rows + columns) % 2 == 1) return 1;  // the first square's colour tells
      return rows == columns && rows % 2 == 0 ? 4 : 2;
  }
  return 1;
}

std::vector<int> turned_points(const Target& plate, int turns) {
  const int columns = plate.columns, rows = plate.rows;
  const bool half = turns * (4 / plate.symmetry()) == 2;
  std::vector<int> result;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      if (turns == 0)
        result.push_back(row * columns + column);
      else if (half)
        result.push_back((rows - 1 - row) * columns + columns - 1 - column);
      else if (turns == 1)  // square patterns alone
        result.push_back(column * columns + columns - 1 - row);
      else
        result.push_back((columns - 1 - column) * columns + row);
    }
  return result;
}

}  // namespace arcstart::calibration
