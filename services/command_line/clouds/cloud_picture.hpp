// A point cloud as a picture: background, plates, seam and start in colours, from two sides.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/input_error.hpp"

namespace arcstart::command_line {

class PictureError : public InputError {
 public:
  using InputError::InputError;
};

// All in one frame, mm.
struct CloudPicture {
  std::vector<Eigen::Vector3d> background;             // grey
  std::vector<Eigen::Vector3d> others;                 // neither background nor plate: dark yellow
  std::array<std::vector<Eigen::Vector3d>, 2> plates;  // blue, green
  using Segment = std::pair<Eigen::Vector3d, Eigen::Vector3d>;
  std::optional<Segment> seam;                    // red, its first point (the start) as a disc
  std::vector<Segment> alternatives;              // thin, magenta
  std::optional<Segment> truth;                   // thin, white
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // upwards in the picture
  Eigen::Vector3d toward_viewer = {0.3, -1.0,
                                   0.9};  // of the left view; the right one is turned by 90 deg
  std::string title;
};

// Writes an image (the format by the ending, PNG is meant) of 1800 x 900 px. Throws
// std::runtime_error where it cannot be written.
void draw_cloud(const CloudPicture& picture, const std::string& path);

}  // namespace arcstart::command_line
