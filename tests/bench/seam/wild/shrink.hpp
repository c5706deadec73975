// Makes a scene of the wild as plain as it can be while something stays true of it.
#pragma once

#include <functional>

#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart {

// Takes away elements of lists and sets what may be plain to its plain value, one after the other,
// at most `tries` times, and leaves away what `still` holds without. Where `still` throws
// SceneError it does not hold.
cell_simulator::WildScene shrunk(
    const cell_simulator::WildScene& scene, int tries,
    const std::function<bool(const cell_simulator::WildScene&)>& still);

}  // namespace arcstart
