#include "tests/bench/seam/wild/shrink.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/wild/wild_json.hpp"

namespace arcstart {

using cell_simulator::WildScene;
namespace {

using Json = nlohmann::json;
using Step = std::vector<std::string>;  // places in the scene that go together

// From the last, so that those to come keep their numbers.
void add_elements(const Json& scene, const std::string& list, std::size_t kept,
                  std::vector<Step>& steps) {
  for (std::size_t i = scene.at(Json::json_pointer(list)).size(); i > kept; --i)
    steps.push_back({list + "/" + std::to_string(i - 1)});
}

void add_plate(const Json& scene, const std::string& plate, std::vector<Step>& steps) {
  for (const char* list : {"/holes", "/notches"}) add_elements(scene, plate + list, 0, steps);
  for (const std::string cut : {"/begin", "/end"})
    for (const char* what :
         {"/cope_mm", "/wave_mm", "/chamfer_mm", "/round_mm", "/slant_deg", "/turn_deg"})
      steps.push_back({plate + cut + what});
  steps.push_back({plate + "/surface"});
  steps.push_back({plate + "/section"});
}

// In the order in which they are tried: first what tells most.
std::vector<Step> steps_of(const Json& scene) {
  std::vector<Step> steps;
  add_elements(scene, "/solids", 0, steps);
  add_elements(scene, "/works", 1, steps);
  steps.push_back({"/events"});
  steps.push_back({"/scan/robot_wave_mm", "/scan/calibration_error"});
  for (std::size_t i = 0; i < scene.at("works").size(); ++i) {
    const std::string work = "/works/" + std::to_string(i);
    for (const char* list : {"/beads", "/ribs", "/tabs"})
      add_elements(scene, work + list, 0, steps);
    steps.push_back({work + "/bow_mm"});
    steps.push_back({work + "/tilt_deg"});
    steps.push_back({work + "/gap_begin_mm", work + "/gap_end_mm"});
    steps.push_back({work + "/mismatch_begin_mm", work + "/mismatch_end_mm"});
    add_plate(scene, work + "/first", steps);
    add_plate(scene, work + "/second", steps);
    steps.push_back({work + "/yaw_deg"});
  }
  steps.push_back({"/table"});
  for (const char* what : {"/scan/lean_deg", "/scan/pitch_mm", "/scan/jitter_mm"})
    steps.push_back({what});
  return steps;
}

// What is not named has its plain value.
void take_away(const std::string& place, Json& scene) {
  const std::size_t slash = place.rfind('/');
  const std::string name = place.substr(slash + 1);
  const Json::json_pointer parent(place.substr(0, slash));
  if (!scene.contains(parent)) return;
  Json& in = scene.at(parent);
  if (in.is_array()) {
    if (const std::size_t index = std::stoul(name); index < in.size()) in.erase(index);
  } else {
    in.erase(name);
  }
}

}  // namespace

WildScene shrunk(const WildScene& scene, int tries,
                 const std::function<bool(const WildScene&)>& still) {
  WildScene best = scene;
  for (const Step& step : steps_of(Json::parse(to_json(scene)))) {
    if (tries <= 0) break;
    const std::string before = to_json(best);
    Json fewer = Json::parse(before);
    for (const std::string& place : step) take_away(place, fewer);
    const WildScene plainer = cell_simulator::wild_scene_from_json(fewer.dump());
    if (to_json(plainer) == before) continue;  // it was plain
    --tries;
    try {
      if (still(plainer)) best = plainer;
    } catch (const cell_simulator::SceneError&) {
      // Without that nothing can be built.
    }
  }
  return best;
}

}  // namespace arcstart
