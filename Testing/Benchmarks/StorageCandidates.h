// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_StorageCandidates_h
#define po_StorageCandidates_h

#include "OcclusionTextures.h"
#include "TexturePacker.h"
#include "TextureTable.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace po
{
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

/// One way to store them.
struct Candidate
{
  std::string name;
  double bytes = 0; ///< of all particles: textures, codebooks, and the index of 4 bytes
  std::function<void(std::size_t particle, float* texture)> decode;
  std::shared_ptr<const OcclusionTextures> textures; ///< to time lookups with, or null
  bool timeFrames = false;
};

/// The floats themselves.
[[nodiscard]] Candidate uncompressed(const Baked& baked);

/// Which ways are compared.
enum class Candidates
{
  All,        ///< which takes hours for 200,000 particles
  OfTheFilter ///< 8 bit, and the storages of the filter
};

/// The ways that are compared. They refer to `baked`.
[[nodiscard]] std::vector<Candidate> makeCandidates(const Baked& baked, Candidates which);

/// RMS difference from what was baked, over what is visible of all particles that light reaches.
[[nodiscard]] double differenceOf(const Baked& baked, const Candidate& candidate);
}

#endif
