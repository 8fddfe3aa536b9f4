// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BrickOrder_h
#define po_BrickOrder_h

#include "MortonCurve.h"
#include "SphereSet.h"

#include <vector>

namespace po
{
/// Through the bounding box of a brick's centres; it holds spheres.
[[nodiscard]] MortonCurve curveThrough(const Brick& brick);

/// The places of a brick's spheres: by octaves of their radius, so that a large one is not among
/// small ones, and along a Morton curve. Empty where they are in this order already.
[[nodiscard]] std::vector<unsigned> orderInSpace(const Brick& brick);
}

#endif
