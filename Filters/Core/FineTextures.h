// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FineTextures_h
#define po_FineTextures_h

#include "SweepTexels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// What is known of the fine texels of a particle, [slots] each.
struct FineTexels
{
  const float* outside;    ///< shares of their area
  const float* irradiance; ///< of the outside part, were it open
  const float* sums;       ///< weights of the directions that are seen
  const float* weights;    ///< of all directions
};

/// Makes textures each of whose texels is one of the fine texels.
class FineTextures
{
public:
  explicit FineTextures(const SweepTexels& texels);

  /// See TextureFormula::fill().
  void fill(const FineTexels& texels, float* values, float* shares) const;

  /// Texels of a group that follow each other in the texture.
  struct Row
  {
    std::uint32_t texel; ///< the first
    std::uint32_t count; ///< 0 to PatchSide
  };

private:
  std::vector<Row> rows_; ///< [groups][PatchSide]
};
}

#endif
