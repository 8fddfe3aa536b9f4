// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PackedTextures_h
#define po_PackedTextures_h

#include "ComponentLookup.h"
#include "PackedFormat.h"
#include "TexelLookup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Reads a table of textures of different lengths in place. It refers to the words of the caller.
class PackedTextures
{
public:
  /// Throws what PackedFormat::check throws.
  PackedTextures(const PackedFormat& format, const std::uint8_t* words, std::size_t count);

  [[nodiscard]] std::size_t words() const { return count_; }

  /// Words of the texture that begins at `first`; 0 if none can begin there.
  [[nodiscard]] std::size_t lengthAt(std::size_t first) const;

  /// What is looked up at the centres of T x T texels. The texture must begin there.
  void decode(std::size_t first, float* texture) const;

  /// Where the texture begins whose first word is `first`.
  [[nodiscard]] const std::uint8_t* code(std::size_t first) const
  {
    return words_ + PackedFormat::WordBytes * first;
  }

  /// Values of up to TexelLookup::Size textures.
  /// @param codes where they begin, see code()
  /// @param lookup with the texels found for the format's resolution
  /// @param lanes which direction of the lookup each is for
  void lookUp(const std::uint8_t* const* codes, const std::size_t* lanes, std::size_t count,
    const TexelLookup& lookup, float* values) const;

private:
  [[nodiscard]] float lookUpSize(const std::uint8_t* code, float u, float v) const;

  void addComponents(const std::uint8_t* code, std::size_t lane, const TexelLookup& lookup,
    ComponentBlock& block) const;

  [[nodiscard]] const float* basisAt(std::int32_t texel) const
  {
    return basis_.data() + static_cast<std::size_t>(texel) * stride_;
  }

  int resolution_;
  float maximum_;
  std::vector<int> sizes_;
  std::array<std::size_t, PackedFormat::HeaderMask + 1> lengths_{}; ///< words, by header
  std::vector<CoefficientLayout> layouts_;
  std::size_t stride_ = 0;   ///< floats of a texel of the basis
  std::vector<float> basis_; ///< [texel][mean, components]
  std::array<float, 256> decoded_{};
  const std::uint8_t* words_;
  std::size_t count_;
};
}

#endif
