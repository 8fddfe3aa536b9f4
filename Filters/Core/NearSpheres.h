// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_NearSpheres_h
#define po_NearSpheres_h

#include "SharedDirections.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Spheres around a particle, laid out so that many are projected at once. Lengths are in radii of
/// the particle, places relative to its centre.
class NearSpheres
{
public:
  static constexpr std::size_t BlockSize = 16; ///< at most OccluderBatch::Most

  /// A block of spheres, seen along a direction.
  struct Projection
  {
    std::array<float, BlockSize> a, b;   ///< centres across
    std::array<float, BlockSize> height; ///< centres towards the light
    /// Not 0 where a sphere may hide texels: its centre lies ahead of the particle's, and the discs
    /// of both meet.
    std::array<std::uint32_t, BlockSize> meets;
  };

  void clear();
  void add(Vec3f center, float radius);

  [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
  void project(std::size_t block, const SharedDirection& direction, Projection& projection) const;
  [[nodiscard]] float squaredRadius(std::size_t block, std::size_t place) const
  {
    return blocks_[block].squaredRadius[place];
  }

private:
  struct Block
  {
    std::array<float, BlockSize> x, y, z;
    std::array<float, BlockSize> squaredRadius;
    std::array<float, BlockSize> squaredTouch; ///< of (1 + radius); 0 in empty places
  };

  std::size_t size_ = 0;
  std::vector<Block> blocks_;
};
}

#endif
