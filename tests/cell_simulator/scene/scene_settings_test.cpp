#include "services/cell_simulator/scene/scene_settings.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <sstream>

#include "services/cell_simulator/image/sensor_settings.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;
using Catch::Matchers::Contains;

TEST_CASE("scene and sensor settings are read and checked, and their keys do not collide") {
  struct Both {
    SceneSettings scene;
    SensorSettings sensor;
    void visit(SectionReader& visitor) { scene.visit(visitor), sensor.visit(visitor); }
    void visit(SectionWriter& visitor) { scene.visit(visitor), sensor.visit(visitor); }
  };
  const auto read = [](const std::string& line) {
    return Configuration::from_text("cell_simulator:\n  " + line + "\n", "cell.yaml")
        .read<Both>("cell_simulator");
  };
  CHECK(read("yaw_range_deg: 3").scene.yaw_range_deg == 3);
  CHECK(read("distortion: [0, 1, 2, 3, 4]").sensor.distortion[3] == 3);
  CHECK_THROWS_WITH(read("base_plate_mm: [1, 0, 3]"),
                    Contains("cell.yaml:2") && Contains("greater than 0"));
  CHECK_THROWS_WITH(read("speckle: 3"), Contains("speckle"));
  CHECK_THROWS_WITH(read("sheet_sigma_mm: 0"), Contains("sheet_sigma_mm"));

  // Written and read again nothing changes; every key stands once.
  Both changed;
  changed.scene.stl_files = {"a b.stl"};
  changed.scene.stl_poses = {1, 2, 3, 4, 5, 6.5};
  changed.sensor.image_width_px = 400;
  const std::string text = write_settings("cell_simulator", changed);
  const Both again = Configuration::from_text(text, "text").read<Both>("cell_simulator");
  CHECK(write_settings("cell_simulator", again) == text);
  CHECK(again.scene.stl_poses == changed.scene.stl_poses);
  std::set<std::string> keys;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    CHECK(keys.insert(line.substr(0, line.find(':'))).second);
}
