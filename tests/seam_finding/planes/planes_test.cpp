#include "services/seam_finding/planes/planes.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "common/geometry.hpp"
#include "services/seam_finding/cloud/connected_components.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"
#include "tests/seam_finding/support/pcl_judge.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// A rectangle about a middle, spanned by two directions, with noise across it.
void add_rectangle(std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& middle,
                   const Eigen::Vector3d& along, const Eigen::Vector3d& across, double noise,
                   int count, std::mt19937& engine) {
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  std::normal_distribution<double> off(0, noise);
  const Eigen::Vector3d normal = along.cross(across).normalized();
  for (int i = 0; i < count; ++i)
    points.push_back(middle + share(engine) * along + share(engine) * across +
                     off(engine) * normal);
}

std::vector<int> all_of(const ScanCloud& cloud) {
  std::vector<int> indices(cloud.points.size());
  for (int i = 0; i < cloud.size(); ++i) indices[i] = i;
  return indices;
}

double angle_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double angle = angle_between(a, b);
  return std::min(angle, M_PI - angle);
}

}  // namespace

TEST_CASE("least-squares plane: of exact points exact, of sums added in parts the same") {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  std::mt19937 engine(3);
  std::vector<Eigen::Vector3d> points;
  add_rectangle(points, {1000, -2000, 500}, 80 * normal.unitOrthogonal(),
                50 * normal.cross(normal.unitOrthogonal()), 0, 400, engine);
  PlaneSums whole(points.front()), first, second(points.back());
  for (std::size_t i = 0; i < points.size(); ++i) {
    whole.add(points[i]);
    (i % 2 == 0 ? first : second).add(points[i]);
  }
  first.add(second);
  for (const PlaneSums* sums : {&whole, &first}) {
    const auto fit = sums->fit();
    CHECK(angle_of(fit.plane.normal, normal) < 1e-7);
    CHECK(fit.rms < 1e-5);
    CHECK(std::abs(fit.plane.signed_distance({1000, -2000, 500})) < 1e-6);
    CHECK(fit.spread[0] == Approx(50 / std::sqrt(12.0)).epsilon(0.1));
    CHECK(fit.spread[1] == Approx(80 / std::sqrt(12.0)).epsilon(0.1));
  }
}

TEST_CASE("the first face is PCL's largest plane") {
  for (int seed = 1; seed <= 8; ++seed) {
    std::mt19937 engine(seed);
    std::vector<Eigen::Vector3d> points;
    const Eigen::Vector3d normal = Eigen::Vector3d::Random().normalized();
    add_rectangle(points, {100, 50, 900}, 120 * normal.unitOrthogonal(),
                  90 * normal.cross(normal.unitOrthogonal()), 0.1, 1500, engine);
    std::uniform_real_distribution<double> anywhere(-100, 100);
    for (int i = 0; i < 500; ++i)
      points.emplace_back(100 + anywhere(engine), 50 + anywhere(engine), 900 + anywhere(engine));
    const ScanCloud cloud = unorganised_cloud(points);
    PlaneSearch search;
    search.tolerance = 0.5;
    const auto faces = find_faces(cloud, all_of(cloud), search, 11);
    const auto judged = pcl_judge::plane(points, 0.5);
    REQUIRE_FALSE(faces.empty());
    CHECK(angle_of(faces[0].plane.normal, judged.coefficients.head<3>()) < 0.05 * kDegree);
    CHECK(angle_of(faces[0].plane.normal, normal) < 0.03 * kDegree);
    CHECK(std::abs(faces[0].plane.signed_distance({100, 50, 900})) < 0.02);
    CHECK(faces[0].points.size() >= 0.97 * static_cast<double>(judged.inliers.size()));
  }
}

TEST_CASE("pieces of one plane that do not hang together are two faces") {
  std::mt19937 engine(4);
  std::vector<Eigen::Vector3d> points;
  add_rectangle(points, {0, 0, 0}, {60, 0, 0}, {0, 60, 0}, 0.1, 1000, engine);
  add_rectangle(points, {120, 0, 0}, {40, 0, 0}, {0, 60, 0}, 0.1, 600, engine);
  const ScanCloud cloud = unorganised_cloud(points);
  const auto faces = find_faces(cloud, all_of(cloud), {}, 1);
  REQUIRE(faces.size() == 2);
  CHECK(faces[0].points.size() == 1000);
  CHECK(faces[1].points.size() == 600);
}

