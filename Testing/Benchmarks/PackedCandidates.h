// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PackedCandidates_h
#define po_PackedCandidates_h

// Ways to store textures in words of a packed table.

#include "StoredTextures.h"
#include "TexturePacker.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace po
{
/// Every texture by the same number of coefficients in a basis; dark ones as one value.
class FixedPacker : public TexturePacker
{
public:
  /// @param c class of the textures, which is their length (PackedFormat)
  /// @param bits of each coefficient
  FixedPacker(
    const Baked& baked, TextureBasis basis, std::size_t c, std::vector<std::uint8_t> bits);

  [[nodiscard]] Code pack(const WeighedTexture& texture) const override;

private:
  std::size_t class_;
  std::vector<TextureProjection> projection_;
};

/// @param size bytes of the table and its basis, or negative: as packed
[[nodiscard]] Candidate byPacker(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double size = -1);

/// Packed textures, in whose place one that is there already is taken where it differs by no more
/// than is allowed.
[[nodiscard]] Candidate packedNearEqual(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double allowed);

/// By all components of a basis, a byte each.
[[nodiscard]] Candidate byCoefficients(
  const Baked& baked, const std::string& name, const TextureBasis& basis);

[[nodiscard]] TextureBasis firstComponents(TextureBasis basis, std::size_t count);
}

#endif
