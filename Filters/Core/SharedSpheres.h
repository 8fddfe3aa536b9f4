// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedSpheres_h
#define po_SharedSpheres_h

// From the spheres that each process has to those that its particles can see.

#include "OccluderMesh.h"
#include "ProcessGroup.h"
#include "Sphere.h"
#include "SphereCloud.h"

#include <cstdint>
#include <vector>

namespace po
{
/// What a process can meet within a distance of its own spheres.
struct Neighbourhood
{
  /// Distance of surfaces, local, beyond which nothing matters; infinite when unbounded.
  float reach;
  /// Boxes of the processes' spheres, widened by it: x, y, z of the low corner and of the high one.
  /// Empty where the distance is unbounded, or a process is alone: everything is wanted.
  std::vector<double> boxes;

  Neighbourhood(const std::vector<Sphere>& own, float reach, const ProcessGroup& group);

  /// May what lies in the box from `low` to `high` matter to a process?
  [[nodiscard]] bool matters(std::size_t process, Vec3f low, Vec3f high) const;
};

/// Spheres of all processes, in an order that depends on the spheres alone: not on who has which,
/// nor on the order in which they were read.
struct SharedSpheres
{
  std::vector<Sphere> spheres;
  std::vector<Vec3d> centers;   ///< in full, if any process has such; else empty
  std::vector<unsigned> places; ///< of each own sphere; ghosts and coinciding ones share a place
};

/// Gathers the spheres that matter to this process: 16 bytes of each travel, 40 of a set that is
/// wider than floats. Own ones are always among them.
///
/// @param own local, in a frame that all processes share
/// @param ghosts flags by own sphere, or empty: copies of spheres that another process has. One
/// whose original is nowhere counts as a sphere, once.
/// @param centers of the own spheres in full, or none (see SphereSet)
/// @param fit with Steady the others mostly keep their order when the outermost spheres move
[[nodiscard]] SharedSpheres shareSpheres(std::vector<Sphere> own,
  const std::vector<std::uint8_t>& ghosts, const Neighbourhood& neighbourhood,
  const ProcessGroup& group, const std::vector<Vec3d>& centers = {},
  FrameFit fit = FrameFit::Exact);

/// The spheres and triangles that only occlude, of all processes, as far as they matter to this
/// one.
[[nodiscard]] Occluders shareOccluders(
  Occluders own, const Neighbourhood& neighbourhood, const ProcessGroup& group, FrameFit fit);
}

#endif
