// Scenes of the wild: scripts/bench seam --wild.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "services/cell_simulator/wild/wild_scene.hpp"
#include "tests/bench/seam/seam_scenes.hpp"

namespace arcstart {

struct WildChoice {
  int profile_seeds = 100;  // scenes a joint, in closed form
  int rendered_seeds = 25;  // and in rendered images
  SeedsOfRow wanted;        // row: a joint of the wild
  bool referee = true;      // false: the rows are of answers as they were found
};

// Rows JOINT.wild: closed form through seam finding.
void bench_wild(const WildChoice& choice, nlohmann::json& json);

// Rows JOINT.wild.img: rendered images through the whole pipeline, with the referee.
void bench_rendered_wild(const WildChoice& choice, nlohmann::json& json);

// Rows falsified.* and true.*: what the referee makes of wrong and of right answers.
void bench_falsified(const WildChoice& choice, nlohmann::json& json);

// Rows wrong_part.*: each joint asked of so many scenes with clutter of each other joint.
void bench_pairs(const WildChoice& choice, int scenes, nlohmann::json& json);

// Draws scenes until the time is over, and keeps in build/bench/hunt/ each that is wrong in
// silence, made as plain as it can be, and the worst of the others.
void hunt(const WildChoice& choice, double minutes, nlohmann::json& json);

// Prints the answers to a scene that was kept, and their errors.
void show_scene(const std::string& path);

// The scenes of a joint. One that cannot be is told, and left out: draw or `use` throws SceneError.
void for_each_scene(const std::string& joint, int first, int count,
                    const std::function<void(const cell_simulator::WildScene&, int seed)>& use);

}  // namespace arcstart
