// What the camera sees of the laser's sheet in one pose, exactly: straight pieces on the scene's
// triangles, in the order of the sheet's rays.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/cell_simulator/image/laser_fan.hpp"
#include "services/cell_simulator/image/sensor_camera.hpp"

namespace arcstart::seam_finding::synthetic {

// From begin to end, in base (mm) and in the image (px, distorted).
struct WildPiece {
  Eigen::Vector3d begin, end;
  Eigen::Vector2d begin_px, end_px;
  int object;              // in Scene::objects(); -1: something on the tool
  Eigen::Vector3d normal;  // of the triangle
  bool ghost = false;      // lit by what another surface mirrors
  bool in_band = false;    // of its object, where that answers light in another way
};

// on_tool: what is before the sensor, in camera; nullptr: nothing. Ghosts come last, those that at
// least `ghost_share` of the light makes; 1: none.
std::vector<WildPiece> seen_pieces(const cell_simulator::Scene& scene,
                                   const cell_simulator::TrueSensor& sensor,
                                   const RigidTransform& T_base_tool,
                                   const cell_simulator::Scene* on_tool, double ghost_share);

}  // namespace arcstart::seam_finding::synthetic
