// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_GeometryHash_h
#define po_GeometryHash_h

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkPointSet;

namespace po
{
/// 32 hexadecimal digits that stand for particles: their positions and, where there is a radius
/// array, their radii, in the order of the points. Whether numbers are stored as floats or as
/// doubles makes no difference.
/// @param radiusArray as in RadiusSettings; an array that the points lack is left out
[[nodiscard]] std::string hashGeometry(vtkPointSet& points, const std::string& radiusArray);

/// 64 bits, in halves, that stand for the position and radius of one particle.
using PlaceHash = std::array<std::uint32_t, 2>;

/// Of every point; under the same conditions.
[[nodiscard]] std::vector<PlaceHash> placeHashes(
  vtkPointSet& points, const std::string& radiusArray);
}

#endif
