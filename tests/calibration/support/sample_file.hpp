// A sound calibration file, and ways to damage it.
#pragma once

#include <string>

#include "common/configuration.hpp"

namespace arcstart::test {

// How it was judged; files of before end without it.
inline const std::string kVerdict = R"(verdict: passed
limits: [1, 0.15, 0.5, 0.4, 1.5, 0.0035]
poses: 20
forced_by: ""
)";

// Everything after the id's line.
inline const std::string kContent = R"(sensor: LASER0
robot: ROBOT0
tool: TCP1
made: 1750000000000000
origin: "simulator's truth"
width: 1600
height: 1200
camera_matrix: [2400, 2401.5, 799.5, 599.5]
distortion: [-0.1, 0.02, 0.0001, -0.0002, 0]
laser_plane: [0, 0.928, -0.3725801927102405, 111.77405781307215]
camera_position: [60, 5, 40]
camera_quaternion: [0.5, -0.5, 0.5, 0.5]
time_offset: -0.02732
camera_residual: -1
laser_plane_residual: 0.1
hand_eye_residual: -1
)" + kVerdict;

// As a maker of calibrations writes it: with the id of its content.
inline std::string with_id(const std::string& content) {
  return "# arcstart calibration\nid: " + fingerprint(content) + "\n" + content;
}

inline std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the sample holds no '" + old + "'");
  return text.replace(at, old.size(), by);
}

}  // namespace arcstart::test
