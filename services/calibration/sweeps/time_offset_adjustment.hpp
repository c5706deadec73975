// The least-squares adjustment of a time offset, the robot's play and the faces seen.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "services/calibration/sweeps/flat_faces.hpp"
#include "services/calibration/sweeps/sweep_profiles.hpp"

namespace arcstart::calibration {

// A stripe's straight part, and when and in which sweep it was seen.
struct SweptPiece {
  std::size_t stripe, sweep;
  std::int64_t utime;
  StraightPiece in_camera;
};

struct OffsetState {
  double offset_s = 0, play_mm = 0;
  std::vector<FlatFace> faces;
};

struct OffsetAdjustment {
  OffsetState state;
  Eigen::MatrixXd covariance;  // offset, play, then two tilts and the offset of each face
  std::vector<double> sweep_deviation_mm;  // of a piece from its face, by its sweep
  std::vector<int> face_of;                // of each piece; -1 for none
  bool solved = false;
};

class OffsetProblem {
 public:
  // All that is given must outlive the problem.
  OffsetProblem(const SweepData& record, const RigidTransform& T_tool_camera,
                const std::vector<SweptPiece>& pieces, std::size_t sweeps)
      : record_(record), T_tool_camera_(T_tool_camera), pieces_(pieces), sweeps_(sweeps) {}

  // Every piece's points in base with an offset.
  std::vector<std::vector<MovingPoint>> carried(double offset_s) const;

  // play_deviation: standard deviation of the play before anything is seen; mm.
  OffsetAdjustment adjust(const OffsetState& start, double play_deviation) const;

 private:
  struct Row;
  std::vector<int> faces_of_pieces(const OffsetState& state, double gate) const;
  std::vector<double> deviations(const std::map<std::size_t, double>& height) const;
  std::vector<Row> rows(const OffsetState& state, const std::vector<int>& face_of) const;

  const SweepData& record_;
  const RigidTransform& T_tool_camera_;
  const std::vector<SweptPiece>& pieces_;
  std::size_t sweeps_;
};

}  // namespace arcstart::calibration
