// Scans in files: what is read, and what is refused in one line that says where.
#include "services/command_line/imports/scan_folder.hpp"

#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>

#include "services/command_line/imports/import_error.hpp"
#include "tests/command_line/support/scan_files.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kFirst = 1'700'000'000'100'000;  // us; of three images 0.1 s apart
constexpr double kOffset = -0.05;                       // s; images are stamped so much late

// A sound scan: three images (their pixels are not looked at) and poses from 0.1 s before them on.
class Scan {
 public:
  Scan() {
    fs::create_directories(folder_ / "frames");
    for (int i = 0; i < 3; ++i) write_text(folder_ / fmt::format("frames/{:04}.png", i), "image");
    write("frames.csv", frames());
    write("poses.csv", poses());
  }
  static std::string frames() {
    std::string text = "index,utime\n";
    for (int i = 0; i < 3; ++i) text += fmt::format("{},{}\n", i, kFirst + i * 100'000);
    return text;
  }
  static std::string pose(std::int64_t utime, double x) {
    return fmt::format("{},{},20,300,0,1,0,0\n", utime, x);
  }
  static std::string poses() {
    std::string text = "utime,x,y,z,qw,qx,qy,qz\n";
    for (int i = 0; i < 16; ++i) text += pose(kFirst - 100'000 + i * 20'000, 100 + i);
    return text;
  }
  void write(const std::string& name, const std::string& text) const {
    write_text(folder_ / name, text);
  }
  ScanFolder read(const PoseConvention& convention = {}) {
    notes.clear();
    return read_scan_folder(folder_.path(), convention, kOffset, notes);
  }
  std::string refusal(const PoseConvention& convention = {}) {
    std::string what;
    try {
      read(convention);
    } catch (const ImportError& error) {
      what = error.what();
    }
    CHECK(what.find('\n') == std::string::npos);
    return what;
  }
  std::string operator/(const std::string& name) const { return folder_ / name; }

  std::vector<std::string> notes;

 private:
  Folder folder_;
};

}  // namespace

