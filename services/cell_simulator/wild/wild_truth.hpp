// What is true of the seams in a scene of the wild, in base: mm and rad.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace arcstart::cell_simulator {

// One end of a seam.
struct WildEnd {
  Eigen::Vector3d point;  // on the seam's line, where the first of the plates ends
  int plate = 0;          // which of the two that is; 2: both within 0.05 mm
  // The edge of each plate's face there, through its point on the seam, away from the seam, unit;
  // and how far the real edge leaves that line: waves.
  std::array<Eigen::Vector3d, 2> edge_points, edge_directions;
  std::array<double, 2> edge_play_mm{};
  double play_mm = 0;  // along the seam: how far off an end may rightly be told, where edge or
                       // seam is no sharp line (chamfers, radii, waves, unlike cuts of a groove)
};

struct WildSeam {
  std::string
      joint_type;  // what may rightly be answered: tee, corner, outside_corner, lap, butt, v
  WildEnd start, end;
  Eigen::Vector3d direction;               // unit, start to end, in the search's sense
  std::array<Eigen::Vector3d, 2> normals;  // out of the metal, at the start; first plate first
  double angle = 0;                   // between the open sides; of a groove, between its slants
  double gap_start = 0, gap_end = 0;  // between the plates, at the seam's ends
  double mismatch_start = 0, mismatch_end = 0;  // second plate's top above the first's
  double thickness = -1;                        // of a lap's upper plate with its gap; else -1
  double bow_mm = 0;    // largest distance of the seam from the line through its ends
  double reach_mm = 8;  // how far from the seam's line both plates' faces can be seen
  std::array<int, 2> objects{-1, -1};  // of its plates, in Scene::objects()
};

struct WildTruth {
  std::vector<WildSeam> seams;  // of the asked type; each is a right answer
  bool wrong = false;           // there is none
};

}  // namespace arcstart::cell_simulator
