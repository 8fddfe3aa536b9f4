// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OccluderMesh_h
#define po_OccluderMesh_h

#include "Sphere.h"

#include <array>
#include <vector>

namespace po
{
/// Triangles in local coordinates (see SphereCloud). They stop rays from both sides.
struct OccluderMesh
{
  std::vector<Vec3f> vertices;
  std::vector<std::array<unsigned, 3>> triangles; ///< indices of vertices
};

/// What darkens particles without being baked itself; all lengths local.
struct Occluders
{
  std::vector<Sphere> spheres;
  OccluderMesh mesh;
  std::vector<Vec3d> centers = {}; ///< of the spheres, in full, as in SphereCloud; or empty
};
}

#endif
