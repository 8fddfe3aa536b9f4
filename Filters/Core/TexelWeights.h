// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelWeights_h
#define po_TexelWeights_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// What the texels of a particle count for when its texture is stored in fewer bytes: as much of
/// the area outside other particles as takes its value from them.
///
/// A point takes its value from the four texels around it, by bilinear interpolation. So a texel's
/// weight is the outside share of the area around it, averaged under the tent of its interpolation:
/// 6/8 of its own share in each axis and 1/8 of both neighbours'. Weights are bytes, in 255ths of
/// what a texel of a whole particle counts for, and at least 1: what nobody sees stays near to what
/// dilation has put there, as far as that costs nothing.
class TexelWeights
{
public:
  static constexpr std::uint8_t Whole = 255;

  explicit TexelWeights(int resolution);

  /// @param shares [T * T] of the texels' area outside other particles
  /// @return [T * T], good until the next call; null where all are whole
  [[nodiscard]] const std::uint8_t* of(const float* shares);

private:
  std::size_t side_;
  std::vector<float> rows_;
  std::vector<std::uint8_t> weights_;
};

/// A texture and what its texels count for.
struct WeighedTexture
{
  const float* values;         ///< [T * T], linear
  const std::uint8_t* weights; ///< [T * T], see TexelWeights; null: all are whole
};

/// Of bytes; the same in every process of a bake.
[[nodiscard]] std::size_t hashOfBytes(const void* bytes, std::size_t count);

/// Of values and weights.
[[nodiscard]] std::size_t hashOf(const WeighedTexture& texture, std::size_t texels);

/// Do all texels have the same value?
[[nodiscard]] bool hasOneValue(const float* texture, std::size_t texels);
}

#endif
