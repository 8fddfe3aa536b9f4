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

TextureIntake::TextureIntake(const BakeSettings& settings, std::size_t particles)
  : settings_(settings)
  , particles_(particles)
  , brightest_(brightestOf(settings))
  , linear_(settings.storage == Storage::OneValue ? 1 : settings.textureResolution, particles)
{
  rowOf_.reserve(particles);
}

void TextureIntake::add(const float* texture)
{
  if (!bytes_ && *std::max_element(texture, texture + linear_.texelsPerRow()) >= brightest_)
  {
    beginBytes();
  }
  rowOf_.push_back(bytes_ ? bytes_->insert(texture) : linear_.insert(texture));
}

void TextureIntake::addDark()
{
  if (dark_)
  {
    rowOf_.push_back(rowOf_[*dark_]);
    return;
  }
  dark_ = rowOf_.size();
  add(std::vector<float>(linear_.texelsPerRow(), 0.0f).data());
}

void TextureIntake::beginBytes()
{
  bytes_.emplace(linear_.resolution(), brightest_, particles_);
  bytes_->insertAll(linear_, rowOf_);
  linear_ = TextureTable(linear_.resolution(), 0);
}

EncodedTable TextureIntake::finish(
  double noise, const ProcessGroup& group, std::vector<std::int32_t>& rowOf)
{
  rowOf = std::move(rowOf_);
  const double maximum = group.largest(bytes_ ? brightest_ : linear_.largestValue());
  return bytes_ ? bytes_->take()
                : storeTextures(std::move(linear_), settings_, maximum, noise, group, rowOf);
}
}
