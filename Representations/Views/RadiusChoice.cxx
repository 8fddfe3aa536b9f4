// SPDX-License-Identifier: BSD-3-Clause
#include "RadiusChoice.h"

#include "ControllerGroup.h"

#include "vtkMultiProcessController.h"
#include "vtkPolyData.h"
#include "vtkRayTracedSphereMapper.h"

namespace po
{
RadiusSettings& RadiusChoice::change()
{
  changed_.Modified();
  return asked_;
}

void RadiusChoice::resolve(vtkPolyData& particles, vtkRayTracedSphereMapper& mapper)
{
  const ControllerGroup group(vtkMultiProcessController::GetGlobalController());
  RadiusSettings radii = asked_;
  used_.clear();
  if (group.size() > 1 || particles.GetNumberOfPoints() > 0)
  {
    radii = resolveRadii(particles, asked_, group);
    used_ = describe(asked_, radii);
  }
  mapper.SetRadiusArray(radii.array.c_str());
  mapper.SetRadiusScale(radii.scale);
  mapper.SetConstantRadius(radii.constant);
  mapper.SetRadiusFrom(static_cast<int>(radii.from));
  mapper.SetDensity(radii.density);
}
}
