// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PixelShader_h
#define po_PixelShader_h

#include "PixelBlock.h"
#include "Shading.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Colours pixels, tile by tile. What few scenes need, such as the direction of view (for
/// highlights) or the place of the hit (for lights that have a place), is computed only for those.
class PixelShader
{
public:
  explicit PixelShader(const ShadingInput& input);

  /// @param rgba of the whole frame
  void shade(const PixelRange& tile, std::uint8_t* rgba) const;

private:
  /// A light as pixels see it, where it is the same for all of them.
  struct PreparedLight
  {
    const Light* light;
    const std::uint8_t* mask; ///< or null: it reaches all pixels
    Vec3f toLightLocal; ///< of a light without a place: its product with a local normal is that in
                        ///< world space
  };

  /// Pixels of one row of a tile, and what they show.
  struct Row
  {
    int x, y; ///< of the first pixel
    std::size_t pixel, count;
    bool any;               ///< do they show anything?
    OcclusionLookup lookup; ///< particles, if they are needed, and normals
    alignas(64) std::int32_t shown[PixelBlock::Size]; ///< 1: a sphere, 0: nothing
  };

  void prepare(std::size_t light);
  void load(const PixelRange& tile, int y, Row& row) const;
  [[nodiscard]] std::int64_t particleOf(std::uint32_t sphere) const;
  void shade(const Row& row, std::uint8_t* rgba) const;
  void loadColors(const Row& row, PixelBlock& block) const;
  void loadParticleColor(const std::uint8_t* rgba, std::size_t lane, PixelBlock& block) const;
  void gatherLight(const Row& row, PixelBlock& block) const;
  void gatherParallel(const Row& row, PixelBlock& block) const;
  void gatherAt(int x, int y, std::size_t pixel, std::size_t lane, PixelBlock& block) const;
  [[nodiscard]] float highlight(const Light& light, Vec3f toLight, Vec3f normal, Vec3f view) const;
  [[nodiscard]] Vec3f normalInWorld(Vec3f n) const;

  const ShadingInput& in_;
  ColorTerms terms_;
  std::vector<PreparedLight> lights_;
  std::array<float, 9> toLocal_{}; ///< linear part of worldToLocal, by rows, scaled
  bool usesOcclusion_;
  bool needsParticles_;
  bool needsPoint_ = false;
  bool needsView_;
  bool isParallel_ = false; ///< see gatherParallel
};
}

#endif