TEST_CASE("a small face is found among larger ones, and each point belongs to one face") {
  std::mt19937 engine(5);
  std::vector<Eigen::Vector3d> points;
  add_rectangle(points, {0, 0, 0}, {150, 0, 0}, {0, 150, 0}, 0.1, 4000, engine);
  add_rectangle(points, {0, 75, 60}, {150, 0, 0}, {0, 0, 110}, 0.1, 3000, engine);
  add_rectangle(points, {20, 0, 30}, {0, 30, 0}, {10, 0, 30}, 0.1, 150, engine);
  const ScanCloud cloud = unorganised_cloud(points);
  const auto faces = find_faces(cloud, all_of(cloud), {}, 1);
  REQUIRE(faces.size() == 3);
  std::vector<int> owners(points.size(), 0);
  for (const Face& face : faces)
    for (const int i : face.points) ++owners[i];
  CHECK(std::all_of(owners.begin(), owners.end(), [](int times) { return times <= 1; }));
  CHECK(faces[2].points.size() > 140);
}

TEST_CASE("segment ends belong to a face and do not bend it") {
  std::mt19937 engine(6);
  std::vector<Eigen::Vector3d> points;
  add_rectangle(points, {0, 0, 0}, {100, 0, 0}, {0, 100, 0}, 0.05, 800, engine);
  ScanCloud cloud = unorganised_cloud(points);
  for (int i = 0; i < 100; ++i) {  // ends that lie off to one side
    cloud.points.emplace_back(49, i - 50.0, 0.4);
    cloud.origins.push_back({-1, 0, true, 0});
  }
  const auto faces = find_faces(cloud, all_of(cloud), {}, 1);
  REQUIRE(faces.size() == 1);
  CHECK(faces[0].points.size() == 900);
  CHECK(angle_of(faces[0].plane.normal, Eigen::Vector3d::UnitZ()) < 0.02 * kDegree);
}

TEST_CASE("under Eq. 6 only faces under the angle are found") {
  std::mt19937 engine(7);
  std::vector<Eigen::Vector3d> points;
  add_rectangle(points, {0, 0, 0}, {100, 0, 0}, {0, 100, 0}, 0.1, 2000, engine);
  add_rectangle(points, {0, 50, 40}, {100, 0, 0}, {0, 0, 70}, 0.1, 700, engine);
  const ScanCloud cloud = unorganised_cloud(points);
  PlaneSearch search;
  search.accept = [](const Plane& plane) { return std::abs(plane.normal.z()) < 0.2; };
  const auto faces = find_faces(cloud, all_of(cloud), search, 1);
  REQUIRE_FALSE(faces.empty());
  CHECK(angle_of(faces[0].plane.normal, Eigen::Vector3d::UnitY()) < 0.1 * kDegree);
}

TEST_CASE("the same seed gives the same faces, bit by bit") {
  std::mt19937 engine(8);
  std::vector<Eigen::Vector3d> points;
  add_rectangle(points, {0, 0, 0}, {100, 0, 0}, {0, 100, 20}, 0.2, 6000, engine);
  add_rectangle(points, {0, 50, 40}, {100, 0, 0}, {0, 0, 70}, 0.2, 3000, engine);
  const ScanCloud cloud = unorganised_cloud(points);
  const auto first = find_faces(cloud, all_of(cloud), {}, 42);
  const auto second = find_faces(cloud, all_of(cloud), {}, 42);
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].plane.normal == second[i].plane.normal);
    CHECK(first[i].plane.offset == second[i].plane.offset);
    CHECK(first[i].points == second[i].points);
  }
}

TEST_CASE("the largest piece is parted from the rest by gaps alone") {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 50; ++i) points.emplace_back(i, 0, 0);
  for (int i = 0; i < 80; ++i) points.emplace_back(200 + 0.5 * i, 0, 0);
  const auto largest = [&](double cell_mm) {
    std::vector<int> chosen(points.size());
    std::iota(chosen.begin(), chosen.end(), 0);
    Pieces(NeighbourGrid(points, cell_mm)).keep_largest(chosen);
    return chosen;
  };
  CHECK(largest(4).size() == 80);
  CHECK(largest(4).front() == 50);
  CHECK(largest(150).size() == 130);
  points.clear();
  CHECK(largest(4).empty());
}
