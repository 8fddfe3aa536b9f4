// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureSample_h
#define po_TextureSample_h

#include "ProcessGroup.h"
#include "TextureTable.h"

#include <cstddef>
#include <vector>

namespace po
{
/// Textures drawn at random from those of all processes.
struct TextureSample
{
  std::vector<float> values; ///< T * T each
  double population = 0;     ///< distinct textures there are, about
};

/// Draws the distinct textures with the smallest hashes (a bottom-k sketch), without those of one
/// value: the same ones in the same order on each process, whoever has them and how often.
/// Throws WorkStopped.
[[nodiscard]] TextureSample sampleTextures(
  const TextureTable& table, std::size_t most, const ProcessGroup& group);
}

#endif
