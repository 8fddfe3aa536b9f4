// SPDX-License-Identifier: BSD-3-Clause
#include "CompactRims.h"

#include "MaskCode.h"
#include "MaskedSums.h"
#include "RimFinder.h"
#include "TexelCaps.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace po
{
namespace
{
using Bytes = std::vector<std::uint8_t>;

/// Seven bits a byte, the low ones first; the highest bit tells that there are more.
void appendNumber(std::uint32_t number, Bytes& bytes)
{
  for (; number >= 0x80; number >>= 7)
  {
    bytes.push_back(static_cast<std::uint8_t>(number | 0x80));
  }
  bytes.push_back(static_cast<std::uint8_t>(number));
}

std::uint32_t takeNumber(const std::uint8_t*& at)
{
  std::uint32_t number = *at & 0x7F;
  for (unsigned shift = 7; (*at++ & 0x80) != 0; shift += 7)
  {
    number |= static_cast<std::uint32_t>(*at & 0x7F) << shift;
  }
  return number;
}

/// A sphere among those near to another one: differences of both signs, small ones first.
std::uint32_t differenceOf(unsigned other, unsigned source)
{
  const std::uint32_t difference = other - source;
  return (difference << 1) ^ ((difference & 0x80000000u) != 0 ? ~0u : 0u);
}

unsigned fromDifference(std::uint32_t code, unsigned source)
{
  return source + ((code >> 1) ^ ((code & 1) != 0 ? ~0u : 0u));
}

/// What was read of a sphere.
struct ReadRims
{
  std::vector<unsigned> others; ///< by cap: the sphere that cuts it off
  std::vector<std::uint8_t> isMade;
  std::vector<RimCap> caps; ///< those that are made
  std::vector<GroupMask> outside;
  std::vector<RimGroup> rims;
  std::vector<std::uint32_t> capOf;
  TexelRims result;

  void takeOthers(const std::uint8_t*& at, unsigned source)
  {
    others.resize(takeNumber(at));
    for (unsigned& other : others)
    {
      other = fromDifference(takeNumber(at), source);
    }
    isMade.assign(others.size(), 0);
    caps.resize(others.size());
    rims.clear();
    capOf.clear();
  }

  void addCap(std::uint32_t place, const SphereSet& set, unsigned source)
  {
    capOf.push_back(place);
    if (isMade[place] == 0)
    {
      isMade[place] = 1;
      caps[place] = rimCapOf(capBetween(set, source, others[place]));
    }
  }

  void takeRim(const std::uint8_t*& at, std::uint32_t& group, GroupMask& crossed)
  {
    group += takeNumber(at);
    std::memcpy(&crossed, at, sizeof(crossed));
    at += sizeof(crossed);
  }

  const TexelRims& finish()
  {
    result = { outside.data(), rims.data(), rims.size(), capOf.data(), caps.data() };
    return result;
  }
};

ReadRims& readRims()
{
  thread_local ReadRims read;
  return read;
}

/// Where the bytes of the caps begin, behind the mask of the texels that no cap covers.
const std::uint8_t* takeOutside(
  const std::uint8_t* bytes, const SweepTexels& texels, std::vector<GroupMask>& outside)
{
  const auto* words = reinterpret_cast<const std::uint16_t*>(bytes);
  outside.resize(texels.groups());
  decodeMask(words, texels.groups(), texels.allBits().data(), outside.data());
  return bytes + sizeof(std::uint16_t) * wordsOfMask(words, texels.groups());
}

/// Reads all rims, or those that cross what is left of a mask.
/// @param mask null: all
void takeRims(const std::uint8_t* at, const SphereSet& set, unsigned source, const GroupMask* mask,
  ReadRims& read)
{
  read.takeOthers(at, source);
  std::uint32_t group = 0;
  for (std::uint32_t left = takeNumber(at); left > 0; --left)
  {
    GroupMask crossed = 0;
    read.takeRim(at, group, crossed);
    const bool matters = mask == nullptr || (mask[group] & crossed) != 0;
    for (std::uint32_t caps = takeNumber(at); caps > 0; --caps)
    {
      const std::uint32_t place = takeNumber(at);
      if (matters)
      {
        read.addCap(place, set, source);
      }
    }
    if (matters)
    {
      read.rims.push_back({ static_cast<std::uint16_t>(group), crossed,
        static_cast<std::uint32_t>(read.capOf.size()) });
    }
  }
}

void appendRims(const TexelRims& rims, Bytes& bytes)
{
  appendNumber(static_cast<std::uint32_t>(rims.count), bytes);
  std::uint32_t group = 0;
  for (std::size_t rim = 0; rim < rims.count; ++rim)
  {
    const RimGroup& entry = rims.rims[rim];
    appendNumber(entry.group - group, bytes);
    group = entry.group;
    const auto* crossed = reinterpret_cast<const std::uint8_t*>(&entry.crossed);
    bytes.insert(bytes.end(), crossed, crossed + sizeof(entry.crossed));
    const CapList caps = rims.capsOf(rim);
    appendNumber(static_cast<std::uint32_t>(caps.last - caps.first), bytes);
    std::for_each(caps.first, caps.last, [&bytes](std::uint32_t cap) { appendNumber(cap, bytes); });
  }
}
}

CompactRims::CompactRims(const SphereSet& set, const SweepTexels& texels, std::size_t spheres)
  : set_(set)
  , texels_(texels)
  , codes_(spheres)
  , chunks_(MostChunks)
{
}

const std::uint8_t* CompactRims::bytesOf(Code code) const
{
  return chunks_[code >> ChunkShift].get() + Unit * (code & ((Code(1) << ChunkShift) - 1));
}

CompactRims::Code CompactRims::addChunk(std::size_t bytes)
{
  const std::lock_guard<std::mutex> lock(chunksMutex_);
  if (usedChunks_ == MostChunks)
  {
    throw std::runtime_error(
      "The overlaps of the particles take more memory than a bake out of core is made for: bake "
      "fewer particles, or choose the Method Embree.");
  }
  chunks_[usedChunks_].reset(new std::uint8_t[bytes]);
  return usedChunks_++ << ChunkShift;
}

CompactRims::Code CompactRims::store(const Bytes& bytes)
{
  const std::size_t units = (bytes.size() + Unit - 1) / Unit;
  Code code = None;
  if (units * Unit > ChunkBytes)
  {
    code = addChunk(units * Unit); // of its own
  }
  else
  {
    Room& room = rooms_.local();
    if (room.left < units)
    {
      room = { addChunk(ChunkBytes), ChunkBytes / Unit };
    }
    code = room.next;
    room.next += static_cast<Code>(units);
    room.left -= units;
  }
  std::memcpy(chunks_[code >> ChunkShift].get() + Unit * (code & ((Code(1) << ChunkShift) - 1)),
    bytes.data(), bytes.size());
  return code;
}

void CompactRims::keep(unsigned sphere, unsigned source, const std::vector<BuriedCap>& caps)
{
  thread_local RimFinder finder;
  const TexelRims rims = finder.find(texels_, caps);
  thread_local MaskWords words;
  words.clear();
  appendMask(texels_.groups(), texels_.allBits().data(), rims.outside, words);
  thread_local Bytes bytes;
  bytes.resize(words.size() * sizeof(std::uint16_t));
  std::memcpy(bytes.data(), words.data(), bytes.size());
  appendNumber(static_cast<std::uint32_t>(finder.capsUsed().size()), bytes);
  for (const std::uint32_t cap : finder.capsUsed())
  {
    appendNumber(differenceOf(caps[cap].other, source), bytes);
  }
  appendRims(rims, bytes);
  // Two threads may do the same at once; both are equal, and one is not used.
  Code known = None;
  codes_[sphere].compare_exchange_strong(known, store(bytes), std::memory_order_acq_rel);
}

void CompactRims::prefetch(unsigned sphere) const
{
  if (const Code code = codeOf(sphere))
  {
    hwy::Prefetch(bytesOf(code));
    hwy::Prefetch(bytesOf(code) + 64);
  }
}

bool CompactRims::clearCovered(unsigned sphere, GroupMask* mask) const
{
  std::vector<GroupMask>& outside = readRims().outside;
  takeOutside(bytesOf(codeOf(sphere)), texels_, outside);
  return intersect(texels_.groups(), outside.data(), mask);
}

/// @param mask only rims that cross what is left of it matter; null: all
/// @return good until the calling thread's next call of any function
const TexelRims& CompactRims::read(Code code, unsigned source, const GroupMask* mask) const
{
  ReadRims& read = readRims();
  takeRims(takeOutside(bytesOf(code), texels_, read.outside), set_, source, mask, read);
  return read.finish();
}

bool CompactRims::clearInside(unsigned sphere, unsigned source, const TexelPatterns& patterns,
  std::size_t pattern, GroupMask* mask) const
{
  return po::clearInside(patterns, pattern, read(codeOf(sphere), source, mask), mask);
}

const TexelRims* CompactRims::find(unsigned sphere, unsigned source) const
{
  const Code code = codeOf(sphere);
  return code == None ? nullptr : &read(code, source, nullptr);
}
}
