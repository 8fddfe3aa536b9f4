// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextures.h"

#include "Gamma2.h"

namespace po
{
OcclusionTextures::OcclusionTextures(int resolution, const std::uint8_t* bytes, double maximum,
  const std::int32_t* rows, const float* means)
  : resolution_(resolution)
  , bytes_(bytes)
  , rows_(rows)
  , means_(means)
{
  for (std::size_t code = 0; code < decoded_.size(); ++code)
  {
    decoded_[code] = static_cast<float>(decodeGamma2(static_cast<std::uint8_t>(code), maximum));
  }
}

OcclusionTextures::OcclusionTextures(
  int resolution, const float* values, const std::int32_t* rows, const float* means)
  : resolution_(resolution)
  , values_(values)
  , rows_(rows)
  , means_(means)
{
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
  TexelLookup lookup;
  for (std::size_t i = 0; rows_ && i < BlockSize; ++i)
  {
    const Vec3f direction = i < count ? directions[i] : Vec3f{ 1, 0, 0 };
    lookup.x[i] = direction.x;
    lookup.y[i] = direction.y;
    lookup.z[i] = direction.z;
  }
  if (rows_)
  {
    findTexels(resolution_, lookup);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto particle = static_cast<std::size_t>(particles[i]);
    if (!rows_ || rows_[particle] < 0)
    {
      values[i] = means_ ? means_[particle] : 1.0f;
      continue;
    }
    const std::size_t first =
      static_cast<std::size_t>(rows_[particle]) * texelIndex(resolution_, resolution_, 0);
    const auto row = [&](std::int32_t j)
    {
      const float a = texel(first, j, lookup.column0[i]), b = texel(first, j, lookup.column1[i]);
      return a + lookup.columnWeight[i] * (b - a);
    };
    const float a = row(lookup.row0[i]), b = row(lookup.row1[i]);
    values[i] = a + lookup.rowWeight[i] * (b - a);
  }
}
}
