// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ComponentLookup_h
#define po_ComponentLookup_h

#include "PackedFormat.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Where the coefficients of one class lie, four at a time, as vector code takes them out: bytes of
/// a window of 16 are put in order, shifted and masked, and scaled.
struct CoefficientLayout
{
  struct Four
  {
    alignas(16) std::array<std::uint8_t, 16> bytes; ///< of the window, for each of four words
    alignas(16) std::array<std::uint32_t, 4> shift, mask;
    alignas(16) std::array<float, 4> scale, offset;
    std::size_t window; ///< first byte in the code
  };

  /// The mean comes first, with the coefficient 1.
  explicit CoefficientLayout(const std::vector<std::uint8_t>& bits);

  std::vector<Four> fours;
  std::size_t padded = 0; ///< 1 + components, a multiple of ComponentBlock::Pad
};

/// Bilinear lookups of a block of textures that are stored as coefficients.
struct ComponentBlock
{
  static constexpr std::size_t Size = 16;
  static constexpr std::size_t Pad = 16;

  std::size_t count = 0;
  std::array<const std::uint8_t*, Size> code;
  std::array<std::size_t, Size> words;
  std::array<const CoefficientLayout*, Size> layout;
  std::array<std::array<const float*, 4>, Size> texels; ///< rows of the basis, `padded` values each
  std::array<std::array<float, 4>, Size> weights;       ///< of the four texels
  std::array<float, Size> values;                       ///< the result
};

/// Decodes the coefficients of each texture, once for equal ones in succession, and sums up.
void lookUpComponents(ComponentBlock& block);
}

#endif
