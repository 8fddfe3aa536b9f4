// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Dilation_h
#define po_Dilation_h

#include <cstdint>
#include <vector>

namespace po
{
/// Which texels touch which on the sphere, for textures of one resolution.
///
/// Columns wrap in azimuth. Over a pole a texel touches the texels on the other side of it: the
/// polar row's columns half a turn away.
class TexelNeighbours
{
public:
  explicit TexelNeighbours(int resolution);

  [[nodiscard]] int resolution() const { return resolution_; }

  /// The texels that share an edge or a corner with a texel: each once, never itself.
  [[nodiscard]] const std::vector<std::uint32_t>& of(std::size_t texel) const
  {
    return neighbours_[texel];
  }

private:
  int resolution_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
};

/// Gives texels that have no value of their own the mean of their neighbours, ring by ring.
///
/// Without it bilinear lookup would darken the visible rim of an overlap. The result does not
/// depend on the order of the texels: a ring sees only the rings before it.
///
/// @param values T * T values; those with known = 0 are replaced (by 0 if no texel is known)
/// @param known T * T flags: 1 where the value counts; all 1 afterwards if any was
void dilate(const TexelNeighbours& neighbours, float* values, std::vector<std::uint8_t>& known);
}

#endif
