// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OccluderInput_h
#define po_OccluderInput_h

// From the data set on the port Occluders to triangles and spheres of the core.

#include "OccluderMesh.h"
#include "SphereInput.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace po
{
/// What was found, and one message for each kind of thing that was left out.
struct OccluderInput
{
  Occluders occluders;
  std::vector<std::string> warnings;
};

/// Reads a vtkPolyData or a composite data set of them; null or without points: no occluders.
///
/// A block with polygons or strips is a mesh, of which only these cells count. The points of all
/// other blocks are spheres, with radii as in readBlocks; blocks that have lines alone are left
/// out. All lengths come out in the local coordinates of `particles`. Each process of the group
/// reads its own; warnings, and what is asked of a radius array, are of all together.
///
/// Throws std::invalid_argument, with a message that names the port, for data of another type and
/// under the conditions of readSphereCloud.
[[nodiscard]] OccluderInput readOccluders(vtkDataObject* data, const RadiusSettings& radii,
  const SphereCloud& particles, const ProcessGroup& group);
}

#endif
