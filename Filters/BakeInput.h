// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeInput_h
#define po_BakeInput_h

// From the inputs of the filter, on all processes, to the task of a bake.

#include "BakeMethods.h"

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
  SphereCloud own;              ///< particles of this process
  std::vector<unsigned> places; ///< of each of them in the cloud of the task
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
