#include "services/calibration/files/calibration_set.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace arcstart;
using namespace arcstart::calibration;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

// A sound folder of three poses; images are not looked into when a set is read.
struct SetFolder {
  SetFolder() {
    fs::remove_all(root);
    fs::create_directories(root / "grid");
    fs::create_directories(root / "laser");
    write("plate.yaml",
          "pattern: asymmetric_circles\ncolumns: 5\nrows: 9\npitch_mm: 12\nradius_mm: 4\n");
    write("poses.csv",
          "index,x,y,z,qw,qx,qy,qz\n1,900,0,300,1,0,0,0\n2,950,10,310,0.6,0.8,0,0\n3,870,5,320,0,1,"
          "0,0\n");
    for (const char* name : {"0001.png", "0002.png", "0003.png"}) {
      write(std::string("grid/") + name, "");
      write(std::string("laser/") + name, "");
    }
  }
  ~SetFolder() { fs::remove_all(root); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(root / name) << text;
  }
  std::string error() const {
    try {
      read_calibration_set(root.string());
      return "";
    } catch (const CalibrationSetError& error) {
      const std::string what = error.what();
      CHECK(what.find('\n') == std::string::npos);  // one line
      return what;
    }
  }
  const fs::path root =
      fs::temp_directory_path() / ("arcstart_calibration_set_test_" + std::to_string(getpid()));
};

}  // namespace

TEST_CASE("a sound folder is read, poses by index") {
  const SetFolder folder;
  const CalibrationSet set = read_calibration_set(folder.root.string());
  REQUIRE(set.poses.size() == 3);
  CHECK(set.plate.pattern == TargetPattern::asymmetric_circles);
  CHECK(set.plate.points()[5] == Eigen::Vector3d(12, 12, 0));
  CHECK(set.poses[1].index == 2);
  CHECK_THAT(set.poses[1].laser, Contains("laser/0002.png"));
  CHECK(set.poses[1].T_base_tool.translation() == Eigen::Vector3d(950, 10, 310));
  // w, x = 0.6, 0.8: about x by 2 acos(0.6).
  CHECK(set.poses[1].T_base_tool.linear()(2, 1) == Approx(0.96));
  fs::rename(folder.root / "laser/0002.png", folder.root / "laser/0002.JPEG");
  fs::rename(folder.root / "grid/0003.png", folder.root / "grid/3.bmp");
  CHECK_THAT(read_calibration_set(folder.root.string()).poses[1].laser, Contains("0002.JPEG"));
  fs::remove_all(folder.root / "laser");
  CHECK(read_calibration_set(folder.root.string()).poses[1].laser == set.poses[1].grid);
}

TEST_CASE("what is missing or does not pair is said in one line") {
  const SetFolder folder;
  CHECK_THROWS_WITH(read_calibration_set("/nowhere/at/all"), Contains("is no folder"));
  SECTION("no plate") {
    fs::remove(folder.root / "plate.yaml");
    CHECK_THAT(folder.error(), Contains("plate.yaml: is missing"));
  }
  SECTION("no poses") {
    fs::remove(folder.root / "poses.csv");
    CHECK_THAT(folder.error(), Contains("poses.csv: is missing"));
  }
  SECTION("no images") {
    fs::remove_all(folder.root / "grid");
    CHECK_THAT(folder.error(), Contains("grid: is missing"));
  }
  SECTION("a pose without an image") {
    fs::remove(folder.root / "grid/0002.png");
    CHECK_THAT(folder.error(), Contains("pose 2") && Contains("grid/0002.png"));
  }
  SECTION("an image without a pose") {
    folder.write("grid/0009.png", "");
    CHECK_THAT(folder.error(), Contains("grid/0009.png has no pose 9"));
  }
  SECTION("a laser image missing") {
    fs::remove(folder.root / "laser/0003.png");
    CHECK_THAT(folder.error(), Contains("laser/0003.png"));
  }
  SECTION("an image without a number") {
    folder.write("grid/first.png", "");
    CHECK_THAT(folder.error(), Contains("is not named after its pose"));
  }
}

TEST_CASE("numbers that cannot be, and slips of units, are recognised") {
  const SetFolder folder;
  const auto poses = [&](const std::string& text) {
    folder.write("poses.csv", text);
    return folder.error();
  };
  CHECK_THAT(poses("1,0.9,0,0.3,1,0,0,0\n2,0.95,0,0.3,1,0,0,0\n"), Contains("in metres"));
  CHECK_THAT(poses("1,900,0,300,1,1,0,0\n"), Contains("length") && Contains(":1:"));
  CHECK_THAT(poses("1,900,0,300,1,0,0\n"), Contains("7 numbers"));
  CHECK_THAT(poses("1,900,zero,300,1,0,0,0\n"), Contains("'zero' is no number"));
  CHECK_THAT(poses("1,900,,300,1,0,0,0\n"), Contains("is no number"));
  CHECK_THAT(poses("1,900,nan,300,1,0,0,0\n"), Contains("is no number"));
  CHECK_THAT(poses("1,900,0,300,1,0,0,0\n1,900,0,300,1,0,0,0\n"), Contains("twice"));
  CHECK_THAT(poses("index,x,y,z,qw,qx,qy,qz\n"), Contains("holds no pose"));
  const auto plate = [&](const std::string& text) {
    folder.write("plate.yaml", text);
    return folder.error();
  };
  CHECK_THAT(plate("pattern: circles\ncolumns: 5\nrows: 9\npitch_mm: 0.012\nradius_mm: 0.004\n"),
             Contains("in metres"));
  CHECK_THAT(plate("pattern: circles\ncolumns: 5\nrows: 9\npitch_mm: 12\nradius_mm: 8\n"),
             Contains("not the diameter"));
  CHECK_THAT(plate("pattern: circles\ncolumns: 5\nrows: 9\npitch_mm: 12\n"),
             Contains("radius_mm is missing"));
  CHECK_THAT(plate("pattern: hexagons\ncolumns: 5\nrows: 9\npitch_mm: 12\n"), Contains("one of"));
  CHECK_THAT(plate("pattern: chessboard\ncolumns: 5\npitch_mm: 12\n"), Contains("all be given"));
  CHECK_THAT(plate("patern: chessboard\n"), Contains("patern"));
  CHECK_THAT(plate("[1, 2]\n"), Contains("map of keys"));
  CHECK_THAT(plate("a: [\n"), Contains("not YAML"));
}
