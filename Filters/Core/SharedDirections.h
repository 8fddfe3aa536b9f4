// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedDirections_h
#define po_SharedDirections_h

#include "Background.h"
#include "SweepDirections.h"
#include "SweepTexels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// A direction along which all particles look for the background.
struct SharedDirection
{
  SharedDirection(const SweepTexels& texels, const TexelPatterns& patterns, std::size_t pattern,
    Vec3d towardsLight, double luminance);

  Vec3d towardsLight;  ///< unit vector
  PlaneBasis basis;    ///< across
  std::size_t pattern; ///< the points of the texels that look along it
  std::size_t index;   ///< its place among all directions of the bake; black ones count
  FacingTexels facing;
  std::vector<float> weight;     ///< [slots] height over the horizon times luminance, 0 below
  std::vector<Vec3f> normals;    ///< [slots] at the points that look along it
  std::vector<float> importance; ///< [slots] a texel's area, steradians, times its weight
};

/// Directions that all particles share, with what is the same for all of them. Each looks at
/// another point of every texel.
class SharedDirections
{
public:
  /// More than this do not go into one set: beyond, texels need new points to look at.
  static constexpr std::size_t MaximumSize = 4 * TexelPatterns::Count;

  /// @param axes at most MaximumSize / 2, of two opposite directions each
  /// @param first the number of directions in all sets before this one
  /// @param epoch number of the set: those of different numbers look at different points
  SharedDirections(const SweepTexels& texels, const Background& background,
    const std::vector<Vec3d>& axes, std::size_t first, std::uint64_t seed, std::uint32_t epoch);

  [[nodiscard]] const TexelPatterns& patterns() const { return patterns_; }

  /// Those in which the background is not black.
  [[nodiscard]] const std::vector<SharedDirection>& directions() const { return directions_; }
  [[nodiscard]] std::size_t black() const { return black_; }

private:
  TexelPatterns patterns_;
  std::vector<SharedDirection> directions_;
  std::size_t black_ = 0;
};
}

#endif
