// A scene of the wild as JSON, by the names of its fields, so that a file shows it again even where
// the drawing has changed. What is left out has its plain value.
#pragma once

#include <string>

#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::cell_simulator {

std::string to_json(const WildScene& scene);

// Throws SceneError, with what is wrong, where it is no JSON or holds an unknown key or a value of
// a wrong kind.
WildScene wild_scene_from_json(const std::string& text);

}  // namespace arcstart::cell_simulator
