// SPDX-License-Identifier: BSD-3-Clause
#include "TextureIntake.h"

#include "TextureStore.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

namespace po
{
namespace
{
/// Infinity where that is not known beforehand, or does not matter.
double brightestOf(const BakeSettings& settings)
{
  const bool isKnown = settings.storage == Storage::Full &&
    settings.encoding == Encoding::UInt8Gamma2 && !settings.light &&
    std::holds_alternative<UniformBackground>(settings.background);
  return isKnown ? 1 : std::numeric_limits<double>::infinity();
}
}

TextureIntake::TextureIntake(const BakeSettings& settings, std::size_t particles, bool outOfCore)
  : settings_(settings)
  , particles_(particles)
  , brightest_(brightestOf(settings))
  , linear_(settings.storage == Storage::OneValue ? 1 : settings.textureResolution,
      outOfCore && spills(settings) ? 0 : particles)
{
  if (outOfCore && spills(settings))
  {
    spilled_.emplace(linear_.texelsPerRow());
  }
  rowOf_.reserve(particles);
  if (weighsTexels(settings))
  {
    weights_.emplace(settings.textureResolution);
  }
}

bool TextureIntake::weighsTexels(const BakeSettings& settings)
{
  return settings.storage == Storage::VariableSize || settings.storage == Storage::Compressed;
}

bool TextureIntake::spills(const BakeSettings& settings)
{
  return settings.storage == Storage::Full && settings.encoding == Encoding::UInt8Gamma2;
}

void TextureIntake::add(const float* texture, const float* shares)
{
  if (!bytes_ && *std::max_element(texture, texture + linear_.texelsPerRow()) >= brightest_)
  {
    toBytes(brightest_, particles_);
  }
  rowOf_.push_back(insert(texture, shares));
}

std::int32_t TextureIntake::insert(const float* texture, const float* shares)
{
  if (bytes_)
  {
    return bytes_->insert(texture);
  }
  if (spilled_)
  {
    return spilled_->insert(texture);
  }
  // One value is stored as it is, whatever is visible of it.
  const bool weigh = weights_ && !hasOneValue(texture, linear_.texelsPerRow());
  return linear_.insert({ texture, weigh ? weights_->of(shares) : nullptr });
}

void TextureIntake::addDark()
{
  if (dark_)
  {
    rowOf_.push_back(rowOf_[*dark_]);
    return;
  }
  dark_ = rowOf_.size();
  add(std::vector<float>(linear_.texelsPerRow(), 0.0f).data(), nullptr); // one value: not weighed
}

/// @param expected how many textures there will be
void TextureIntake::toBytes(double maximum, std::size_t expected)
{
  bytes_.emplace(linear_.resolution(), maximum, expected);
  if (spilled_)
  {
    bytes_->insertAll([this](const auto& visit) { spilled_->forEach(visit); }, rowOf_);
    spilled_.reset();
    return;
  }
  bytes_->insertAll(linear_, rowOf_);
  linear_ = TextureTable(linear_.resolution(), 0);
}

EncodedTable TextureIntake::finish(
  double noise, const ProcessGroup& group, std::vector<std::int32_t>& rowOf)
{
  const double ofLinear = spilled_ ? spilled_->largestValue() : linear_.largestValue();
  const double maximum = group.largest(bytes_ ? brightest_ : ofLinear);
  if (spilled_)
  {
    toBytes(maximum, static_cast<std::size_t>(spilled_->rows()));
  }
  rowOf = std::move(rowOf_);
  return bytes_ ? bytes_->take()
                : storeTextures(std::move(linear_), settings_, maximum, noise, group, rowOf);
}
}
