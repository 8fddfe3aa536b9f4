// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FreeLength_h
#define po_FreeLength_h

#include "ProcessGroup.h"
#include "SphereCloud.h"

namespace po
{
/// All particles of a set, also where processes have parts of it.
struct ParticleSet
{
  double count;
  double meanRadius; ///< in world units, > 0
};

/// How far a line of sight goes, in the mean, from one particle to the next, in world units.
///
/// A line meets spheres of number density n every 1 / (n pi <r^2>), and runs 4/3 r inside of each:
/// the mean free length is the difference, 0 at least. The density is that around the particles
/// themselves, however empty the rest of their box is: the mean number of others in a particle's
/// cell of a cubic grid, in which every cell of 4 mean radii counts that a hash of its place
/// chooses, so that some 2^16 particles are counted. Infinite where none has another in its cell.
///
/// All processes of the group must call it, and get the same: that of one process with all
/// particles, up to the rounding of places. Ghosts do not count.
[[nodiscard]] double meanFreeLength(const SphereCloud& cloud, const ParticleSet& all,
  const ProcessGroup& group = ProcessGroup::alone());
}

#endif
