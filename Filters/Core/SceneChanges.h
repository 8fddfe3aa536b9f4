// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SceneChanges_h
#define po_SceneChanges_h

#include "OccluderMesh.h"
#include "Sphere.h"

#include <cstdint>
#include <vector>

namespace po
{
/// What of a scene is not as it was before, all lengths local.
struct SceneChanges
{
  /// Balls that hold all that was moved, was added or is gone, at its place before and now.
  std::vector<Sphere> balls;
  /// For each sphere of now, the first one before that is equal; -1 if none is.
  std::vector<std::int32_t> earlier;
  /// Whether spheres that are in both follow each other as before.
  bool inOrder = true;
};

/// Spheres that are equal, bit by bit, count as often as they are there; so do triangles.
[[nodiscard]] SceneChanges findChanges(const std::vector<Sphere>& spheresBefore,
  const OccluderMesh& meshBefore, const std::vector<Sphere>& spheres, const OccluderMesh& mesh);

/// Marks the spheres whose surfaces come within `reach` of a ball. In doubt, by rounding, they are
/// marked.
[[nodiscard]] std::vector<std::uint8_t> markWithin(
  const std::vector<Sphere>& spheres, const std::vector<Sphere>& balls, float reach);
}

#endif
