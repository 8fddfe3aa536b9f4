// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParticleFilter_h
#define po_ParticleFilter_h

// Which points a mapper shows: from VTK's planes, arrays and colours to the hidden spheres of the
// core.

#include "Cropping.h"

#include <map>
#include <string>
#include <tuple>
#include <vector>

class vtkActor;
class vtkMapper;
class vtkPolyData;

namespace po
{
/// Keeps points whose value of an array is within a range.
struct CropRange
{
  std::string array;
  int component = 0; ///< -1: the magnitude
  double low = 0, high = 0;

  [[nodiscard]] bool operator==(const CropRange& o) const
  {
    return std::tie(array, component, low, high) == std::tie(o.array, o.component, o.low, o.high);
  }
};

/// The mapper's clipping planes in the coordinates of the points.
[[nodiscard]] std::vector<HalfSpace> clippingPlanesOf(vtkMapper& mapper, vtkActor& actor);

/// Ranges over the arrays of the points. One whose array is missing, not numeric, or has no such
/// component hides nothing, and `warning` says what is wrong.
[[nodiscard]] std::vector<ValueRange> valueRangesOf(
  vtkPolyData& points, const std::vector<CropRange>& ranges, std::string& warning);
}

#endif
