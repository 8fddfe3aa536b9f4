// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextures.h"

#include "Gamma2.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <utility>

namespace po
{
OcclusionTextures::OcclusionTextures(int resolution, const std::uint8_t* bytes, double maximum,
  const std::int32_t* rows, const float* means)
  : format_{ resolution, true, maximum }
  , texels_(bytes)
  , rows_(rows)
  , means_(means)
{
  decodeBytes();
}

OcclusionTextures::OcclusionTextures(
  int resolution, const float* values, const std::int32_t* rows, const float* means)
  : format_{ resolution, false }
  , texels_(values)
  , rows_(rows)
  , means_(means)
{
}

OcclusionTextures::OcclusionTextures(std::shared_ptr<const PackedTextures> packed, int resolution,
  const std::int32_t* rows, const float* means)
  : format_{ resolution }
  , packed_(std::move(packed))
  , rows_(rows)
  , means_(means)
{
}

OcclusionTextures::OcclusionTextures(std::shared_ptr<PagedTextures> paged,
  const TexelFormat& format, const std::int32_t* rows, const float* means)
  : format_(format)
  , paged_(std::move(paged))
  , rows_(rows)
  , means_(means)
{
  decodeBytes();
}

void OcclusionTextures::decodeBytes()
{
  for (std::size_t code = 0; code < decoded_.size(); ++code)
  {
    decoded_[code] =
      static_cast<float>(decodeGamma2(static_cast<std::uint8_t>(code), format_.maximum));
  }
}

float OcclusionTextures::at(std::size_t particle, Vec3f direction) const
{
  OcclusionLookup lookup;
  lookup.particles.fill(-1);
  lookup.particles[0] = static_cast<std::int64_t>(particle);
  std::fill_n(lookup.texels.x, OcclusionLookup::Size, direction.x);
  std::fill_n(lookup.texels.y, OcclusionLookup::Size, direction.y);
  std::fill_n(lookup.texels.z, OcclusionLookup::Size, direction.z);
  std::array<float, OcclusionLookup::Size> values;
  locate(lookup);
  finish(lookup, values.data());
  return values[0];
}

void OcclusionTextures::request(const OcclusionLookup& lookup) const
{
  for (const std::int64_t particle : lookup.particles)
  {
    if (rows_ && particle >= 0)
    {
      hwy::Prefetch(rows_ + particle);
    }
  }
}

void OcclusionTextures::locate(OcclusionLookup& lookup) const
{
  if (!rows_)
  {
    lookup.textures.fill(nullptr);
    return;
  }
  findTexels(format_.resolution, lookup.texels);
  const std::size_t texelBytes = format_.bytes ? 1 : sizeof(float);
  if (packed_)
  {
    locate(lookup, 0, [this](std::int32_t first) { return packed_->code(std::size_t(first)); });
  }
  else if (paged_)
  {
    locate(lookup, texelBytes, [this](std::int32_t row) { return paged_->find(row); });
  }
  else
  {
    const auto* first = static_cast<const std::byte*>(texels_);
    const std::size_t length = format_.textureBytes();
    locate(lookup, texelBytes, [=](std::int32_t row) { return first + std::size_t(row) * length; });
  }
}

/// @param textureOf where the texture of a row begins, null if it is not in memory
template <typename TextureOf>
void OcclusionTextures::locate(
  OcclusionLookup& lookup, std::size_t texelBytes, const TextureOf& textureOf) const
{
  for (std::size_t i = 0; i < OcclusionLookup::Size; ++i)
  {
    const std::int32_t row = rowOf(lookup.particles[i]);
    lookup.textures[i] = row < 0 ? nullptr : textureOf(row);
    if (lookup.textures[i])
    {
      const auto* first = static_cast<const std::byte*>(lookup.textures[i]);
      hwy::Prefetch(first + texelBytes * static_cast<std::size_t>(lookup.texels.texel[0][i]));
      hwy::Prefetch(first + texelBytes * static_cast<std::size_t>(lookup.texels.texel[2][i]));
    }
  }
}

void OcclusionTextures::finish(const OcclusionLookup& lookup, float* values) const
{
  for (std::size_t i = 0; i < OcclusionLookup::Size; ++i)
  {
    const bool needed = means_ && !lookup.textures[i] && lookup.particles[i] >= 0;
    values[i] = needed ? means_[lookup.particles[i]] : 1.0f;
  }
  if (!rows_)
  {
    return;
  }
  if (packed_)
  {
    finishPacked(lookup, values);
  }
  else if (format_.bytes)
  {
    interpolate(
      lookup,
      [this](const void* texels, std::int32_t i)
      { return decoded_[static_cast<const std::uint8_t*>(texels)[i]]; },
      values);
  }
  else
  {
    interpolate(
      lookup,
      [](const void* texels, std::int32_t i) { return static_cast<const float*>(texels)[i]; },
      values);
  }
}

/// @param decode value of a texture's texel
template <typename Decode>
void OcclusionTextures::interpolate(
  const OcclusionLookup& lookup, const Decode& decode, float* values) const
{
  TexelCorners corners;
  for (std::size_t i = 0; i < OcclusionLookup::Size; ++i)
  {
    const void* texels = lookup.textures[i];
    for (std::size_t k = 0; k < 4; ++k)
    {
      corners.value[k][i] = texels ? decode(texels, lookup.texels.texel[k][i]) : values[i];
    }
  }
  interpolateTexels(corners, lookup.texels, values);
}

void OcclusionTextures::finishPacked(const OcclusionLookup& lookup, float* values) const
{
  std::array<const std::uint8_t*, OcclusionLookup::Size> codes{};
  std::array<std::size_t, OcclusionLookup::Size> lanes{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < OcclusionLookup::Size; ++i)
  {
    if (lookup.textures[i])
    {
      codes[count] = static_cast<const std::uint8_t*>(lookup.textures[i]);
      lanes[count++] = i;
    }
  }
  std::array<float, OcclusionLookup::Size> found{};
  packed_->lookUp(codes.data(), lanes.data(), count, lookup.texels, found.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    values[lanes[i]] = found[i];
  }
}
}
