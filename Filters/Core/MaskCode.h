// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MaskCode_h
#define po_MaskCode_h

// Masks of what a direction sees of a sphere, in few words: what is written to files, and what
// processes send each other.

#include "SweepTexels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
using MaskWords = std::vector<std::uint16_t>;

/// Appends a mask: bits by group that are set where some of the facing texels are hidden, and some
/// are not; bits where none is hidden; and the groups of the first kind.
/// @param facing [groups] the texels that face the direction; `mask` [groups] has no others
void appendMask(
  std::size_t groups, const GroupMask* facing, const GroupMask* mask, MaskWords& words);

/// How many words a mask takes at most.
[[nodiscard]] constexpr std::size_t mostWordsOfMask(std::size_t groups)
{
  return 2 * ((groups + 15) / 16) + groups;
}

/// How many words a mask takes.
[[nodiscard]] std::size_t wordsOfMask(const std::uint16_t* code, std::size_t groups);

/// Fills in the mask again.
/// @param mask [groups]
void decodeMask(
  const std::uint16_t* code, std::size_t groups, const GroupMask* facing, GroupMask* mask);
}

#endif
