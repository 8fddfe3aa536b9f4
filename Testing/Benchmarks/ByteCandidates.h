// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ByteCandidates_h
#define po_ByteCandidates_h

// Ways to store textures that have a byte or less a texel.

#include "StoredTextures.h"

#include <cstddef>
#include <vector>

namespace po
{
[[nodiscard]] Candidate plainBytes(const Baked& baked);

/// Textures that differ by no more than is allowed are stored once.
[[nodiscard]] Candidate nearEqual(const Baked& baked, double allowed);

/// A codebook by Lloyd's iteration on a sample; textures go to the nearest word.
[[nodiscard]] Candidate vectorQuantization(
  const Baked& baked, const std::vector<float>& sample, std::size_t words);

/// Blocks of 4 x 4 texels: the least and the largest value as bytes, 4 bits a texel between them.
[[nodiscard]] Candidate fourBits(const Baked& baked);
}

#endif
