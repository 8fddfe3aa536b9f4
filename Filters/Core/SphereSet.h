// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereSet_h
#define po_SphereSet_h

#include "Sphere.h"

#include <cstddef>
#include <vector>

namespace po
{
/// A part of a set of spheres, with an origin of its own from which floats tell places apart.
struct Brick
{
  Vec3d origin;
  Vec3d low, high;       ///< what holds the spheres, in the coordinates of the set
  const Sphere* spheres; ///< relative to the origin, [count]
  std::size_t count;
  const unsigned* ids; ///< of the spheres in the set, [count]; null in the only brick of a set

  [[nodiscard]] unsigned id(unsigned place) const { return ids == nullptr ? place : ids[place]; }
};

/// The spheres of a scene, all lengths local (see SphereCloud).
///
/// Where one frame of floats is too coarse, since the set is more than some thousand radii wide,
/// centres are known in double precision too, and the set is cut into bricks: boxes of up to
/// LargestBrick mean radii to each side, as long as there are few of them; the sizes of more follow
/// from the spheres that they hold. Work near a particle is done relative to its brick. A set
/// without such centres is one brick, whose origin is that of the set.
class SphereSet
{
public:
  /// Half the width, in mean radii. Floats are then right to 1/8000 of a mean radius.
  static constexpr double LargestBrick = 4096;
  static constexpr std::size_t MostBricks = 64;

  /// @param centers in full, one a sphere; none if those of the spheres are good enough
  explicit SphereSet(std::vector<Sphere> spheres, std::vector<Vec3d> centers = {});
  SphereSet(SphereSet&&) = default;
  SphereSet(const SphereSet&) = delete;
  SphereSet& operator=(const SphereSet&) = delete;

  [[nodiscard]] std::size_t size() const { return spheres_.size(); }

  /// All relative to the origin of the set: coarse where there are several bricks.
  [[nodiscard]] const std::vector<Sphere>& spheres() const { return spheres_; }

  /// In full; empty where those of the spheres are good enough.
  [[nodiscard]] const std::vector<Vec3d>& centers() const { return centers_; }
  [[nodiscard]] Vec3d center(unsigned id) const
  {
    return centers_.empty() ? spheres_[id].center().as<double>() : centers_[id];
  }

  /// At least one.
  [[nodiscard]] const std::vector<Brick>& bricks() const { return bricks_; }
  [[nodiscard]] std::size_t brickOf(unsigned id) const
  {
    return brickOf_.empty() ? 0 : brickOf_[id];
  }

  /// A sphere relative to the origin of its own brick.
  [[nodiscard]] Sphere inBrick(unsigned id) const;

private:
  void cut();
  void addBrick(const std::vector<unsigned>& ids);

  std::vector<Sphere> spheres_;
  std::vector<Vec3d> centers_;
  std::vector<Sphere> relative_; ///< brick by brick
  std::vector<unsigned> ids_;    ///< of these
  std::vector<unsigned char> brickOf_;
  std::vector<Brick> bricks_;
};
}

#endif
