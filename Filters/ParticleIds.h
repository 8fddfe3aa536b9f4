// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParticleIds_h
#define po_ParticleIds_h

#include "ProcessGroup.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPointSet;

namespace po
{
/// A number for each point of the blocks, one block after the other, that stands for its value in
/// an array of ids; empty where there are none.
///
/// @param array empty or "(automatic)": the first of id, Id, ID, ParticleId, GlobalNodeId,
/// GlobalPointIds that every block of every process has; "(none)": none
/// Throws std::invalid_argument if the named array is missing in a block, not numeric, or not one
/// number a point.
[[nodiscard]] std::vector<std::uint64_t> readIds(
  const std::vector<vtkPointSet*>& blocks, const std::string& array, const ProcessGroup& group);
}

#endif
