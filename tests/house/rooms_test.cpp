// The code keeps to the rooms of services/rooms.txt; and trees that break each rule are seen.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "paths.hpp"
#include "tests/house/house_rules.hpp"
#include "tests/house/room_list.hpp"

using namespace arcstart::test;
namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

namespace {

// A small checkout of its own, gone with its owner.
class Tree {
 public:
  Tree() {
    std::string name = (fs::temp_directory_path() / "house-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    root_ = name;
    add("services/rooms.txt",
        "# top down\n"
        "order: command_line seam_finding calibration extraction\n"
        "common: .\n"
        "seam_finding: main* . scan find_seam* planes fit\n"
        "extraction: .\n"
        "cell_simulator: .\n"
        "cell_simulator uses of common: bus geometry\n");
    for (const char* file :
         {"common/bus.hpp", "services/cell_simulator/main.cpp", "services/extraction/main.cpp",
          "services/seam_finding/main.cpp", "services/seam_finding/seam_finding_app.hpp",
          "services/seam_finding/scan/store.hpp", "services/seam_finding/find_seam.hpp",
          "services/seam_finding/planes/planes.hpp", "services/seam_finding/fit/line_fit.hpp"})
      add(file, "#include <vector>\n#include \"yaml-cpp/yaml.h\"\n");
  }
  ~Tree() { fs::remove_all(root_); }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  void add(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  // A file of one include, in its second line.
  void include(const std::string& path, const std::string& target) const {
    add(path, "#pragma once\n  #  include \"" + target + "\"  // why\n");
  }
  const fs::path& root() const { return root_; }

 private:
  fs::path root_;
};

}  // namespace

TEST_CASE("includes run down through the rooms") {
  const Tree tree;
  CHECK(wrong_includes(tree.root()) == Lines{});

  const std::string service = "services/seam_finding/";
  tree.include(service + "main.cpp", service + "seam_finding_app.hpp");
  tree.include(service + "seam_finding_app.cpp", service + "scan/store.hpp");
  tree.include(service + "scan/store.cpp", service + "find_seam.hpp");
  tree.include(service + "find_seam.cpp", service + "fit/line_fit.hpp");
  tree.include(service + "planes/deep/inside.cpp", "services/seam_finding/planes/planes.hpp");
  tree.include(service + "fit/line_fit.cpp", "common/bus.hpp");
  CHECK(wrong_includes(tree.root()) == Lines{});

  SECTION("up") {
    tree.include(service + "fit/line_fit.hpp", service + "planes/planes.hpp");
    CHECK(wrong_includes(tree.root()) ==
          Lines{service + "fit/line_fit.hpp:2: includes \"" + service +
                "planes/planes.hpp\": fit lies below planes"});
  }
  SECTION("up, by a name without its path") {
    tree.include(service + "find_seam.hpp", "scan/store.hpp");
    CHECK(wrong_includes(tree.root()) == Lines{service + "find_seam.hpp:2: includes \"" + service +
                                               "scan/store.hpp\": find_seam* lies below scan"});
  }
  SECTION("from a room to the service's own folder") {
    tree.include(service + "planes/planes.cpp", service + "seam_finding_app.hpp");
    CHECK(wrong_includes(tree.root()) ==
          Lines{service + "planes/planes.cpp:2: includes \"" + service +
                "seam_finding_app.hpp\": planes lies below ."});
  }
}

TEST_CASE("every file lies in a room, and every room holds files") {
  const Tree tree;
  tree.add("services/seam_finding/attic/box.cpp", "");
  tree.add("services/seam_finding/attic/chest.cpp", "");
  tree.add("services/console/main.cpp", "");
  fs::remove_all(tree.root() / "services/seam_finding/planes");
  CHECK(wrong_includes(tree.root()) ==
        Lines{"services/console/main.cpp: services/rooms.txt does not list its room",
              "services/seam_finding/attic/box.cpp: services/rooms.txt does not list its room",
              "services/rooms.txt: seam_finding: planes holds no file"});
}

TEST_CASE("services use services below them, and none of their apps") {
  const Tree tree;
  tree.add("services/rooms.txt",
           "order: command_line seam_finding extraction\ncommon: .\ncommand_line: .\n"
           "seam_finding: . scan planes fit\nextraction: .\ncell_simulator: .\n"
           "cell_simulator uses of common: bus geometry\n");
  const std::string app = "services/extraction/extraction_app.hpp",
                    ridge = "services/extraction/ridge.hpp";
  tree.include("services/command_line/main.cpp", app);
  tree.include("services/seam_finding/main.cpp", ridge);
  tree.include("services/cell_simulator/main.cpp", "common/bus.hpp");
  CHECK(wrong_includes(tree.root()) == Lines{});

  const auto broken = [&](const std::string& path, const std::string& target) {
    tree.include(path, target);
    const Lines lines = wrong_includes(tree.root());
    REQUIRE(lines.size() == 1);
    const std::string start = path + ":2: includes \"" + target + "\": ";
    REQUIRE(lines.front().starts_with(start));
    return lines.front().substr(start.size());
  };
  SECTION("up") {
    CHECK(broken("services/extraction/main.cpp", "services/seam_finding/scan/store.hpp") ==
          "extraction does not lie above seam_finding");
  }
  SECTION("beside the order") {
    CHECK(broken("services/cell_simulator/main.cpp", ridge) ==
          "cell_simulator does not lie above extraction");
  }
  SECTION("what stands beside the order is used by none") {
    CHECK(broken("services/command_line/main.cpp", "services/cell_simulator/scene.hpp") ==
          "command_line does not lie above cell_simulator");
  }
  SECTION("another's app") {
    CHECK(broken("services/seam_finding/main.cpp", app) == "it is another service's app");
  }
  SECTION("common uses no service") {
    CHECK(broken("common/bus.cpp", ridge) == "common uses no service");
  }
  SECTION("more of common than is allowed") {
    CHECK(broken("services/cell_simulator/main.cpp", "common/sensor_model.hpp") ==
          "cell_simulator may not use it");
  }
  SECTION("tests") {
    CHECK(broken("services/extraction/main.cpp", "tests/house/house_rules.hpp") ==
          "only tests may use tests");
  }
}

TEST_CASE("circles of components are reported whole") {
  const Tree tree;
  const std::string folder = "services/extraction/";
  tree.include(folder + "ridge.cpp", folder + "ridge.hpp");  // a component is no circle
  tree.include(folder + "ridge.hpp", folder + "linking.hpp");
  tree.include(folder + "linking.hpp", "common/bus.hpp");
  CHECK(circles(tree.root()) == Lines{});
  // Of the header of one and the .cpp of the other: the compiler does not mind.
  tree.include(folder + "linking.cpp", folder + "ridge.hpp");
  CHECK(circles(tree.root()) ==
        Lines{folder + "linking -> " + folder + "ridge -> " + folder + "linking"});
  tree.include(folder + "linking.cpp", folder + "selection.hpp");
  tree.include(folder + "selection.hpp", folder + "ridge.hpp");
  CHECK(circles(tree.root()) == Lines{folder + "linking -> " + folder + "selection -> " + folder +
                                      "ridge -> " + folder + "linking"});
}

TEST_CASE("a folder of more than 24 sources is reported") {
  const Tree tree;
  for (int i = 0; i < 24; ++i) tree.add("tests/common/t" + std::to_string(i) + ".cpp", "");
  tree.add("tests/common/CMakeLists.txt", "");
  tree.add("tests/common/udpm/t.cpp", "");
  CHECK(crowded_folders(tree.root()) == Lines{});
  tree.add("tests/common/t.hpp", "");
  CHECK(crowded_folders(tree.root()) == Lines{"tests/common: holds 25 source files, more than 24"});
}

TEST_CASE("a list that cannot be read is no house in order") {
  const Tree tree;
  for (const char* text : {"", "extraction: .\n", "order: a b\nextraction .\n", "order:\n",
                           "order: a\na: .\na: . b\n"}) {
    INFO(text);
    tree.add("services/rooms.txt", text);
    CHECK_THROWS_AS(wrong_includes(tree.root()), RoomListError);
  }
  fs::remove(tree.root() / "services/rooms.txt");
  CHECK_THROWS_AS(wrong_includes(tree.root()), RoomListError);
}

TEST_CASE("the house is in order") {
  const fs::path root = ARCSTART_SOURCE;
  for (const auto& rule : {wrong_includes, circles, crowded_folders})
    for (const std::string& line : rule(root)) FAIL_CHECK(line);
}
