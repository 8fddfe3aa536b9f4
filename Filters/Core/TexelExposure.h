// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelExposure_h
#define po_TexelExposure_h

#include "OverlapFinder.h"
#include "SweepTexels.h"

#include <cstdint>
#include <vector>

namespace po
{
/// Which points of a particle's texels lie outside all other spheres. Points are told apart only in
/// the groups that the rim of an overlap crosses.
struct TexelExposure
{
  /// [groups] 0 for texels that lie inside one other sphere with all of their area
  std::vector<GroupMask> outside;
  std::vector<std::uint32_t> rimGroups;
  /// [TexelPatterns::Count][rimGroups]
  std::vector<GroupMask> rim;

  /// Clears the bits of points that are inside; false if none is left.
  bool clearInside(std::size_t pattern, GroupMask* mask) const
  {
    unsigned left = 0;
    for (std::size_t g = 0; g < outside.size(); ++g)
    {
      mask[g] = static_cast<GroupMask>(mask[g] & outside[g]);
    }
    for (std::size_t i = 0; i < rimGroups.size(); ++i)
    {
      GroupMask& group = mask[rimGroups[i]];
      group = static_cast<GroupMask>(group & rim[pattern * rimGroups.size() + i]);
    }
    for (std::size_t g = 0; g < outside.size(); ++g)
    {
      left |= mask[g];
    }
    return left != 0;
  }
};

/// Tests the points of all patterns against the caps; a texel that no rim crosses takes one test.
[[nodiscard]] TexelExposure exposeTexels(
  const SweepTexels& texels, const TexelPatterns& patterns, const std::vector<BuriedCap>& caps);
}

#endif
