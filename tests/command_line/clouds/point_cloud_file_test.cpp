#include "services/command_line/clouds/point_cloud_file.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "paths.hpp"
#include "services/command_line/clouds/cloud_picture.hpp"
#include "tests/seam_finding/support/pcl_judge.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
namespace fs = std::filesystem;

namespace {

struct File {
  fs::path path;
  explicit File(const std::string& name)
      : path(fs::temp_directory_path() / ("arcstart-" + std::to_string(::getpid()) + "-" + name)) {}
  ~File() { fs::remove(path); }
  void write(const std::string& bytes) const { std::ofstream(path, std::ios::binary) << bytes; }
};

std::string pcd_header(const std::string& points, const std::string& data,
                       const std::string& rest = "") {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
         points + "\nHEIGHT 1\n" + rest + "POINTS " + points + "\nDATA " + data + "\n";
}

std::string ply_header(const std::string& count, const std::string& format) {
  return "ply\nformat " + format + " 1.0\ncomment made here\nelement vertex " + count +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face 0\nproperty list "
         "uchar int vertex_indices\nend_header\n";
}

std::string floats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values)
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

std::vector<Eigen::Vector3d> random_points(int count) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<float> place(-900, 900);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(engine), place(engine), place(engine));
  return points;
}

bool same(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if ((a[i] - b[i]).norm() > 1e-6 * (1 + a[i].norm())) return false;
  return true;
}

std::string error_of(const std::string& bytes) {
  try {
    parse_point_cloud(bytes, "cloud");
  } catch (const PointCloudFileError& error) {
    CHECK_THAT(error.what(), Catch::StartsWith("cloud: "));
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error.what();
  }
  return "";
}

fs::path data_folder() {
  const char* given = std::getenv("ARCSTART_DATA");
  return given ? fs::path(given) : fs::path(ARCSTART_SOURCE) / "../shared/data";
}

}  // namespace

TEST_CASE("what is written is read by PCL and by the product alike") {
  const auto points = random_points(500);
  const std::vector<Colour> colours(points.size(), Colour{200, 100, 50});
  for (const bool coloured : {false, true}) {
    const File pcd("cloud.pcd"), ply("cloud.ply");
    write_pcd(pcd.path, points, coloured ? colours : std::vector<Colour>{});
    write_ply(ply.path, points, coloured ? colours : std::vector<Colour>{});
    CHECK(same(read_point_cloud(pcd.path).points, points));
    CHECK(same(read_point_cloud(ply.path).points, points));
    CHECK(same(pcl_judge::read_pcd(pcd.path), points));
    CHECK(same(pcl_judge::read_ply(ply.path), points));
  }
}

TEST_CASE("what PCL compresses is read, and no damage of it does more than an error") {
  auto points = random_points(700);
  for (int i = 0; i < 300; ++i) points.emplace_back(1, 2, 3);  // where it compresses
  const File file("compressed.pcd");
  pcl_judge::write_compressed_pcd(file.path, points);
  CHECK(fs::file_size(file.path) < 12 * points.size());
  CHECK(same(read_point_cloud(file.path).points, points));
  std::ifstream in(file.path, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  std::mt19937 engine(5);
  int errors = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bad = good;
    if (i % 3 == 0) bad.resize(engine() % bad.size());
    for (int j = 0; j < 3 && !bad.empty(); ++j)
      bad[engine() % bad.size()] = static_cast<char>(engine());
    std::size_t read = 0;
    try {
      read = parse_point_cloud(bad, "damaged").points.size();
    } catch (const PointCloudFileError&) {
      ++errors;
    }
    CHECK(read <= points.size());
  }
  CHECK(errors > 1000);
}

TEST_CASE("a point a line, whatever separates its numbers") {
  const std::vector<Eigen::Vector3d> points = {{1, 2, 3}, {-4, 5.5, 6e2}};
  for (const char* text : {
           "1 2 3\n-4 5.5 6e2",
           "1\t2\t3\r\n-4\t5.5\t600\r\n",
           "# made by hand\n\n 1, 2, 3\n-4,5.5,600\n",
           "1;2;3;0.5\n-4;5.5;600;0.5\n",
           "2\n1 2 3 17 255 0 0\n-4 5.5 600 17 0 255 0\n",
           "//X Y Z R G B\n1 2 3 9 9 9\n-4 5.5 600 9 9 9\n",
           "intensity,z,\"X\",Y\n9,3,1,2\n9,600,-4,5.5\n",
       }) {
    CAPTURE(text);
    CHECK(same(parse_point_cloud(text, "c").points, points));
  }
  const PointCloud gaps = parse_point_cloud("1 2 3\nnan nan nan\n4 5 6\n", "c");
  CHECK(gaps.points.size() == 2);
  CHECK(gaps.skipped == 1);

  using Catch::Contains;
  CHECK_THAT(error_of("1 2 3\n4 5 6 7\n"), Contains("line 2: 4 columns, the lines before have 3"));
  CHECK_THAT(error_of("1 2 3\n4 5 six\n"), Contains("line 2: 'six' is no number"));
  CHECK_THAT(error_of("1 2\n3 4\n"), Contains("line 1: 2 columns, too few"));
  CHECK_THAT(error_of("1,5;2,5;3,5\n"), Contains("decimal comma"));
  CHECK_THAT(error_of("1000\n"), Contains("holds no points"));
  CHECK_THAT(error_of("x y z\n"), Contains("holds no points"));
}

