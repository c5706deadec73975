// Clouds from files. The judge of a scan of a real Tee of two square tubes is the same Tee sampled
// from its CAD model and registered by PCL's ICP.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "common/geometry.hpp"
#include "paths.hpp"
#include "tests/seam_finding/support/pcl_judge.hpp"

using namespace arcstart;
namespace fs = std::filesystem;

namespace {

fs::path clouds() {
  const char* given = std::getenv("ARCSTART_DATA");
  return (given ? fs::path(given) : fs::path(ARCSTART_SOURCE) / "../shared/data") / "tee_clouds";
}

std::vector<Eigen::Vector3d> in_mm(std::vector<Eigen::Vector3d> points) {
  for (auto& point : points) point *= 1000;
  return points;
}

struct Fillet {
  Line line;     // in the scan's frame
  int seen = 0;  // points of the scan on the stem's side face over it
};

// The Tee's fillets lie at x = +-25.4, z = 25.4 of the CAD frame and run along y. Which of them the
// scan saw, it says itself, by the points on the side face of the stem above it.
std::array<Fillet, 2> registered_fillets() {
  const auto scan = in_mm(pcl_judge::read_pcd(clouds() / "table_8in10in_tee_x0y24.pcd"));
  auto model = pcl_judge::read_oriented_pcd(clouds() / "8in10in_tee_01_blndr.pcd");
  model.points = in_mm(model.points);
  // The Tee stands on the table, z = 0, with its front about y = -585 mm; first guess by eye.
  pcl_judge::Points tee;
  for (const auto& point : scan)
    if (point.y() < -560 && point.y() > -660 && point.z() > 12) tee.push_back(point);
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
  guess.translation() = -Eigen::Vector3d(8, -610, 25);
  auto found = pcl_judge::icp(tee, model, guess, 20);
  found = pcl_judge::icp(tee, model, found.T_model_scan, 8);
  REQUIRE(found.converged);
  INFO("ICP leaves " << found.rms << " mm");
  REQUIRE(found.rms < 4);
  std::array<Fillet, 2> fillets;
  const Eigen::Isometry3d T_scan_model = found.T_model_scan.inverse();
  for (int side = 0; side < 2; ++side) {
    const double x = side == 0 ? -25.4 : 25.4;
    fillets[side].line = {T_scan_model * Eigen::Vector3d(x, 0, 25.4),
                          T_scan_model.linear() * Eigen::Vector3d::UnitY()};
    for (const auto& point : tee) {
      const Eigen::Vector3d p = found.T_model_scan * point;
      fillets[side].seen += std::abs(p.x() - x) < 3 && p.z() > 35 && std::abs(p.y()) < 18;
    }
  }
  return fillets;
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double angle = angle_between(a, b) * 180 / M_PI;
  return std::min(angle, 180 - angle);
}

struct Run {
  int exit_code;
  nlohmann::json json;
};
Run run(const std::string& arguments) {
  const std::string command =
      std::string(ARCSTART_PROGRAM) + " find-seam " + arguments + " 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe))
    text.append(buffer, got);
  const int status = pclose(pipe);
  return {WEXITSTATUS(status), text.empty() ? nlohmann::json() : nlohmann::json::parse(text)};
}

Eigen::Vector3d vector_of(const nlohmann::json& json) {
  return Eigen::Vector3d(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
}

bool there_is_data() {
  if (fs::exists(clouds())) return true;
  WARN("skipped: no folder " << clouds() << ", see ARCSTART_DATA");
  return false;
}

}  // namespace

TEST_CASE("the fillet of a real Tee is the answer, not the line of the tube on the table") {
  if (!there_is_data()) return;
  const auto fillets = registered_fillets();
  INFO("points on the stem's sides: " << fillets[0].seen << " at x = -25.4, " << fillets[1].seen
                                      << " at x = 25.4");
  CHECK(std::max(fillets[0].seen, fillets[1].seen) >
        10 * std::min(fillets[0].seen, fillets[1].seen));
  const Fillet& seen = fillets[fillets[0].seen > fillets[1].seen ? 0 : 1];

  const std::string path = clouds() / "table_8in10in_tee_x0y24.pcd";
  const Run found = run(path + " --units m --remove-plane --json");
  REQUIRE(found.exit_code == 0);
  CHECK(found.json["verdict"] == "found");
  const Eigen::Vector3d start = vector_of(found.json["start"]), end = vector_of(found.json["end"]);
  INFO("start " << start.transpose() << ", end " << end.transpose());
  CHECK(seen.line.distance(start) < 5);
  CHECK(seen.line.distance(end) < 5);
  CHECK(angle_deg(vector_of(found.json["direction"]), seen.line.direction) < 2);
  CHECK((end - start).norm() > 25);
  CHECK((end - start).norm() < 60);
  CHECK(found.json["angle"].get<double>() * 180 / M_PI == Approx(90).margin(5));

  // With the search the other way round it starts where it ended.
  const Run turned =
      run(path + " --units m --remove-plane --json --search-direction 0,-1,0 --viewpoint -0.2,0,1");
  REQUIRE(turned.exit_code == 0);
  CHECK(vector_of(turned.json["direction"]).y() < -0.99);
  CHECK((vector_of(turned.json["start"]) - end).norm() < 3);
}

TEST_CASE("real clouds without a straight seam get no line that is not there") {
  if (!there_is_data()) return;
  // A round tube on a plate.
  const Run tube = run(std::string(clouds() / "shape3_0deg_filtered.pcd") + " --units m --json");
  CHECK(tube.exit_code == 1);
  CHECK(tube.json["verdict"] != "found");
  // A wall on a base plate, both bent by several mm, with holes: where the seam starts depends on
  // how far from its plane a point may lie.
  const std::string plates = std::string(clouds() / "2plate_partA_fig1_cropped.pcd") + " --units m";
  for (const char* options : {" --json", " --json --remove-plane"}) {
    INFO(options);
    const Run two = run(plates + options);
    CHECK(two.exit_code == 1);
    CHECK(two.json["verdict"] != "found");
    CHECK(!two.json["reason"].get<std::string>().empty());
  }
}

TEST_CASE("a tee is found though nobody says from where it was seen") {
  // An upright of 200 x 50 mm, more densely sampled than its base, which reaches farther behind it
  // than before it: where more points lie is the wrong side to look from.
  const fs::path path =
      fs::temp_directory_path() / ("arcstart-tee-" + std::to_string(::getpid()) + ".xyz");
  std::ofstream file(path);
  std::mt19937 engine(6);
  std::normal_distribution<double> noise(0, 0.05);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 12000; ++i)
    file << 200 * share(engine) << " " << 10 + noise(engine) << " " << 50 * share(engine) << "\n";
  for (int i = 0; i < 12000; ++i) {
    const double y = -50 + 100 * share(engine);
    if (y < 4 || y > 10) file << 200 * share(engine) << " " << y << " " << noise(engine) << "\n";
  }
  file.close();
  const Run found = run(path.string() + " --json");
  CHECK(found.exit_code == 0);
  CHECK(found.json["verdict"] == "found");
  const Line seam = {Eigen::Vector3d(0, 10, 0), Eigen::Vector3d::UnitX()};
  CHECK(seam.distance(vector_of(found.json["start"])) < 0.1);
  CHECK(seam.distance(vector_of(found.json["end"])) < 0.1);
  // From behind there is none, and whoever says so is taken at his word.
  CHECK(run(path.string() + " --json --viewpoint 100,-990,12").exit_code == 1);
  fs::remove(path);
}

TEST_CASE("bad input ends with 2") {
  CHECK(run("/nowhere/cloud.pcd").exit_code == 2);
  CHECK(run("").exit_code == 2);
  if (!there_is_data()) return;
  const std::string path = clouds() / "shape3_0deg_filtered.pcd";
  CHECK(run(path + " --units inch").exit_code == 2);
  CHECK(run(path + " --viewpoint 1,2").exit_code == 2);
  CHECK(run(path + " --viewpoint 1,nan,2").exit_code == 2);
  CHECK(run(path + " --search-direction 0,0,0").exit_code == 2);
  CHECK(run(path + " --remove-plane --background " + path).exit_code == 2);
  CHECK(run(path + " --units m --picture /nowhere/picture.png").exit_code == 2);
  CHECK(run(path + " --background /nowhere/cloud.pcd").exit_code == 2);
  CHECK(run(path + " --units m --csv /nowhere/stations.csv").exit_code == 2);
}
