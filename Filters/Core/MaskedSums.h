// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MaskedSums_h
#define po_MaskedSums_h

#include "SweepTexels.h"

#include <cstddef>

namespace po
{
/// Clears the bits that are not set in the other mask too; false if none is left.
bool intersect(std::size_t groups, const GroupMask* other, GroupMask* mask);

/// Adds the terms of the slots that are set to their sums; all arrays cover all groups.
void addMasked(std::size_t groups, const GroupMask* mask, const float* terms, float* sums);

/// Terms and the mask of the slots that they count for.
struct MaskedTerms
{
  const GroupMask* mask;
  const float* terms;
};

/// Adds several, in their order, at one reading of the sums.
void addMasked(std::size_t groups, const MaskedTerms* list, std::size_t count, float* sums);

/// Adds, for one group, the terms [PointsPerTexel][GroupSize] of the points that are set.
/// @param mask of the first pattern; those of the next are `stride` further
void addOverPoints(const GroupMask* mask, std::size_t stride, const float* terms, float* sums);
}

#endif
