// SPDX-License-Identifier: BSD-3-Clause
#include "MaskCode.h"

#include <bitset>

namespace po
{
namespace
{
std::size_t wordsOfBits(std::size_t groups)
{
  return (groups + 15) / 16;
}

/// The bit of a group.
unsigned bitOf(const std::uint16_t* bits, std::size_t group)
{
  return bits[group / 16] >> (group % 16) & 1u;
}

void addBit(std::uint16_t* bits, std::size_t group, unsigned bit)
{
  bits[group / 16] = static_cast<std::uint16_t>(bits[group / 16] | bit << (group % 16));
}
}

void appendMask(
  std::size_t groups, const GroupMask* facing, const GroupMask* mask, MaskWords& words)
{
  const std::size_t first = words.size();
  const std::size_t size = wordsOfBits(groups);
  words.resize(first + mostWordsOfMask(groups));
  std::uint16_t* bits = words.data() + first;
  std::uint16_t* open = bits + size;
  std::uint16_t* part = open + size;
  for (std::size_t g = 0; g < groups; ++g) // without branches: which groups are hidden is chance
  {
    const unsigned any = mask[g] != 0 ? 1 : 0;
    const unsigned all = mask[g] == facing[g] ? 1 : 0;
    addBit(bits, g, any & ~all);
    addBit(open, g, any & all);
    *part = mask[g];
    part += any & ~all;
  }
  words.resize(static_cast<std::size_t>(part - words.data()));
}

std::size_t wordsOfMask(const std::uint16_t* code, std::size_t groups)
{
  const std::size_t size = wordsOfBits(groups);
  std::size_t words = 2 * size;
  for (std::size_t i = 0; i < size; ++i)
  {
    words += std::bitset<16>(code[i]).count();
  }
  return words;
}

void decodeMask(
  const std::uint16_t* code, std::size_t groups, const GroupMask* facing, GroupMask* mask)
{
  const std::size_t size = wordsOfBits(groups);
  const std::uint16_t* open = code + size;
  const std::uint16_t* part = open + size;
  for (std::size_t g = 0; g < groups; ++g)
  {
    const GroupMask whole = bitOf(open, g) != 0 ? facing[g] : GroupMask(0);
    mask[g] = bitOf(code, g) != 0 ? *part : whole;
    part += bitOf(code, g);
  }
}
}
