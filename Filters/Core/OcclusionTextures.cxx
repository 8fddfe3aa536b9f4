// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextures.h"

#include "Gamma2.h"
#include "TexelMap.h"

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
  if (!rows_ || rows_[particle] < 0)
  {
    return means_ ? means_[particle] : 1.0f;
  }
  const BilinearTexels texels = bilinearTexels(resolution_, fastTextureCoordinate(direction));
  const std::size_t first =
    static_cast<std::size_t>(rows_[particle]) * texelIndex(resolution_, resolution_, 0);
  float sum = 0;
  for (std::size_t k = 0; k < 4; ++k)
  {
    const std::size_t texel = first + texels.index[k];
    sum += texels.weight[k] * (bytes_ ? decoded_[bytes_[texel]] : values_[texel]);
  }
  return sum;
}
}
