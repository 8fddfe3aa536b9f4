// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BlockLooks_h
#define po_BlockLooks_h

// Looks that the user gives to blocks by selectors, as ParaView's Multiblock Inspector does.

#include "Tracked.h"

#include "vtkType.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

class vtkCompositeDataSet;
class vtkPolyData;
class vtkRayTracedSphereMapper;

namespace po
{
/// Keeps the hierarchy of a composite data set as a field array of the points that were gathered
/// from it, so that it goes wherever they go.
void keepHierarchy(vtkCompositeDataSet& blocks, vtkPolyData& points);

/// Selectors are paths in the hierarchy, such as "/Root/Block0"; a later one wins.
struct BlockLooks
{
  std::vector<std::string> visible{ "/" };
  std::vector<std::pair<std::string, std::array<double, 3>>> colors;
  std::vector<std::pair<std::string, double>> opacities;

  [[nodiscard]] bool anyTranslucent() const;

  /// Sets the mapper's styles of blocks; none where the points have no hierarchy.
  void apply(vtkPolyData& points, vtkRayTracedSphereMapper& mapper) const;
};

/// Looks on a mapper, set again when they or its points have changed.
class AppliedBlockLooks
{
public:
  [[nodiscard]] BlockLooks& change() { return looks_.change(); }
  [[nodiscard]] const BlockLooks& get() const { return looks_.get(); }

  void update(vtkRayTracedSphereMapper& mapper);

private:
  Tracked<BlockLooks> looks_;
  std::pair<vtkPolyData*, vtkMTimeType> points_{}; ///< that the mapper's styles are for
};
}

#endif
