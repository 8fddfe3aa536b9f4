// SPDX-License-Identifier: BSD-3-Clause
#include "TextureMemory.h"

#include "TexelWeights.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// Memory grows by so many slots, so that nothing that is kept is ever copied.
constexpr std::size_t SlotsPerBlock = 64;
}

TextureMemory::TextureMemory(int resolution)
  : texels_(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution))
  , values_(texels_)
  , shares_(texels_)
{
}

void TextureMemory::begin(const std::vector<std::int32_t>& earlier)
{
  std::vector<Entry> entries(earlier.size());
  reused_ = 0;
  for (std::size_t i = 0; i < earlier.size(); ++i)
  {
    if (earlier[i] >= 0)
    {
      Entry& known = entries_[static_cast<std::size_t>(earlier[i])];
      entries[i] = known;
      entries[i].isKept = true;
      known = Entry(); // has no slots any more
      ++reused_;
    }
  }
  for (const Entry& forgotten : entries_)
  {
    release(forgotten.values);
    release(forgotten.shares);
  }
  entries_ = std::move(entries);
  next_ = 0;
}

void TextureMemory::add(const RawTextures& baked, const Sink& sink)
{
  for (std::size_t i = 0; i < baked.count; ++i)
  {
    handKept(sink);
    const float* values = baked.values + i * texels_;
    const float* shares = baked.outsideShares + i * texels_;
    entries_[next_] = { keep(values), keep(shares), false };
    sink({ next_, 1, values, shares });
    ++next_;
  }
}

void TextureMemory::finish(double bakedError, const Sink& sink)
{
  handKept(sink);
  const auto kept = static_cast<double>(reused_);
  const auto all = static_cast<double>(entries_.size());
  const double squares = kept * error_ * error_ + (all - kept) * bakedError * bakedError;
  error_ = all > 0 ? std::sqrt(squares / all) : 0;
}

double TextureMemory::bytes() const
{
  return static_cast<double>(
    blocks_.size() * SlotsPerBlock * texels_ * sizeof(float) + entries_.capacity() * sizeof(Entry));
}

void TextureMemory::handKept(const Sink& sink)
{
  for (; next_ < entries_.size() && entries_[next_].isKept; ++next_)
  {
    const Entry& entry = entries_[next_];
    sink({ next_, 1, expand(entry.values, values_), expand(entry.shares, shares_) });
  }
}

TextureMemory::Texels TextureMemory::keep(const float* texels)
{
  if (hasOneValue(texels, texels_))
  {
    return { -1, texels[0] };
  }
  if (free_.empty())
  {
    const auto first = static_cast<std::int32_t>(blocks_.size() * SlotsPerBlock);
    blocks_.push_back(std::unique_ptr<float[]>(new float[SlotsPerBlock * texels_]));
    for (std::size_t i = SlotsPerBlock; i > 0; --i)
    {
      free_.push_back(first + static_cast<std::int32_t>(i - 1));
    }
  }
  const std::int32_t number = free_.back();
  free_.pop_back();
  std::copy_n(texels, texels_, slot(number));
  return { number, 0 };
}

void TextureMemory::release(const Texels& texels)
{
  if (texels.slot >= 0)
  {
    free_.push_back(texels.slot);
  }
}

float* TextureMemory::slot(std::int32_t number)
{
  const auto place = static_cast<std::size_t>(number);
  return blocks_[place / SlotsPerBlock].get() + place % SlotsPerBlock * texels_;
}

const float* TextureMemory::expand(const Texels& texels, std::vector<float>& buffer)
{
  if (texels.slot >= 0)
  {
    return slot(texels.slot);
  }
  std::fill(buffer.begin(), buffer.end(), texels.value);
  return buffer.data();
}
}
