// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereCloud_h
#define po_SphereCloud_h

#include "ProcessGroup.h"
#include "Sphere.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace po
{
/// Why particles were left out of a cloud; each particle is counted once, under the first reason.
struct RejectedParticles
{
  std::size_t nonFinitePosition = 0; ///< a coordinate is NaN or infinite
  std::size_t nonFiniteRadius = 0;   ///< the radius is NaN or infinite
  std::size_t nonPositiveRadius = 0; ///< the radius is zero or negative
  std::size_t outOfRange = 0;        ///< too far or too small for a float beside the mean radius

  [[nodiscard]] std::size_t total() const
  {
    return nonFinitePosition + nonFiniteRadius + nonPositiveRadius + outOfRange;
  }

  /// Of all processes.
  [[nodiscard]] RejectedParticles summed(const ProcessGroup& group) const;
};

/// Spheres made ready for single-precision ray tracing.
///
/// Float arithmetic loses the surface of a small sphere far from the origin, so positions are taken
/// relative to the middle of the cloud (subtracted in double) and divided by the mean radius (by
/// the medians where otherwise some would be out of range, so that those alone are left out):
/// local = (world - origin) / scale. All lengths that enter ray tracing are local. In a cloud that
/// is some thousand radii wide floats are too coarse all the same: see SphereSet.
struct SphereCloud
{
  Vec3d origin;                ///< world position of the local origin
  double scale = 1;            ///< world length of one local unit: the mean radius
  std::vector<Sphere> spheres; ///< the usable spheres, in input order, local
  std::vector<Vec3d> centers;  ///< theirs in full, local, where floats are too coarse; or empty
  std::vector<std::int64_t> sourceIds; ///< index of each sphere in the input
  /// Flags by sphere: copies of particles that another process, or another block, has. Empty where
  /// nobody asked.
  std::vector<std::uint8_t> ghosts;
  /// What random numbers of each sphere are seeded by; empty: by the spheres themselves.
  std::vector<std::uint64_t> ids;
  RejectedParticles rejected;

  /// Local, in full.
  [[nodiscard]] Vec3d center(std::size_t i) const
  {
    return centers.empty() ? spheres[i].center().as<double>() : centers[i];
  }

  /// Is a point of these local coordinates near enough for ray tracing in floats?
  [[nodiscard]] static bool inRange(Vec3d local);

  /// Divides: the inverse of a denormal scale would be infinite.
  [[nodiscard]] Vec3d toLocal(Vec3d world) const
  {
    const Vec3d d = world - origin;
    return { d.x / scale, d.y / scale, d.z / scale };
  }
  [[nodiscard]] Vec3d toWorld(Vec3d local) const { return origin + scale * local; }

  /// A bound on distances as a local length: infinite where there is none.
  /// @param maximumDistance in the world; 0 = unbounded
  [[nodiscard]] float toLocalReach(double maximumDistance) const;
};

/// Particles as they come: functions of their index, below `count`.
struct ParticleSource
{
  std::size_t count;
  std::function<Vec3d(std::size_t)> positionAt;  ///< in the world
  std::function<double(std::size_t)> radiusAt;   ///< in the world; any number
  std::function<bool(std::size_t)> isGhost = {}; ///< see SphereCloud::ghosts; empty: none is
};

/// How the origin and the scale of a cloud follow from its particles.
enum class FrameFit
{
  Exact, ///< the middle and the mean radius
  /// These rounded, to a power of two: the scale by up to a factor of sqrt(2), the origin by up to
  /// the half width of the cloud. The frame mostly stays when particles move, and with it the
  /// floats of those that rest.
  Steady
};

/// Gathers the usable particles. Origin and scale are those of all particles of the group together,
/// ghosts aside, with the same bits however these are distributed and ordered.
[[nodiscard]] SphereCloud makeSphereCloud(const ParticleSource& source,
  const ProcessGroup& group = ProcessGroup::alone(), FrameFit fit = FrameFit::Exact);

/// The same in the local coordinates of another cloud, for spheres that share a scene with it.
[[nodiscard]] SphereCloud makeSphereCloudLike(
  const SphereCloud& other, const ParticleSource& source);

/// The same as makeSphereCloud, without ghosts.
[[nodiscard]] SphereCloud makeSphereCloud(std::size_t count,
  const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt);
}

#endif
