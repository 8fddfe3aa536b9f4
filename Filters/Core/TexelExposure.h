// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelExposure_h
#define po_TexelExposure_h

#include "SweepTexels.h"
#include "TexelRims.h"

#include <cstdint>
#include <vector>

namespace po
{
/// Which points of a particle's texels lie outside all other spheres.
struct TexelExposure
{
  std::vector<GroupMask> bits;          ///< [TexelPatterns::Count][groups]
  std::vector<std::uint32_t> rimGroups; ///< those in which patterns may differ

  [[nodiscard]] const GroupMask* ofPattern(std::size_t pattern, std::size_t groups) const
  {
    return bits.data() + pattern * groups;
  }
};

/// Tests the points of all patterns in the texels that rims cross.
/// @param result is overwritten, and keeps its memory
void exposeTexels(const SweepTexels& texels, const TexelPatterns& patterns, const TexelRims& rims,
  TexelExposure& result);

/// The texels whose points of a pattern face a direction and lie outside all other spheres.
/// @param exposure empty where nothing overlaps the particle
/// @param mask one for each group
/// @return whether there are any
bool facingOutside(const FacingTexels& facing, const TexelExposure& exposure, std::size_t pattern,
  std::vector<GroupMask>& mask);
}

#endif
