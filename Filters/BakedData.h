// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakedData_h
#define po_BakedData_h

// From the blocks of a data set to one cloud of spheres, and from a bake back onto the blocks.

#include "OcclusionBaker.h"
#include "OcclusionParameters.h"
#include "SphereInput.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPointSet;

namespace po
{
/// The point sets to bake: the data set itself, or the leaves of a composite one that have points.
[[nodiscard]] std::vector<vtkPointSet*> particleBlocks(vtkDataObject* data);

/// One input of the particles of all blocks; sourceIds count through the blocks in order.
/// Nothing, and a message in `error`, under the conditions of readSphereCloud, which says what
/// `frame` and `group` are.
[[nodiscard]] std::optional<ParticleInput> readBlocks(const std::vector<vtkPointSet*>& blocks,
  const RadiusSettings& settings, std::string& error, const FrameChoice& frame,
  const ProcessGroup& group);

/// Of each point, through the blocks in order, its particle's number among those of a BakeResult.
using PointReceivers = std::vector<std::uint32_t>;
/// For points that are no particles, or were left out.
inline constexpr std::uint32_t NoReceiver = ~std::uint32_t(0);

/// Adds the arrays of the data contract to each block. A block gets the rows of the table that its
/// particles use; particles that were left out get row -1 and visibility 0.
/// @param result a single block takes over its memory
void attachBake(const std::vector<vtkPointSet*>& blocks, const PointReceivers& receivers,
  BakeResult&& result, const OcclusionParameters& parameters);
}

#endif