TEST_CASE("the real clouds are read as PCL reads them") {
  if (!fs::exists(data_folder() / "tee_clouds")) {
    WARN("skipped: no folder tee_clouds in " << data_folder() << ", see ARCSTART_DATA");
    return;
  }
  for (const char* name : {"table_8in10in_tee_x0y24", "8in10in_tee_01_blndr",
                           "2plate_partA_fig1_cropped", "shape3_0deg_filtered"}) {
    const std::string path = data_folder() / "tee_clouds" / (std::string(name) + ".pcd");
    const PointCloud cloud = read_point_cloud(path);
    CHECK(cloud.skipped == 0);
    CHECK_FALSE(cloud.viewpoint);
    CHECK(same(cloud.points, pcl_judge::read_pcd(path)));
  }
}

TEST_CASE("ascii and binary, fields of any kind and order, points that are no numbers") {
  CHECK(parse_point_cloud(pcd_header("2", "ascii") + "1 2 3\n4 5e0 +6\n", "c").points[1] ==
        Eigen::Vector3d(4, 5, 6));
  const PointCloud nan = parse_point_cloud(
      pcd_header("4", "ascii") + "1 2 3\nnan nan nan\n-inf 1 1\n1e400 1 1\n", "c");
  CHECK(nan.points.size() == 1);
  CHECK(nan.skipped == 3);
  const std::string mixed =
      "VERSION .7\r\nFIELDS intensity z x _ y\nSIZE 1 8 2 4 4\nTYPE U F I F F\nCOUNT 1 1 1 3 1\n"
      "WIDTH 1\nHEIGHT 1\nVIEWPOINT 100 200 300 1 0 0 0\nPOINTS 1\nDATA binary\n";
  std::string row(1, '\x07');
  const double z = 2.5;
  const std::int16_t x = -3;
  row.append(reinterpret_cast<const char*>(&z), 8);
  row.append(reinterpret_cast<const char*>(&x), 2);
  row += floats({9, 9, 9, 4});
  const PointCloud cloud = parse_point_cloud(mixed + row, "c");
  CHECK(cloud.points.at(0) == Eigen::Vector3d(-3, 4, 2.5));
  REQUIRE(cloud.viewpoint);
  CHECK(*cloud.viewpoint == Eigen::Vector3d(100, 200, 300));
  CHECK(parse_point_cloud(ply_header("1", "ascii") + "7 8 9\n", "c").points[0] ==
        Eigen::Vector3d(7, 8, 9));
  CHECK(parse_point_cloud(ply_header("1", "binary_little_endian") + floats({7, 8, 9}), "c")
            .points[0] == Eigen::Vector3d(7, 8, 9));
  std::string swapped = floats({9, 8, 7});
  std::reverse(swapped.begin(), swapped.end());
  CHECK(parse_point_cloud(ply_header("1", "binary_big_endian") + swapped, "c").points[0] ==
        Eigen::Vector3d(7, 8, 9));
}

