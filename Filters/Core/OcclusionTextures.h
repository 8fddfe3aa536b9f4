// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionTextures_h
#define po_OcclusionTextures_h

#include "PackedTextures.h"
#include "TexelLookup.h"
#include "TexelMap.h"
#include "Vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace po
{
/// A table of baked textures and which particle has which, as the renderer reads it. It refers to
/// arrays of the caller.
class OcclusionTextures
{
public:
  /// No textures: every value is 1.
  OcclusionTextures() = default;

  /// Only mean values, one a particle, or null for 1 everywhere.
  explicit OcclusionTextures(const float* means)
    : means_(means)
  {
  }

  /// Bytes stand for maximum * (byte / 255)^2. Textures have resolution^2 values, see TexelMap.h.
  /// @param rows texture of each particle; negative: the particle has only its mean
  /// @param means mean value of each particle, or null: 1
  OcclusionTextures(int resolution, const std::uint8_t* bytes, double maximum,
    const std::int32_t* rows, const float* means);

  /// Values are stored as they are.
  OcclusionTextures(
    int resolution, const float* values, const std::int32_t* rows, const float* means);

  /// Textures of different lengths.
  /// @param rows first word of each particle's texture, where one must begin
  OcclusionTextures(std::shared_ptr<const PackedTextures> packed, int resolution,
    const std::int32_t* rows, const float* means);

  /// Is every value 1?
  [[nodiscard]] bool empty() const { return !bytes_ && !values_ && !packed_ && !means_; }

  /// Bilinear value where `direction` (of any length) leaves the particle's centre. The texels are
  /// decoded first, so that the interpolation is one of light, not of code values.
  [[nodiscard]] float at(std::size_t particle, Vec3f direction) const;

  /// Values that lookUp() finds at once.
  static constexpr std::size_t BlockSize = TexelLookup::Size;

  /// The same for up to BlockSize particles.
  void lookUp(
    const std::int64_t* particles, const Vec3f* directions, std::size_t count, float* values) const;

private:
  /// Looks up those lanes whose particles have a texture.
  void lookUpTexels(const std::int64_t* particles, std::size_t count, const TexelLookup& lookup,
    float* values) const;
  void lookUpPacked(const std::int64_t* particles, std::size_t count, const TexelLookup& lookup,
    float* values) const;

  [[nodiscard]] bool hasTexture(std::int64_t particle) const
  {
    return rows_ && rows_[particle] >= 0;
  }

  [[nodiscard]] float texel(std::size_t first, std::int32_t row, std::int32_t column) const
  {
    const std::size_t i = first + texelIndex(resolution_, row, column);
    return bytes_ ? decoded_[bytes_[i]] : values_[i];
  }

  int resolution_ = 0;
  const std::uint8_t* bytes_ = nullptr;
  const float* values_ = nullptr;
  std::shared_ptr<const PackedTextures> packed_;
  const std::int32_t* rows_ = nullptr;
  const float* means_ = nullptr;
  std::array<float, 256> decoded_{};
};
}

#endif
