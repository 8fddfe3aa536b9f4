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

  // The four texels: columns wrapped, rows clamped. Weights are those of the second ones.
  alignas(64) std::int32_t column0[Size], column1[Size], row0[Size], row1[Size];
  alignas(64) float columnWeight[Size], rowWeight[Size];
};

/// Fills in texels and weights. Positions on the texture are right to 3e-7 of its width and height,
/// one 50,000th of a texel at a resolution of 64.
void findTexels(int resolution, TexelLookup& lookup);
}

#endif
