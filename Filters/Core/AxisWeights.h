// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_AxisWeights_h
#define po_AxisWeights_h

#include "SweepTexels.h"

#include <array>
#include <cstddef>
#include <vector>

namespace po
{
/// Axes, of two opposite directions each, are swept in blocks of this many: in parallel, their
/// masks kept, then summed in order.
inline constexpr std::size_t AxesPerBlock = 8;

/// What a texel's point receives of an axis: it faces one of the two directions at most.
struct AxisWeights
{
  std::size_t pattern;        ///< of the points
  std::vector<GroupMask> lit; ///< [groups] texels that face a direction that is not black
  std::array<std::vector<GroupMask>, 2>
    facing;                  ///< [groups] those that face against the axis, along it; or empty
  std::vector<float> weight; ///< [slots] height over the horizon times luminance, 0 if not lit
};
}

#endif
