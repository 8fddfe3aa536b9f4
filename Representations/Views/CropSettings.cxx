// SPDX-License-Identifier: BSD-3-Clause
#include "CropSettings.h"

#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkRayTracedSphereMapper.h"

#include <cstddef>

namespace po
{
namespace
{
using Point = std::array<double, 3>;

void addRange(vtkRayTracedSphereMapper& mapper, const CropSettings::Range& range)
{
  mapper.AddCropRange(range.array.c_str(), range.component, range.low, range.high);
}

void addPlane(vtkRayTracedSphereMapper& mapper, const Point& origin, const Point& normal)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin.data());
  plane->SetNormal(normal.data());
  mapper.AddClippingPlane(plane);
}

/// The six planes of a box along the axes.
void addBox(vtkRayTracedSphereMapper& mapper, const Point& origin, const Point& size)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double end : { 0.0, 1.0 })
    {
      Point point = origin, normal{ 0, 0, 0 };
      point[axis] += end * size[axis];
      normal[axis] = end == 0 ? 1 : -1;
      addPlane(mapper, point, normal);
    }
  }
}
}

void CropSettings::apply(vtkRayTracedSphereMapper& mapper) const
{
  mapper.RemoveAllCropRanges();
  mapper.RemoveAllClippingPlanes();
  if (!range.array.empty())
  {
    addRange(mapper, range);
  }
  for (const Range& another : moreRanges)
  {
    addRange(mapper, another);
  }
  if (plane)
  {
    addPlane(mapper, planeOrigin, planeNormal);
  }
  if (box)
  {
    addBox(mapper, boxOrigin, boxSize);
  }
}
}
