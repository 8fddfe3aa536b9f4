// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextures.h"

#include "Gamma2.h"

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
  const auto id = static_cast<std::int64_t>(particle);
  float value = 0;
  lookUp(&id, &direction, 1, &value);
  return value;
}

void OcclusionTextures::lookUp(
  const std::int64_t* particles, const Vec3f* directions, std::size_t count, float* values) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = means_ ? means_[particles[i]] : 1.0f;
  }
  if (!rows_)
  {
    return;
  }
  TexelLookup lookup;
  for (std::size_t i = 0; i < BlockSize; ++i)
  {
    const Vec3f direction = i < count ? directions[i] : Vec3f{ 1, 0, 0 };
    lookup.x[i] = direction.x;
    lookup.y[i] = direction.y;
    lookup.z[i] = direction.z;
  }
  findTexels(format_.resolution, lookup);
  packed_ ? lookUpPacked(particles, count, lookup, values)
          : lookUpTexels(particles, count, lookup, values);
}

void OcclusionTextures::lookUpTexels(
  const std::int64_t* particles, std::size_t count, const TexelLookup& lookup, float* values) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int32_t texture = rowOf(particles[i]);
    const void* texels = texture < 0 ? nullptr : texelsOf(texture);
    if (!texels)
    {
      continue;
    }
    const auto row = [&](std::int32_t j)
    {
      const float a = texel(texels, j, lookup.column0[i]), b = texel(texels, j, lookup.column1[i]);
      return a + lookup.columnWeight[i] * (b - a);
    };
    const float a = row(lookup.row0[i]), b = row(lookup.row1[i]);
    values[i] = a + lookup.rowWeight[i] * (b - a);
  }
}

void OcclusionTextures::lookUpPacked(
  const std::int64_t* particles, std::size_t count, const TexelLookup& lookup, float* values) const
{
  std::array<std::size_t, BlockSize> firsts{}, lanes{};
  std::size_t textures = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (rowOf(particles[i]) >= 0)
    {
      firsts[textures] = static_cast<std::size_t>(rowOf(particles[i]));
      lanes[textures++] = i;
    }
  }
  std::array<float, BlockSize> found{};
  packed_->lookUp(firsts.data(), lanes.data(), textures, lookup, found.data());
  for (std::size_t i = 0; i < textures; ++i)
  {
    values[lanes[i]] = found[i];
  }
}
}
