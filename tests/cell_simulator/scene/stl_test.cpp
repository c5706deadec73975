#include "services/cell_simulator/scene/stl.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

using namespace arcstart;
using namespace arcstart::cell_simulator;
using Catch::Matchers::Contains;

namespace {

std::string binary(const std::vector<std::array<float, 9>>& triangles,
                   std::string header = "made by a test") {
  header.resize(80);
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::string bytes = header + std::string(reinterpret_cast<const char*>(&count), 4);
  for (const auto& corners : triangles) {
    bytes += std::string(12, '\0');
    bytes += std::string(reinterpret_cast<const char*>(corners.data()), 36);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

const std::array<float, 9> one_triangle{0, 0, 0, 10, 0, 0, 0, 5.5f, -2};

const std::string text = R"(solid a part of the fixture
  facet normal 0 0 1
    outer loop
      vertex 0 0 0
      vertex +1.0e1 0 0
      vertex 0 5.5 -2
    endloop
  endfacet
endsolid a part of the fixture
)";

void check_one_triangle(const TriangleMesh& mesh) {
  REQUIRE(mesh.triangles.size() == 1);
  const auto& [a, b, c] = mesh.triangles[0];
  CHECK(mesh.corners[a] == Eigen::Vector3d(0, 0, 0));
  CHECK(mesh.corners[b] == Eigen::Vector3d(10, 0, 0));
  CHECK(mesh.corners[c] == Eigen::Vector3d(0, 5.5, -2));
}

}  // namespace

TEST_CASE("STL files are read, text and binary") {
  check_one_triangle(parse_stl(text, "part.stl"));
  check_one_triangle(parse_stl(binary({one_triangle}), "part.stl"));
  check_one_triangle(parse_stl(binary({one_triangle}, "solid in spite of its name"), "part.stl"));
  check_one_triangle(parse_stl(binary({one_triangle}) + "more behind it", "part.stl"));
  std::string dos;
  for (const char c : text) {
    if (c == '\n') dos.push_back('\r');
    dos.push_back(c);
  }
  check_one_triangle(parse_stl(dos, "part.stl"));
  CHECK(parse_stl(binary({one_triangle, one_triangle, one_triangle}), "").triangles.size() == 3);

  const std::string path = std::filesystem::temp_directory_path() / "arcstart_stl_test.stl";
  std::ofstream(path, std::ios::binary) << binary({one_triangle});
  check_one_triangle(read_stl(path));
  std::filesystem::remove(path);
}

TEST_CASE("a damaged STL file is refused with its reason") {
  const auto refused = [](const std::string& bytes, const std::string& reason) {
    CAPTURE(reason);
    CHECK_THROWS_WITH(parse_stl(bytes, "part.stl"), Contains("part.stl") && Contains(reason));
  };
  refused("", "too few");
  refused("PK", "too few");
  refused(binary({}), "no triangle");
  refused(binary({one_triangle, one_triangle}).substr(0, 84 + 99),
          "2 triangles announced, 1 there");
  std::string huge = binary({one_triangle});
  std::memset(huge.data() + 80, 0xff, 4);
  refused(huge, "4294967295 triangles announced, 1 there");
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
    auto corners = one_triangle;
    corners[4] = bad;
    refused(binary({one_triangle, corners}), "triangle 2");
  }
  refused("solid empty\nendsolid empty\n", "no triangle");
  refused("solid", "the end of the file");
  refused(text.substr(0, text.size() / 2), "part.stl:");
  const auto spoilt = [](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    std::string copy = text.substr(0, at);
    copy.append(to).append(text.substr(at + from.size()));
    return copy;
  };
  refused(spoilt("5.5", "5,5"), "part.stl:6: expected a number, found '5,5'");
  refused(spoilt("5.5", "nan"), "not finite");
  refused(spoilt("5.5", "1e9"), "not finite or beyond");
  refused(spoilt("5.5", ""), "expected a number");
  refused(spoilt("endloop", "vertex"), "expected 'endloop', found 'vertex'");
  refused(spoilt("facet", "facets"), "found 'facets'");
  refused(spoilt("endsolid", std::string(100000, 'x')), "found 'xxx");

  CHECK_THROWS_WITH(read_stl("/nowhere/part.stl"), Contains("/nowhere/part.stl: cannot be opened"));
  CHECK_THROWS_AS(read_stl(std::filesystem::temp_directory_path()), StlError);
}
