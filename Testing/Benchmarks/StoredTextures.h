// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_StoredTextures_h
#define po_StoredTextures_h

#include "OcclusionTextures.h"
#include "TextureTable.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace po
{
/// What says of a particle which texture it has.
constexpr double IndexBytes = 4;

/// Textures as they were baked, in floats.
struct Baked
{
  int resolution = 0;
  TextureTable table{ 1, 0 };
  std::vector<std::int32_t> rowOf; ///< of each particle
  std::vector<float> mean;         ///< of each particle
  double maximum = 0;
  double noise = 0; ///< RMS error that the bake has at least
};

/// Of each texture.
[[nodiscard]] std::size_t texelsOf(const Baked& baked);

/// The values of a row of the table.
[[nodiscard]] const float* textureOf(const Baked& baked, std::size_t row);

[[nodiscard]] TextureTable copyOf(const Baked& baked);

/// One way to store them.
struct Candidate
{
  std::string name;
  double bytes = 0; ///< of all particles: textures, codebooks, and the index of 4 bytes
  std::function<void(std::size_t particle, float* texture)> decode;
  std::shared_ptr<const OcclusionTextures> textures; ///< to time lookups with, or null
  bool timeFrames = false;
};
}

#endif
