// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRayTracedSphereMapper_h
#define vtkRayTracedSphereMapper_h

#include "ParticleOcclusionRenderingModule.h"
#include "vtkPolyDataMapper.h"

class PARTICLEOCCLUSIONRENDERING_EXPORT vtkRayTracedSphereMapper : public vtkPolyDataMapper
{
public:
  static vtkRayTracedSphereMapper* New();
  vtkTypeMacro(vtkRayTracedSphereMapper, vtkPolyDataMapper);

protected:
  vtkRayTracedSphereMapper() = default;
  ~vtkRayTracedSphereMapper() override = default;

private:
  vtkRayTracedSphereMapper(const vtkRayTracedSphereMapper&) = delete;
  void operator=(const vtkRayTracedSphereMapper&) = delete;
};

#endif
