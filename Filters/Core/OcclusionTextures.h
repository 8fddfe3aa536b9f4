// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionTextures_h
#define po_OcclusionTextures_h

#include "PackedTextures.h"
#include "PagedTextures.h"
#include "TexelLookup.h"
#include "TexelMap.h"
#include "Vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace po
{
/// How the texels of textures of one length are stored.
struct TexelFormat
{
  int resolution = 0; ///< T: a texture has T * T texels, see TexelMap.h
  bool bytes = true;  ///< a byte a texel, for maximum * (byte / 255)^2; else floats, as they are
  double maximum = 1; ///< of bytes

  [[nodiscard]] std::size_t textureBytes() const
  {
    return texelIndex(resolution, resolution, 0) * (bytes ? 1 : sizeof(float));
  }
};

/// Lookups for a block of directions, on their way.
struct OcclusionLookup
{
  static constexpr std::size_t Size = TexelLookup::Size;

  std::array<std::int64_t, Size> particles; ///< negative: none, any value
  TexelLookup texels;                       ///< x, y and z are the directions, of any length
  std::array<const void*, Size> textures;   ///< where they begin, or null: the mean
};

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

  /// Textures of which only some are in memory: the particles of the others have only their means
  /// until they are.
  OcclusionTextures(std::shared_ptr<PagedTextures> paged, const TexelFormat& format,
    const std::int32_t* rows, const float* means);

  /// Is every value 1?
  [[nodiscard]] bool empty() const { return !texels_ && !packed_ && !paged_ && !means_; }

  /// Where textures come from that are loaded while they are seen; null if all are there.
  [[nodiscard]] const std::shared_ptr<PagedTextures>& paged() const { return paged_; }

  /// Texture of a particle; negative: it has only its mean.
  [[nodiscard]] std::int32_t rowOf(std::int64_t particle) const
  {
    return rows_ && particle >= 0 ? rows_[particle] : -1;
  }

  /// Bilinear value where `direction` (of any length) leaves the particle's centre. The texels are
  /// decoded first, so that the interpolation is one of light, not of code values.
  [[nodiscard]] float at(std::size_t particle, Vec3f direction) const;

  // The same for a block in three steps. Textures of particles side by side may lie far apart in
  // memory: who has many blocks takes each step for all of them before the next one, so that memory
  // has time to answer.

  /// Asks memory for the rows of the particles.
  void request(const OcclusionLookup& lookup) const;
  /// Finds the texels and asks memory for them.
  void locate(OcclusionLookup& lookup) const;
  /// @param values OcclusionLookup::Size of them
  void finish(const OcclusionLookup& lookup, float* values) const;

private:
  void finishPacked(const OcclusionLookup& lookup, float* values) const;
  template <typename TextureOf>
  void locate(OcclusionLookup& lookup, std::size_t texelBytes, const TextureOf& textureOf) const;
  template <typename Decode>
  void interpolate(const OcclusionLookup& lookup, const Decode& decode, float* values) const;

  void decodeBytes();

  TexelFormat format_;
  const void* texels_ = nullptr; ///< of all textures, one after the other
  std::shared_ptr<const PackedTextures> packed_;
  std::shared_ptr<PagedTextures> paged_;
  const std::int32_t* rows_ = nullptr;
  const float* means_ = nullptr;
  std::array<float, 256> decoded_{};
};
}

#endif
