// Calibration sets of other programs, in each of the forms that are read, and what cannot be.
#include "services/command_line/imports/calibration_source.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "services/calibration/files/calibration_set.hpp"
#include "services/command_line/imports/import_error.hpp"
#include "tests/command_line/support/scan_files.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr const char* kPlate = "pattern: chessboard\ncolumns: 7\nrows: 6\npitch_mm: 10\n";

// Images are not looked into.
void write_images(const std::string& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) write_text(folder + "/" + name, "");
}

calibration::CalibrationSet imported(const Folder& folder, const PoseConvention& convention,
                                     const std::string& plate = "") {
  std::vector<std::string> notes;
  write_calibration_folder(read_calibration_source(folder / "from", plate, convention, notes),
                           folder / "to");
  return calibration::read_calibration_set(folder / "to");
}

std::string complaint(const Folder& folder, const PoseConvention& convention) {
  try {
    imported(folder, convention);
    return "";
  } catch (const InputError& error) {
    CHECK_FALSE(fs::exists(folder / "to"));
    CHECK_FALSE(fs::exists(folder / "to.part"));
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error.what();
  }
}

void write_plate(const Folder& folder) {
  fs::create_directories(folder / "from");
  write_text(folder / "from/plate.yaml", kPlate);
}

}  // namespace

TEST_CASE("a table of poses in another convention, and images of several kinds") {
  const Folder folder;
  fs::create_directories(folder / "from/grid");
  fs::create_directories(folder / "from/laser");
  write_text(folder / "from/plate.yaml", kPlate);
  write_text(folder / "from/poses.csv",
             "index,x,y,z,w,p,r\n2,10,-20,30,0,0,90\n7,12,0,31,90,0,0\n");
  write_images(folder / "from/grid", {"plate_2.JPG", "plate_0007.bmp", "plate_9.tif"});
  write_images(folder / "from/laser", {"2.jpeg", "7.tiff"});
  const auto set = imported(folder, {"wpr", "inch"});
  REQUIRE(set.poses.size() == 2);
  CHECK(set.poses[0].index == 2);
  CHECK(set.poses[0].T_base_tool.translation().isApprox(Eigen::Vector3d(254, -508, 762)));
  // Turned by 90 deg about z: x goes to y. About x: y goes to z.
  CHECK((set.poses[0].T_base_tool.linear().col(0) - Eigen::Vector3d::UnitY()).norm() < 1e-9);
  CHECK((set.poses[1].T_base_tool.linear().col(1) - Eigen::Vector3d::UnitZ()).norm() < 1e-9);
  CHECK_THAT(set.poses[0].grid, Contains("grid/0002.JPG"));
  CHECK_THAT(set.poses[1].laser, Contains("laser/0007.tiff"));
  CHECK(fs::read_symlink(set.poses[1].grid) == fs::canonical(folder / "from/grid/plate_0007.bmp"));
}

TEST_CASE("a file a pose, beside its image or in a folder of its own, with names or without") {
  SECTION("beside, in brackets") {
    const Folder folder;
    fs::create_directories(folder / "from");
    write_text(folder / "board.yaml", kPlate);
    write_text(folder / "from/pose0001.txt", "((1.36, 0.0335, 1.48), (0.6, 0.0, 0.0, 0.8))");
    write_text(folder / "from/pose0012.txt", "((1.43, +0.197, 1.46), (0.0, 0.0, 0.0, 1.0))");
    write_images(folder / "from", {"frame0001.png", "frame0012.png"});
    const auto set = imported(folder, {"xyzw", "m"}, folder / "board.yaml");
    REQUIRE(set.poses.size() == 2);
    CHECK(set.poses[0].T_base_tool.translation().isApprox(Eigen::Vector3d(1360, 33.5, 1480)));
    CHECK(set.poses[0].T_base_tool.linear()(2, 1) == Approx(0.96));  // about x, sine of 2 asin 0.6
    CHECK(set.poses[1].index == 12);
    CHECK(set.poses[1].laser == set.poses[1].grid);
  }
  SECTION("with names") {
    const Folder folder;
    write_plate(folder);
    for (const char* name : {"poses", "images"})
      fs::create_directories(folder / (std::string("from/") + name));
    const std::string pose = "x: 0.5\ny: -0.4\nz: 0.85\nqx: 0\nqy: 1\nqz: 0\nqw: 0\n";
    write_text(folder / "from/poses/0.yaml", pose);
    write_text(folder / "from/poses/10.yaml", pose);
    write_images(folder / "from/images", {"0.png", "10.png"});
    CHECK(imported(folder, {"xyzw", "m"}).poses[1].T_base_tool.translation().x() == Approx(500));
    fs::remove_all(folder / "to");
    CHECK_THAT(complaint(folder, {"wxyz", "m"}), Contains("those of --pose-format xyzw"));
  }
}

TEST_CASE("what cannot be imported is said in one line, and nothing is left") {
  const Folder folder;
  write_plate(folder);
  const auto write_poses = [&](const std::string& text) {
    write_text(folder / "from/poses.csv", text);
  };
  write_images(folder / "from", {"1.png", "2.png"});
  CHECK_THAT(complaint(folder, {}), Contains("holds no poses"));
  write_poses("index,x,y,z,qw,qx,qy,qz\n1,900,0,300,1,0,0,0\n2,950,0,300,1,0,0,0\n");
  CHECK(complaint(folder, {}).empty());
  CHECK_THROWS_WITH(imported(folder, {}), Contains("exists already"));
  fs::remove_all(folder / "to");
  CHECK_THAT(complaint(folder, {"xyzw", "mm"}), Contains("those of --pose-format wxyz"));
  CHECK_THAT(complaint(folder, {"wxyz", "m"}), Contains("another unit than m"));
  write_poses("1,900,0,300,1,0,0,0\n3,950,0,300,1,0,0,0\n");
  CHECK_THAT(complaint(folder, {}), Contains("no image of pose 3"));
  write_poses("1,900,0,300,1,0,0,0\n1,950,0,300,1,0,0,0\n");
  CHECK_THAT(complaint(folder, {}), Contains("twice"));
  write_poses("1.5,900,0,300,1,0,0,0\n");
  CHECK_THAT(complaint(folder, {}), Contains("no index"));
  write_poses("1,900,0,300,1,0,0,0\n2,950,0,300,1,0,0,0\n");
  write_images(folder / "from", {"0002.jpg"});
  CHECK_THAT(complaint(folder, {}), Contains("has the number of"));
  fs::remove(folder / "from/0002.jpg");
  write_text(folder / "from/plate.yaml", "pattern: hexagons\n");
  CHECK_THAT(complaint(folder, {}), Contains("plate.yaml") && Contains("one of"));
  fs::remove(folder / "from/plate.yaml");
  CHECK_THAT(complaint(folder, {}), Contains("--plate"));
}
