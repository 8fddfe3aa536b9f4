// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MortonCurve_h
#define po_MortonCurve_h

#include "Vec3.h"

#include <cstdint>

namespace po
{
/// Maps positions in a cube to places along a Morton curve: what is near in space is mostly near on
/// it.
class MortonCurve
{
public:
  /// @param low the corner of the cube with the smallest coordinates
  /// @param extent its side; 0 puts all positions at one place
  MortonCurve(Vec3f low, float extent)
    : low_(low)
    , scale_(extent > 0 ? static_cast<float>((1 << 20) - 1) / extent : 0.0f)
  {
  }

  [[nodiscard]] std::uint64_t operator()(Vec3f p) const
  {
    const auto cell = [this](float offset)
    { return spread(static_cast<std::uint64_t>(offset * scale_)); };
    return cell(p.x - low_.x) | cell(p.y - low_.y) << 1 | cell(p.z - low_.z) << 2;
  }

private:
  /// Moves bit i of a number of 21 bits to bit 3 i.
  [[nodiscard]] static std::uint64_t spread(std::uint64_t bits)
  {
    bits = (bits | bits << 32) & 0x001F00000000FFFFu;
    bits = (bits | bits << 16) & 0x001F0000FF0000FFu;
    bits = (bits | bits << 8) & 0x100F00F00F00F00Fu;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3u;
    return (bits | bits << 2) & 0x1249249249249249u;
  }

  Vec3f low_;
  float scale_;
};
}

#endif
