// SPDX-License-Identifier: BSD-3-Clause
#include "LoggedVisibility.h"

#include "MaskedSums.h"
#include "TextureFormula.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace po
{
namespace
{
constexpr std::size_t WantedParts = 256;
/// Of a part.
constexpr std::size_t LeastSums = std::size_t(1) << 18;
constexpr std::size_t MostSums = std::size_t(1) << 23;
/// Of a part: its places, and which of two directions, are told by 16 bits.
constexpr std::size_t MostPlaces = std::size_t(1) << 15;

constexpr std::uint16_t Upward = 0x8000;

/// That all threads together gather before they write, and that are read at once: 8 MiB.
constexpr std::size_t GatheredWords = std::size_t(1) << 22;
constexpr std::size_t LeastBuffer = 512; // words
constexpr std::size_t MostBuffer = 8192;

/// @param sums of a place
std::size_t choosePlacesPerPart(std::size_t places, std::size_t sums)
{
  const std::size_t least = std::max<std::size_t>(1, LeastSums / sums);
  const std::size_t most = std::max(least, std::min(MostPlaces, MostSums / sums));
  return std::clamp(places / WantedParts, std::min(least, MostPlaces), std::min(most, MostPlaces));
}

std::size_t sumsOfPlace(std::size_t slots, LoggedVisibility::Watch watch)
{
  return slots * (watch == LoggedVisibility::Watch::All ? 1 + ErrorSubsets : 1);
}

std::size_t chooseBufferWords(std::size_t parts)
{
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  return std::clamp(
    GatheredWords / (threads * std::max<std::size_t>(1, parts)), LeastBuffer, MostBuffer);
}
}

LoggedVisibility::LoggedVisibility(const SweepTexels& texels, const std::vector<unsigned>& spheres,
  std::size_t size, Watch watch, const std::vector<unsigned>& watched)
  : texels_(texels)
  , watch_(watch)
  , places_(spheres.size())
  , placesPerPart_(choosePlacesPerPart(places_, sumsOfPlace(texels.slots(), watch)))
  , placeOf_(size, NoPlace)
  , bufferWords_(chooseBufferWords(spheres.size() / placesPerPart_ + 1))
  , buffers_(std::vector<Buffer>(spheres.size() / placesPerPart_ + 1))
  , extents_(spheres.size() / placesPerPart_ + 1)
{
  for (unsigned place = 0; place < spheres.size(); ++place)
  {
    unsigned& first = placeOf_[spheres[place]];
    if (first == NoPlace)
    {
      first = place;
      continue;
    }
    std::vector<unsigned>& others = repeats_[spheres[place]];
    const unsigned last = others.empty() ? first : others.back();
    if (last / placesPerPart_ != place / placesPerPart_)
    {
      others.push_back(place);
    }
  }
  for (const unsigned sphere : watch == Watch::Some ? watched : std::vector<unsigned>())
  {
    subsets_[placeOf_[sphere]];
  }
}

void LoggedVisibility::keep(
  unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing, const GroupMask* mask)
{
  const auto number = static_cast<std::uint32_t>(axes_.size() + axis);
  write(placeOf_[sphere], number, upward, facing, mask);
  if (!repeats_.empty())
  {
    const auto others = repeats_.find(sphere);
    if (others != repeats_.end())
    {
      for (const unsigned place : others->second)
      {
        write(place, number, upward, facing, mask);
      }
    }
  }
}

void LoggedVisibility::write(std::size_t place, std::uint32_t axis, bool upward,
  const GroupMask* facing, const GroupMask* mask)
{
  const std::size_t part = place / placesPerPart_;
  Buffer& buffer = buffers_.local()[part];
  if (buffer.axis != axis ||
    buffer.words.size() + 1 + mostWordsOfMask(texels_.groups()) > bufferWords_)
  {
    flush(part, buffer);
    buffer.axis = axis;
  }
  buffer.words.push_back(
    static_cast<std::uint16_t>(place % placesPerPart_ | (upward ? Upward : 0)));
  appendMask(texels_.groups(), facing, mask, buffer.words);
}

void LoggedVisibility::flush(std::size_t part, Buffer& buffer)
{
  if (buffer.words.empty())
  {
    buffer.words.reserve(bufferWords_);
    return;
  }
  const auto count = static_cast<std::uint32_t>(buffer.words.size());
  const std::uint64_t position = file_.append(buffer.words.data(), count * sizeof(std::uint16_t));
  buffer.words.clear();
  const std::lock_guard<std::mutex> lock(extentsMutex_);
  extents_[part].push_back({ position, count, buffer.axis });
}

void LoggedVisibility::endBlock(const std::vector<AxisWeights>& axes, std::size_t subset)
{
  for (std::vector<Buffer>& buffers : buffers_)
  {
    for (std::size_t part = 0; part < buffers.size(); ++part)
    {
      flush(part, buffers[part]);
    }
  }
  for (const AxisWeights& weights : axes)
  {
    axes_.push_back({ weights, subset });
  }
  part_ = NoPart;
}

void LoggedVisibility::endSweep()
{
  buffers_.clear();
}

std::size_t LoggedVisibility::loadFor(std::size_t place)
{
  const std::size_t part = place / placesPerPart_;
  if (part != part_)
  {
    load(part);
  }
  return std::min(placesPerPart_ - place % placesPerPart_, places_ - place);
}

void LoggedVisibility::load(std::size_t part)
{
  beginPart(part);
  std::vector<Extent>& extents = extents_[part];
  // Sums are added in the order of the axes, as in memory; what an axis sees of a particle in its
  // two directions are different texels.
  std::sort(extents.begin(), extents.end(),
    [](const Extent& a, const Extent& b)
    { return a.axis != b.axis ? a.axis < b.axis : a.position < b.position; });
  const Extent* end = extents.data() + extents.size();
  for (const Extent* first = extents.data(); first != end;)
  {
    std::size_t words = 0;
    const Extent* last = first;
    for (; last != end && (last == first || words + last->words <= GatheredWords / 8); ++last)
    {
      words += last->words;
    }
    addExtents(first, last);
    first = last;
  }
}

void LoggedVisibility::beginPart(std::size_t part)
{
  part_ = part;
  seen_.assign(placesPerPart_, 0);
  sums_.assign(placesPerPart_ * texels_.slots(), 0.0f);
  subsetSums_.assign(watch_ == Watch::All ? ErrorSubsets * sums_.size() : 0, 0.0f);
  subsetsOfPlace_.assign(placesPerPart_, nullptr);
  for (auto& [place, subsets] : subsets_)
  {
    if (place / placesPerPart_ == part)
    {
      subsets = { std::vector<float>(ErrorSubsets * texels_.slots(), 0.0f) };
      subsetsOfPlace_[place % placesPerPart_] = &subsets;
    }
  }
}

void LoggedVisibility::addExtents(const Extent* first, const Extent* last)
{
  MaskWords words;
  for (const Extent* extent = first; extent != last; ++extent)
  {
    const std::size_t start = words.size();
    words.resize(start + extent->words);
    file_.read(extent->position, words.data() + start, extent->words * sizeof(std::uint16_t));
  }
  // Each thread reads all masks and adds those of its own places.
  const auto slices = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  tbb::parallel_for(std::size_t(0), slices,
    [&](std::size_t slice)
    {
      const std::uint16_t* start = words.data();
      for (const Extent* extent = first; extent != last; ++extent)
      {
        addMasks(
          start, *extent, placesPerPart_ * slice / slices, placesPerPart_ * (slice + 1) / slices);
        start += extent->words;
      }
    });
}

void LoggedVisibility::addMasks(
  const std::uint16_t* words, const Extent& extent, std::size_t firstPlace, std::size_t lastPlace)
{
  const SweptAxis& axis = axes_[extent.axis];
  std::vector<GroupMask> mask(texels_.groups());
  for (const std::uint16_t* at = words; at != words + extent.words;)
  {
    const std::size_t place = *at & ~Upward;
    const bool upward = (*at & Upward) != 0;
    ++at;
    if (place >= firstPlace && place < lastPlace)
    {
      decodeMask(at, mask.size(), axis.weights.facing[upward ? 1 : 0].data(), mask.data());
      addMask(place, axis, mask.data());
    }
    at += wordsOfMask(at, mask.size());
  }
}

void LoggedVisibility::addMask(std::size_t place, const SweptAxis& axis, const GroupMask* mask)
{
  seen_[place] = 1;
  const float* weight = axis.weights.weight.data();
  addMasked(texels_.groups(), mask, weight, sums_.data() + place * texels_.slots());
  if (!subsetSums_.empty())
  {
    const std::size_t row = ErrorSubsets * place + axis.subset;
    addMasked(texels_.groups(), mask, weight, subsetSums_.data() + row * texels_.slots());
  }
  if (Subsets* subsets = subsetsOfPlace_[place])
  {
    subsets->seen = true;
    addMasked(texels_.groups(), mask, weight, subsets->sums.data() + axis.subset * texels_.slots());
  }
}

std::size_t LoggedVisibility::placeInPart(unsigned sphere) const
{
  const unsigned first = placeOf_[sphere];
  if (first != NoPlace && first / placesPerPart_ == part_)
  {
    return first % placesPerPart_;
  }
  const auto others = repeats_.find(sphere);
  if (others != repeats_.end())
  {
    for (const unsigned place : others->second)
    {
      if (place / placesPerPart_ == part_)
      {
        return place % placesPerPart_;
      }
    }
  }
  return placesPerPart_;
}

const float* LoggedVisibility::sums(unsigned sphere) const
{
  const std::size_t place = placeInPart(sphere);
  return place < seen_.size() && seen_[place] != 0 ? sums_.data() + place * texels_.slots()
                                                   : nullptr;
}

const float* LoggedVisibility::subsetSums(unsigned sphere) const
{
  if (watch_ == Watch::All)
  {
    const float* ofPlace = sums(sphere);
    return ofPlace != nullptr ? subsetSums_.data() + ErrorSubsets * (ofPlace - sums_.data())
                              : nullptr;
  }
  const auto found = subsets_.find(placeOf_[sphere]);
  return found != subsets_.end() && found->second.seen ? found->second.sums.data() : nullptr;
}
}
