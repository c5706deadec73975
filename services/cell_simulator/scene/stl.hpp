// STL files, ASCII and binary.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "services/cell_simulator/scene/triangle_mesh.hpp"

namespace arcstart::cell_simulator {

// "fixture.stl: cut off: 12 triangles announced, 3 there".
class StlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The file's triangles in its own units and frame; its normals are left aside, corner order
// decides. Throws StlError where the file cannot be read, is damaged, holds a number that is not
// finite, or no triangle.
TriangleMesh read_stl(const std::string& path);

// The same from the file's bytes; name stands in errors.
TriangleMesh parse_stl(std::string_view bytes, const std::string& name);

}  // namespace arcstart::cell_simulator