TEST_CASE("a scan's images and poses come with their times") {
  Scan files;
  const ScanFolder scan = files.read();
  CHECK(files.notes.empty());
  REQUIRE(scan.frames.size() == 3);
  CHECK(scan.frames[2].index == 2);
  CHECK(scan.frames[2].utime == kFirst + 200'000);
  CHECK(scan.frames[2].image == files / "frames/0002.png");
  REQUIRE(scan.poses.size() == 16);
  CHECK(scan.poses[1].utime == kFirst - 80'000);
  CHECK(scan.poses[1].T_base_tool.translation() == Eigen::Vector3d(101, 20, 300));
  CHECK(scan.first_utime() == kFirst - 100'000);
  CHECK(scan.last_utime() == kFirst + 200'000);
}

TEST_CASE("headers may be left out, and lines that say nothing") {
  Scan files;
  files.write("frames.csv", fmt::format("# stamps\r\n\r\n 1 , {}\r\n0,{}\r\n", kFirst + 1, kFirst));
  files.write("poses.csv", "\xef\xbb\xbf" + Scan::pose(kFirst - 100'000, 1) + "\n" +
                               Scan::pose(kFirst + 1'000'000, 50));
  const ScanFolder scan = files.read();
  REQUIRE(scan.frames.size() == 2);
  CHECK(scan.frames[1].utime == kFirst + 1);  // by index, whatever the order of the rows
  CHECK(scan.poses.size() == 2);
  // One image has no stamp, and the poses are too far apart for the two others.
  REQUIRE(files.notes.size() == 2);
  CHECK_THAT(files.notes[0], Contains("one image without a row in frames.csv left out, 0002.png"));
  CHECK_THAT(files.notes[1], Contains("2 of 2 images lie between poses more than 100 ms apart"));
}

TEST_CASE("images are told by their number and their ending") {
  Scan files;
  fs::rename(files / "frames/0001.png", files / "frames/1.JPEG");
  files.write("frames/notes.txt", "no image");
  CHECK(files.read().frames[1].image == files / "frames/1.JPEG");
  files.write("frames/01.tif", "image");
  CHECK_THAT(files.refusal(), Contains("frames/1.JPEG: has the index of") && Contains("01.tif"));
  fs::remove(files / "frames/01.tif");
  files.write("frames/left_0003.png", "image");
  CHECK_THAT(files.refusal(), Contains("left_0003.png: is not named after its index"));
}

TEST_CASE("what is missing in a scan is named") {
  Scan files;
  std::vector<std::string> notes;
  CHECK_THROWS_WITH(read_scan_folder(files / "nowhere", {}, 0, notes),
                    Contains("nowhere: is no folder"));
  fs::remove(files / "frames/0001.png");
  CHECK_THAT(files.refusal(), Contains("frames.csv:3: index 1 has no image in"));
  for (const int i : {0, 2}) fs::remove(files / fmt::format("frames/{:04}.png", i));
  CHECK_THAT(files.refusal(), Contains("frames: holds no image NNNN.png"));
  fs::remove(files / "frames");
  CHECK_THAT(files.refusal(), Contains("frames: is missing or cannot be read"));
  files.write("frames.csv", "index,utime\n");
  CHECK_THAT(files.refusal(), Contains("frames.csv: holds no row"));
  fs::remove(files / "frames.csv");
  CHECK_THAT(files.refusal(), Contains("frames.csv: is missing"));
  fs::create_directory(files / "frames.csv");
  CHECK_THAT(files.refusal(), Contains("frames.csv: is missing or cannot be read"));
  Scan others;
  fs::remove(others / "poses.csv");
  CHECK_THAT(others.refusal(), Contains("poses.csv: is missing"));
}

TEST_CASE("stamps that cannot be are refused with their line") {
  const auto refused = [](const std::string& frames) {
    Scan files;
    files.write("frames.csv", frames);
    return files.refusal();
  };
  CHECK_THAT(refused("index,utime\n0,1700000000\n"),
             Contains("frames.csv:2") && Contains("like s"));
  CHECK_THAT(refused("0,1700000000100\n"), Contains("frames.csv:1") && Contains("like ms"));
  CHECK_THAT(refused("0,1700000000100000000\n"), Contains("like ns"));
  CHECK_THAT(refused("0,1700000000.1\n"), Contains("like s"));
  CHECK_THAT(refused("0,0\n"), Contains("'0' is no time"));
  CHECK_THAT(refused("0,nan\n"), Contains("'nan' is no time"));
  CHECK_THAT(refused("-1,1700000000100000\n"), Contains("'-1' is no index"));
  CHECK_THAT(refused("0,1700000000100000,5\n"), Contains("3 columns, not 2"));
  CHECK_THAT(refused("0;1700000000100000\n"), Contains("separate the columns by commas"));
  CHECK_THAT(refused("utime,index\n0,1700000000100000\n"), Contains("frames.csv:1: the columns"));
  CHECK_THAT(refused("0,1700000000100000\n0,1700000000200000\n"),
             Contains("frames.csv:2: index 0 stands there twice"));
  CHECK_THAT(refused("0,1700000000100000\n1,1700000000100000\n"),
             Contains("frames.csv:2: the time of index 1") && Contains("not later"));
}

TEST_CASE("poses that cannot be are refused with their line") {
  const auto refused = [](const std::string& poses, const PoseConvention& convention = {}) {
    Scan files;
    files.write("poses.csv", poses);
    return files.refusal(convention);
  };
  const std::string first = Scan::pose(kFirst - 100'000, 100);
  CHECK_THAT(refused(first), Contains("poses.csv: holds a single pose"));
  CHECK_THAT(refused(first + first), Contains("poses.csv:2: its time") && Contains("not later"));
  CHECK_THAT(refused(first + fmt::format("{},nan,20,300,0,1,0,0\n", kFirst)),
             Contains("poses.csv:2: column 2: 'nan' is no finite number"));
  CHECK_THAT(refused(first + fmt::format("{},1,20,300,0,inf,0,0\n", kFirst)),
             Contains("'inf' is no finite number"));
  CHECK_THAT(refused(first + fmt::format("{},1,20,300,0,1,0\n", kFirst)),
             Contains("poses.csv:2: 7 columns: --pose-format wxyz has utime,x,y,z,qw,qx,qy,qz"));
  CHECK_THAT(refused(first + fmt::format("{},1,20,300,1,1,0,0\n", kFirst)),
             Contains("poses.csv:2: the quaternion has length 1.414, not 1"));
  CHECK_THAT(refused("utime,x,y,z,qx,qy,qz,qw\n" + first),
             Contains("poses.csv:1: the columns utime,x,y,z,qx,qy,qz,qw are those of --pose-format "
                      "xyzw, not of wxyz"));
  CHECK_THAT(refused(Scan::poses(), {"wxyz", "m"}), Contains("another unit than m"));
  CHECK_THAT(refused(fmt::format("{},0.83,0.1,0.3,0,1,0,0\n{},0.93,0.1,0.3,0,1,0,0\n",
                                 kFirst - 100'000, kFirst + 1'000'000)),
             Contains("another unit than mm"));
}

TEST_CASE("poses must cover all images, by the calibration's time offset") {
  const auto with_poses = [](std::int64_t begin, std::int64_t end) {
    Scan files;
    files.write("poses.csv", Scan::pose(begin, 0) + Scan::pose(end, 50));
    return files.refusal();
  };
  // The first image is taken 50 ms before its stamp, the last 150 ms after the first one's.
  CHECK(with_poses(kFirst - 50'000, kFirst + 150'000).empty());
  CHECK_THAT(with_poses(kFirst - 49'000, kFirst + 150'000),
             Contains("poses.csv: the image of index 0") && Contains("1.0 ms before the first"));
  CHECK_THAT(with_poses(kFirst - 50'000, kFirst + 148'000),
             Contains("the image of index 2") && Contains("2.0 ms after the last"));
}

TEST_CASE("angles that are more likely radians are told") {
  Scan files;
  files.write("poses.csv", fmt::format("{},100,20,300,3.14,0,-1.57\n{},200,20,300,3.14,0,-1.57\n",
                                       kFirst - 100'000, kFirst + 1'000'000));
  files.read({"wpr", "mm"});
  REQUIRE(files.notes.size() == 2);
  CHECK_THAT(files.notes[0], Contains("are they in rad?"));
}
