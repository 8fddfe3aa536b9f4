// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelLookup_h
#define po_TexelLookup_h

#include <cstddef>
#include <cstdint>

namespace po
{
/// Bilinear lookups in textures of one resolution for a block of directions, in vector code; see
/// TexelMap.h for the texture and textureCoordinate() for the exact map.
struct TexelLookup
{
  static constexpr std::size_t Size = 16;

  // Directions of any length but zero.
  alignas(64) float x[Size], y[Size], z[Size];

  // Position on the texture, see TextureCoordinate: 0 to 1, which rounding may take u to.
  alignas(64) float u[Size], v[Size];

  /// Indices of the four texels, columns wrapped and rows clamped: two neighbours in one row, then
  /// the two of the next row.
  alignas(64) std::int32_t texel[4][Size];

  // Shares of the second column and of the second row.
  alignas(64) float columnWeight[Size], rowWeight[Size];
};

/// Values of the four texels of each direction.
struct TexelCorners
{
  alignas(64) float value[4][TexelLookup::Size];
};

/// Fills in texels and weights. Positions on the texture are right to 3e-7 of its width and height,
/// one 50,000th of a texel at a resolution of 64.
void findTexels(int resolution, TexelLookup& lookup);

/// Bilinear values; where the four are equal, that value exactly.
void interpolateTexels(const TexelCorners& corners, const TexelLookup& lookup, float* values);
}

#endif
