// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelExposure_h
#define po_TexelExposure_h

#include "OverlapFinder.h"
#include "SweepTexels.h"

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

/// Tests the points of all patterns against the caps; a texel that no rim crosses takes one test.
[[nodiscard]] TexelExposure exposeTexels(
  const SweepTexels& texels, const TexelPatterns& patterns, const std::vector<BuriedCap>& caps);
}

#endif
