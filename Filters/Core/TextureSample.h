// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureSample_h
#define po_TextureSample_h

#include "ProcessGroup.h"
#include "TextureTable.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Textures drawn at random from those of all processes.
struct TextureSample
{
  std::vector<float> values; ///< T * T each
  std::vector<std::uint8_t>
    weights;             ///< T * T each, TexelWeights::Whole for those of whole particles
  double population = 0; ///< distinct textures there are, about

  [[nodiscard]] std::size_t size(std::size_t texels) const { return values.size() / texels; }
  [[nodiscard]] WeighedTexture texture(std::size_t i, std::size_t texels) const;
  [[nodiscard]] bool isWhole() const; ///< are all texels?
};

/// Draws the distinct textures with the smallest hashes (a bottom-k sketch), without those of one
/// value: the same ones in the same order on each process, whoever has them and how often.
/// Throws WorkStopped.
[[nodiscard]] TextureSample sampleTextures(
  const TextureTable& table, std::size_t most, const ProcessGroup& group);
}

#endif
