// SPDX-License-Identifier: BSD-3-Clause
#include "WholeSet.h"

#include "ProcessGroup.h"

namespace po
{
WholeSet wholeSetOf(const WholeSet& own, const ProcessGroup& group)
{
  WholeSet all{};
  all.particles = group.sum(own.particles);
  const double radii = group.sum(own.particles * own.meanRadius);
  all.meanRadius = all.particles > 0 ? radii / all.particles : 0;
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    // Those of no particles lie beyond all others.
    low[axis] = -group.largest(-own.bounds.GetMinPoint()[axis]);
    high[axis] = group.largest(own.bounds.GetMaxPoint()[axis]);
  }
  if (all.particles > 0)
  {
    all.bounds = vtkBoundingBox(low[0], high[0], low[1], high[1], low[2], high[2]);
  }
  return all;
}
}
