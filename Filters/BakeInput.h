// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeInput_h
#define po_BakeInput_h

// From the inputs of the filter, on all processes, to the task of a bake.

#include "BakeMethods.h"
#include "BakedData.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPointSet;
class vtkSphereAmbientOcclusion;

namespace po
{
/// What was read of the inputs.
struct BakeInput
{
  PointReceivers points; ///< the receivers of the task that the points of this process are
  std::vector<std::uint8_t> ghosts; ///< flags by point, or empty: see SphereCloud
  BakeTask task;
  BakeReport report;                 ///< the numbers that are known without a bake
  std::string radiusUsed;            ///< where the radii came from, in words
  std::vector<std::string> warnings; ///< for the first process to report
};

/// Reads particles, ids and occluders, and exchanges what matters with the other processes. Throws
/// std::invalid_argument naming the array or parameter that is wrong.
/// @param occluders may be null
[[nodiscard]] BakeInput readBakeInput(vtkSphereAmbientOcclusion& filter,
  const BakeSettings& settings, const std::vector<vtkPointSet*>& blocks, vtkDataObject* occluders,
  const ProcessGroup& group);
}

#endif
