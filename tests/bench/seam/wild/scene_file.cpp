#include "tests/bench/seam/wild/scene_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/wild/wild_json.hpp"

namespace arcstart {

using Json = nlohmann::json;

void write_scene(const KeptScene& kept, const std::string& path) {
  const Json file{{"joint_type", kept.joint_type},
                  {"drawn_from", kept.drawn_from},
                  {"silent", kept.silent},
                  {"ratio", kept.ratio},
                  {"scene", Json::parse(to_json(kept.scene))}};
  if (!(std::ofstream(path) << file.dump(1) << '\n'))
    throw std::runtime_error(path + " cannot be written");
}

cell_simulator::WildScene read_scene(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  std::stringstream text;
  text << file.rdbuf();
  const Json json = Json::parse(text.str(), nullptr, false);
  if (json.is_discarded()) throw cell_simulator::SceneError(path + " is no JSON");
  return cell_simulator::wild_scene_from_json(json.contains("scene") ? json.at("scene").dump()
                                                                     : text.str());
}

}  // namespace arcstart
