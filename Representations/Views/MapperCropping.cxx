// SPDX-License-Identifier: BSD-3-Clause
#include "MapperCropping.h"

#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkRayTracedSphereMapper.h"

namespace po
{
void crop(vtkRayTracedSphereMapper& mapper, const CropSettings& settings)
{
  mapper.RemoveAllCropRanges();
  mapper.RemoveAllClippingPlanes();
  for (const CropRange& range : rangesOf(settings))
  {
    mapper.AddCropRange(range.array.c_str(), range.component, range.low, range.high);
  }
  for (const CropPlane& cropPlane : planesOf(settings))
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(&cropPlane.origin.x);
    plane->SetNormal(&cropPlane.normal.x);
    mapper.AddClippingPlane(plane);
  }
}
}
