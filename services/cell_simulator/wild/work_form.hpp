// A workpiece: its parts as triangles, and the truth about its seams; in the work's frame until it
// is placed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/cell_simulator/scene/triangle_mesh.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"
#include "services/cell_simulator/wild/wild_truth.hpp"

namespace arcstart::cell_simulator {

// Of a part, what lies no farther than half_width from a plane; as SurfaceBand.
struct WorkBand {
  Eigen::Vector3d middle, across;
  double half_width;  // mm
  WildSurface surface;
};

struct WorkPart {
  std::string name;
  TriangleMesh mesh;
  WildSurface surface;
  std::optional<WorkBand> band = {};
};

// The work's frame in base; the lowest corner of its metal, weld metal apart, lies at
// position_mm[2]. Throws SceneError where the description is impossible, as all here.
RigidTransform place(const WildWork& work);

// In base. The first plate comes first, then the second where there is one.
std::vector<WorkPart> parts_of(const WildWork& work);

// Of this work alone, its plates' indices counted from 0; empty of a wrong part.
std::vector<WildSeam> seams_of(const WildWork& work);

// A point of the flat work in base: bent as the work is, and placed.
Eigen::Vector3d on_work(const WildWork& work, const RigidTransform& T_base_work,
                        const Eigen::Vector3d& point);

}  // namespace arcstart::cell_simulator
