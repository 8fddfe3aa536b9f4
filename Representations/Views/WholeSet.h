// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_WholeSet_h
#define po_WholeSet_h

#include "vtkBoundingBox.h"

namespace po
{
class ProcessGroup;

/// A set of particles by what automatic choices go by.
struct WholeSet
{
  double particles;
  double meanRadius; ///< 0 without particles
  vtkBoundingBox bounds;
};

/// That of all processes of a group from what each of them has; all must call it, and all get the
/// same.
[[nodiscard]] WholeSet wholeSetOf(const WholeSet& own, const ProcessGroup& group);
}

#endif