TEST_CASE("each bad file has its one clear line") {
  using Catch::Contains;
  CHECK_THAT(error_of(""), Contains("is empty"));
  CHECK_THAT(error_of("hello"), Contains("header does not end"));
  CHECK_THAT(error_of("hello\nworld\n"), Contains("'hello'"));
  CHECK_THAT(error_of(pcd_header("0", "ascii")), Contains("holds no points"));
  CHECK_THAT(error_of(pcd_header("2", "ascii") + "nan 1 1\nnan 1 1\n"),
             Contains("none of its 2 points is finite"));
  CHECK_THAT(error_of(pcd_header("3", "ascii") + "1 2 3\n4 5 6\n7 8"), Contains("cut off"));
  CHECK_THAT(error_of(pcd_header("3", "binary") + floats({1, 2, 3, 4, 5, 6, 7, 8})),
             Contains("promises 3 points"));
  CHECK_THAT(error_of(pcd_header("1", "ascii") + "1 two 3\n"), Contains("'two' is no number"));
  CHECK_THAT(error_of(pcd_header("-1", "ascii") + "1 2 3\n"), Contains("no possible count"));
  CHECK_THAT(error_of(pcd_header("1.5", "ascii") + "1 2 3\n"), Contains("no possible count"));
  CHECK_THAT(error_of(pcd_header("99999999999999999999", "ascii")), Contains("no possible count"));
  for (const char* many : {"4294967296", "9223372036854775807", "18446744073709551615"})
    for (const char* data : {"ascii", "binary"})
      CHECK_THAT(error_of(pcd_header(many, data) + "1 2 3\n"), Contains("promises"));
  const auto compressed = [](std::uint32_t packed, std::uint32_t plain, const std::string& bytes) {
    std::string sizes(8, '\0');
    std::memcpy(sizes.data(), &packed, 4);
    std::memcpy(sizes.data() + 4, &plain, 4);
    return pcd_header("1", "binary_compressed") + sizes + bytes;
  };
  CHECK_THAT(error_of(pcd_header("1", "binary_compressed") + "xxxx"), Contains("cut off"));
  CHECK_THAT(error_of(compressed(9, 12, "xxxx")),
             Contains("promises 9 compressed bytes, 4 follow"));
  CHECK_THAT(error_of(compressed(4, 4000000000u, "xxxx")), Contains("cannot hold"));
  CHECK_THAT(error_of(compressed(4, 12, "xxxx")), Contains("are damaged"));
  CHECK_THAT(error_of(compressed(9, 8, std::string("\x07") + "12345678")),
             Contains("promises 1 points of 12 bytes, 8 bytes follow"));
  CHECK_THAT(error_of(pcd_header("1", "zipped")), Contains("must be ascii, binary or"));
  std::string header = pcd_header("1", "ascii");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = header;
    changed.replace(changed.find(from), from.size(), to);
    return changed + "1 2 3\n";
  };
  CHECK_THAT(error_of(with("SIZE 4 4 4", "SIZE 4 4")), Contains("3 fields, but 2 for SIZE"));
  CHECK_THAT(error_of(with("SIZE 4 4 4", "SIZE 4 4 3")), Contains("impossible SIZE 3"));
  CHECK_THAT(error_of(with("TYPE F F F", "TYPE F F Q")), Contains("not F, I or U"));
  CHECK_THAT(error_of(with("COUNT 1 1 1", "COUNT 1 1 0")), Contains("COUNT 0"));
  CHECK_THAT(error_of(with("COUNT 1 1 1", "COUNT 1 2 1")), Contains("holds 2 values"));
  CHECK_THAT(error_of(with("FIELDS x y z", "FIELDS x y w")), Contains("no fields x, y and z"));
  CHECK_THAT(error_of(with("HEIGHT 1", "HEIGHT 2")), Contains("WIDTH times HEIGHT is 2"));
  CHECK_THAT(error_of(with("HEIGHT 1", "HEIGHT 18446744073709551615")), Contains("says POINTS"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\nend_header\n"), Contains("no element vertex"));
  CHECK_THAT(error_of(ply_header("2", "binary_mixed") + floats({1, 2, 3, 4, 5, 6})),
             Contains("must be ascii, binary_little_endian or binary_big_endian"));
  CHECK_THAT(error_of(ply_header("5", "binary_little_endian") + floats({1, 2, 3})),
             Contains("promises 5 points"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\nelement face 3\nend_header\n"),
             Contains("must be vertex"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int x\n"
                      "end_header\n"),
             Contains("hold lists"));
  CHECK_THROWS_WITH(read_point_cloud("/nowhere/cloud.pcd"), Contains("No such file"));
  CHECK_THROWS_AS(write_pcd("/nowhere/cloud.pcd", {{1, 2, 3}}), PointCloudFileError);
}

TEST_CASE("no damage of a good file does more than an error") {
  const auto points = random_points(40);
  const File pcd("damage.pcd"), ply("damage.ply");
  write_pcd(pcd.path, points);
  write_ply(ply.path, points);
  std::mt19937 engine(4);
  for (const File* file : {&pcd, &ply}) {
    std::ifstream in(file->path, std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    int errors = 0;
    for (int i = 0; i < 3000; ++i) {
      std::string bad = good;
      for (int j = 0; j < 1 + i % 4; ++j) bad[engine() % bad.size()] = static_cast<char>(engine());
      if (i % 5 == 0) bad.resize(engine() % bad.size());
      std::size_t read = 0;
      try {
        read = parse_point_cloud(bad, "damaged").points.size();
      } catch (const PointCloudFileError& error) {
        ++errors;
        CHECK_THAT(error.what(), Catch::StartsWith("damaged: "));
      }
      CHECK(read <= 200);
    }
    CHECK(errors > 500);
  }
}

TEST_CASE("a picture is written, also of nothing, and where it cannot be an error says so") {
  const File picture("cloud.png");
  draw_cloud({}, picture.path);
  CHECK(fs::file_size(picture.path) > 1000);
  CloudPicture cloud;
  cloud.background = random_points(100);
  cloud.seam = {{0, 0, 0}, {100, 0, 0}};
  cloud.up = cloud.toward_viewer = {0, 0, 1};  // straight from above
  draw_cloud(cloud, picture.path);
  CHECK_THROWS_AS(draw_cloud(cloud, "/nowhere/cloud.png"), PictureError);
  CHECK_THROWS_AS(draw_cloud(cloud, picture.path.string() + ".nothing"), PictureError);
}
