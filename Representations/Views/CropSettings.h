// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_CropSettings_h
#define po_CropSettings_h

#include <array>
#include <string>
#include <vector>

class vtkRayTracedSphereMapper;

namespace po
{
/// What the panel's properties say about cropping; turned into the mapper's planes and ranges.
struct CropSettings
{
  struct Range
  {
    std::string array;
    int component = -1; ///< -1: the magnitude
    double low = 0, high = 0;
  };

  Range range{ "", -1, -1e300, 1e300 }; ///< of the panel; none without an array
  std::vector<Range> moreRanges;
  bool plane = false, box = false;
  std::array<double, 3> planeOrigin{ 0, 0, 0 };
  std::array<double, 3> planeNormal{ 0, 0, 1 }; ///< points to what is shown
  std::array<double, 3> boxOrigin{ 0, 0, 0 };   ///< the lower corner
  std::array<double, 3> boxSize{ 1, 1, 1 };

  /// Replaces all ranges and planes of the mapper.
  void apply(vtkRayTracedSphereMapper& mapper) const;
};
}

#endif
