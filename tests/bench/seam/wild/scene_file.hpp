// Scenes of the wild that are kept with what was wrong with their answers.
#pragma once

#include <string>
#include <vector>

#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart {

struct KeptScene {
  cell_simulator::WildScene scene;
  std::string joint_type;           // the setting that was asked for
  std::string drawn_from;           // JOINT-SEED
  std::vector<std::string> silent;  // what was wrong; empty: nothing
  double ratio = 0;                 // error over deviation
};

// Throws std::runtime_error where it cannot be written or read, SceneError where it is no scene.
// A file that holds a scene alone is one, too.
void write_scene(const KeptScene& kept, const std::string& path);
cell_simulator::WildScene read_scene(const std::string& path);

}  // namespace arcstart
