// SPDX-License-Identifier: BSD-3-Clause
#include "LoggedRims.h"

#include <algorithm>
#include <cstring>

namespace po
{
namespace
{
using Words = std::vector<std::uint32_t>;

/// Of a particle: how many rims, caps by rim, and caps there are, then these; without rims the
/// first of these words alone.
constexpr std::uint32_t NoRims = ~std::uint32_t(0);

template <typename Value>
std::size_t wordsOf(std::size_t count)
{
  return (count * sizeof(Value) + sizeof(std::uint32_t) - 1) / sizeof(std::uint32_t);
}

template <typename Value>
void append(const Value* values, std::size_t count, Words& words)
{
  const std::size_t end = words.size();
  words.resize(end + wordsOf<Value>(count));
  std::copy_n(reinterpret_cast<const char*>(values), count * sizeof(Value),
    reinterpret_cast<char*>(words.data() + end));
}

template <typename Value>
const Value* take(std::size_t count, const std::uint32_t*& at)
{
  const auto* values = reinterpret_cast<const Value*>(at);
  at += wordsOf<Value>(count);
  return values;
}
}

void LoggedRims::append(const TexelRims* rims)
{
  if (rims == nullptr)
  {
    words_.push_back(NoRims);
  }
  else
  {
    const std::size_t places = rims->firstCap(rims->count);
    const std::uint32_t caps =
      places == 0 ? 0 : 1 + *std::max_element(rims->capOf, rims->capOf + places);
    words_.push_back(static_cast<std::uint32_t>(rims->count));
    words_.push_back(static_cast<std::uint32_t>(places));
    words_.push_back(caps);
    po::append(rims->outside, groups_, words_);
    po::append(rims->rims, rims->count, words_);
    po::append(rims->capOf, places, words_);
    po::append(rims->caps, caps, words_);
  }
  if (++waiting_ == placesPerPart_)
  {
    writePart();
  }
}

void LoggedRims::writePart()
{
  parts_.push_back(
    { file_.append(words_.data(), words_.size() * sizeof(std::uint32_t)), words_.size() });
  words_.clear();
  waiting_ = 0;
}

void LoggedRims::load(std::size_t part)
{
  if (waiting_ > 0)
  {
    writePart();
  }
  const Extent& extent = parts_[part];
  words_.resize(extent.words);
  file_.read(extent.position, words_.data(), extent.words * sizeof(std::uint32_t));
  rims_.clear();
  for (const std::uint32_t* at = words_.data(); at != words_.data() + words_.size();)
  {
    rims_.emplace_back();
    const std::size_t count = *at++;
    if (count == NoRims)
    {
      continue;
    }
    const std::size_t places = *at++;
    const std::size_t caps = *at++;
    TexelRims& rims = rims_.back();
    rims.outside = take<GroupMask>(groups_, at);
    rims.rims = take<RimGroup>(count, at);
    rims.count = count;
    rims.capOf = take<std::uint32_t>(places, at);
    rims.caps = take<RimCap>(caps, at);
  }
}
}
