// SPDX-License-Identifier: BSD-3-Clause
#include "SweepDivision.h"

#include "SharedWords.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace po
{
namespace
{
using Words = ProcessGroup::Words;
using Surface = VisibilityRecords::Surface;

constexpr std::size_t BitsPerWord = 64;
constexpr std::size_t HeaderWords = 2; ///< before the masks of one thread

/// Before the code of a mask: its sphere, in two halves, and the direction in the uppermost bit.
constexpr std::size_t WordsBefore = 2;
constexpr unsigned HalfBits = 16;
constexpr std::uint16_t Upward = 0x8000;

/// A bit for each of `count` things.
template <typename IsSet>
Words bitsOf(std::size_t count, const IsSet& test)
{
  Words words((count + BitsPerWord - 1) / BitsPerWord, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    words[i / BitsPerWord] |= std::uint64_t(test(i) ? 1 : 0) << (i % BitsPerWord);
  }
  return words;
}

/// The same, set where any process sets it.
template <typename IsSet>
Words bitsOfAny(std::size_t count, const IsSet& test, const ProcessGroup& group)
{
  const Words own = bitsOf(count, test);
  Words all = group.gather(own);
  for (std::size_t i = own.size(); i < all.size(); ++i)
  {
    all[i % own.size()] |= all[i];
  }
  all.resize(own.size());
  return all;
}

bool isSet(const std::uint64_t* words, std::size_t i)
{
  return (words[i / BitsPerWord] >> (i % BitsPerWord) & 1) != 0;
}

/// What surfaces are found to be travels in two bits, united over the processes; those that know
/// it agree.
constexpr std::size_t SurfaceBits = 2;
constexpr std::array<Surface, 4> SurfaceOfCode{ Surface::Unknown, Surface::Whole, Surface::Cut,
  Surface::Buried };

unsigned codeOf(Surface surface)
{
  const auto found = std::find(SurfaceOfCode.begin(), SurfaceOfCode.end(), surface);
  return found == SurfaceOfCode.end() ? 0 : static_cast<unsigned>(found - SurfaceOfCode.begin());
}

Surface surfaceAt(const Words& bits, unsigned sphere)
{
  const std::size_t first = SurfaceBits * sphere;
  return SurfaceOfCode[bits[first / BitsPerWord] >> (first % BitsPerWord) & 3];
}
}

SweepDivision::SweepDivision(const ProcessGroup& group, VisibilityRecords& records)
  : group_(group)
  , groups_(records.texels().groups())
  , records_(records)
  , outboxes_(Outbox(AxesPerBlock * static_cast<std::size_t>(group.size())))
{
  findReaders();
}

void SweepDivision::findReaders()
{
  const std::size_t spheres = records_.spheres();
  const Words own =
    bitsOf(spheres, [this](std::size_t i) { return records_.isListed(static_cast<unsigned>(i)); });
  const Words all = group_.gather(own);
  reader_.assign(spheres, Nobody);
  for (int process = 0; process < group_.size(); ++process)
  {
    const std::uint64_t* listed = all.data() + own.size() * static_cast<std::size_t>(process);
    for (unsigned sphere = 0; process != group_.rank() && sphere < spheres; ++sphere)
    {
      if (isSet(listed, sphere) && reader_[sphere] == Nobody)
      {
        reader_[sphere] = process;
      }
      else if (isSet(listed, sphere))
      {
        furtherReaders_[sphere].push_back(process);
      }
    }
  }
}

void SweepDivision::keep(
  unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing, const GroupMask* mask)
{
  if (reader_[sphere] == Nobody)
  {
    return;
  }
  write(reader_[sphere], sphere, axis, upward, facing, mask);
  if (!furtherReaders_.empty())
  {
    const auto further = furtherReaders_.find(sphere);
    if (further != furtherReaders_.end())
    {
      for (const int reader : further->second)
      {
        write(reader, sphere, axis, upward, facing, mask);
      }
    }
  }
}

void SweepDivision::write(int reader, unsigned sphere, std::size_t axis, bool upward,
  const GroupMask* facing, const GroupMask* mask)
{
  const auto place =
    axis * static_cast<std::size_t>(group_.size()) + static_cast<std::size_t>(reader);
  MaskWords& words = outboxes_.local()[place];
  words.push_back(static_cast<std::uint16_t>(sphere));
  words.push_back(static_cast<std::uint16_t>(sphere >> HalfBits | (upward ? Upward : 0)));
  appendMask(groups_, facing, mask, words);
}

void SweepDivision::deliver(
  const std::vector<AxisWeights>& axes, std::vector<std::atomic<std::uint8_t>>& everSeen)
{
  deliverMasks(axes);
  const std::size_t spheres = everSeen.size();
  const Words seen = bitsOfAny(
    spheres, [&](std::size_t i) { return everSeen[i].load(std::memory_order_relaxed) != 0; },
    group_);
  const Words surfaces = bitsOfAny(
    SurfaceBits * spheres,
    [this](std::size_t i)
    {
      const unsigned code = codeOf(records_.surface(static_cast<unsigned>(i / SurfaceBits)));
      return (code >> (i % SurfaceBits) & 1) != 0;
    },
    group_);
  tbb::parallel_for(unsigned(0), static_cast<unsigned>(spheres),
    [&](unsigned sphere)
    {
      if (isSet(seen.data(), sphere))
      {
        everSeen[sphere].store(1, std::memory_order_relaxed);
      }
      records_.learn(sphere, surfaceAt(surfaces, sphere));
    });
}

void SweepDivision::deliverMasks(const std::vector<AxisWeights>& axes)
{
  for (int reader = 0; reader < group_.size(); ++reader)
  {
    const Words letters = group_.gatherAt(reader, letterTo(reader));
    if (reader == group_.rank())
    {
      read(letters, axes);
    }
  }
}

/// For each axis and thread: the axis and the number of 16-bit words, then those. The outboxes are
/// emptied as that is written.
ProcessGroup::Words SweepDivision::letterTo(int reader)
{
  Words letter;
  const auto size = static_cast<std::size_t>(group_.size());
  const auto forAll = [&](const auto& action)
  {
    for (Outbox& outbox : outboxes_)
    {
      for (std::size_t axis = 0; axis < AxesPerBlock; ++axis)
      {
        action(axis, outbox[axis * size + static_cast<std::size_t>(reader)]);
      }
    }
  };
  std::size_t length = 0;
  forAll([&](std::size_t, const MaskWords& words)
    { length += HeaderWords + wordsFor(words.size() * sizeof(std::uint16_t)); });
  letter.reserve(length);
  forAll(
    [&](std::size_t axis, MaskWords& words)
    {
      letter.push_back(axis);
      letter.push_back(words.size());
      appendValues(words, letter);
      words.clear();
    });
  return letter;
}

void SweepDivision::read(const Words& letters, const std::vector<AxisWeights>& axes)
{
  std::vector<std::size_t> parts; // where they begin; each is what one thread has found
  for (std::size_t at = 0; at < letters.size();)
  {
    parts.push_back(at);
    at += HeaderWords + wordsFor(letters[at + 1] * sizeof(std::uint16_t));
  }
  // The two directions of an axis that see a sphere are in one part.
  tbb::parallel_for(std::size_t(0), parts.size(),
    [&](std::size_t i)
    {
      const std::uint64_t* part = letters.data() + parts[i];
      readMasks(part[0], axes[part[0]], valuesAt<std::uint16_t>(part + HeaderWords, part[1]));
    });
}

void SweepDivision::readMasks(std::size_t axis, const AxisWeights& weights, const MaskWords& codes)
{
  std::vector<GroupMask> mask(groups_);
  const std::uint16_t* end = codes.data() + codes.size();
  for (const std::uint16_t* at = codes.data(); at != end;)
  {
    const bool upward = (at[1] & Upward) != 0;
    const auto upper = static_cast<unsigned>(at[1] & ~Upward);
    const unsigned sphere = upper << HalfBits | at[0];
    const GroupMask* facing = weights.facing[upward ? 1 : 0].data();
    at += WordsBefore;
    decodeMask(at, groups_, facing, mask.data());
    records_.keep(sphere, axis, upward, facing, mask.data());
    at += wordsOfMask(at, groups_);
  }
}
}
