// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_CropSettings_h
#define po_CropSettings_h

// Which particles a user wants: from arrays, a plane and a box to the cropping of the core.

#include "Cropping.h"
#include "ParticleOcclusionFiltersModule.h"

#include <string>
#include <tuple>
#include <vector>

class vtkPointSet;

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

/// Keeps what is in front of a plane.
struct CropPlane
{
  Vec3d origin;
  Vec3d normal; ///< points to what is kept
};

/// What properties say about cropping, of the filter and of the representation alike.
struct CropSettings
{
  CropRange range{ "", -1, -1e300, 1e300 }; ///< none without an array
  std::vector<CropRange> moreRanges;
  bool plane = false, box = false;
  Vec3d planeOrigin{ 0, 0, 0 };
  Vec3d planeNormal{ 0, 0, 1 }; ///< points to what is kept
  Vec3d boxOrigin{ 0, 0, 0 };   ///< the lower corner
  Vec3d boxSize{ 1, 1, 1 };
};

/// All of them: what is kept lies in each.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::vector<CropRange> rangesOf(
  const CropSettings& settings);
/// The plane, and the six of the box, as far as they are on.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::vector<CropPlane> planesOf(
  const CropSettings& settings);

/// Ranges over the arrays of the points, which are counted through all blocks. One whose array is
/// missing in a block that has points, not numeric, or has no such component hides nothing, and
/// `warning` says what is wrong. The blocks must outlive the result.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::vector<ValueRange> valueRangesOf(
  const std::vector<vtkPointSet*>& blocks, const std::vector<CropRange>& ranges,
  std::string& warning);
}

#endif
