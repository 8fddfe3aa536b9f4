// SPDX-License-Identifier: BSD-3-Clause
#include "TexelWeights.h"

#include "Random.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

namespace po
{
namespace
{
float tent(float before, float own, float after)
{
  return 0.125f * before + 0.75f * own + 0.125f * after;
}
}

TexelWeights::TexelWeights(int resolution)
  : side_(static_cast<std::size_t>(resolution))
  , rows_(side_ * side_)
  , weights_(side_ * side_)
{
}

const std::uint8_t* TexelWeights::of(const float* shares)
{
  if (std::all_of(shares, shares + weights_.size(), [](float share) { return share == 1.0f; }))
  {
    return nullptr;
  }
  for (std::size_t i = 0; i < rows_.size(); ++i)
  {
    const float* row = shares + i / side_ * side_;
    const std::size_t column = i % side_;
    rows_[i] = tent(row[(column + side_ - 1) % side_], row[column], row[(column + 1) % side_]);
  }
  for (std::size_t i = 0; i < rows_.size(); ++i)
  {
    // Interpolation stops at the poles.
    const std::size_t above = i < side_ ? i : i - side_;
    const std::size_t below = i + side_ < rows_.size() ? i + side_ : i;
    const float share = tent(rows_[above], rows_[i], rows_[below]);
    weights_[i] = static_cast<std::uint8_t>(std::max(1L, std::lround(Whole * share)));
  }
  return weights_.data();
}

std::size_t hashOfBytes(const void* bytes, std::size_t count)
{
  return std::hash<std::string_view>{}({ static_cast<const char*>(bytes), count });
}

std::size_t hashOf(const WeighedTexture& texture, std::size_t texels)
{
  const std::size_t values = hashOfBytes(texture.values, texels * sizeof(float));
  return texture.weights ? mixBits(values ^ hashOfBytes(texture.weights, texels)) : values;
}

bool hasOneValue(const float* texture, std::size_t texels)
{
  return std::all_of(texture, texture + texels, [&](float value) { return value == texture[0]; });
}
}
