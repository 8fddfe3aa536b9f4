// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelRims_h
#define po_TexelRims_h

#include "SweepTexels.h"

#include <cstddef>
#include <cstdint>

namespace po
{
/// A cap of the unit sphere: normal . axis > cosine.
struct RimCap
{
  Vec3f axis;
  float cosine;
};

/// Some of an array of caps, by their places in it.
struct CapList
{
  const RimCap* caps;
  const std::uint32_t* first;
  const std::uint32_t* last;
};

/// A group of texels that rims of caps cross.
struct RimGroup
{
  std::uint16_t group;
  GroupMask crossed; ///< the texels that are crossed and not inside
  std::uint32_t end; ///< of its places in TexelRims::capOf, which begin where those before it end
};

/// What of a particle's texels lies outside all other spheres, whatever points are looked at: a
/// texel that a cap covers is inside; of one that a rim crosses each point must be tested, against
/// the caps of these rims alone; what is left is outside. It names memory of others.
struct TexelRims
{
  const GroupMask* outside = nullptr; ///< [groups] texels that no cap covers as a whole
  const RimGroup* rims = nullptr;     ///< [count] by group
  std::size_t count = 0;
  const std::uint32_t* capOf = nullptr; ///< rims by rim: places in caps
  const RimCap* caps = nullptr;         ///< those whose rims cross texels that are not inside

  [[nodiscard]] std::size_t firstCap(std::size_t rim) const
  {
    return rim == 0 ? 0 : rims[rim - 1].end;
  }
  /// Those of one of the rim groups, counted among these.
  [[nodiscard]] CapList capsOf(std::size_t rim) const
  {
    return { caps, capOf + firstCap(rim), capOf + rims[rim].end };
  }
};
}

#endif
