// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRayTracedSphereRepresentation_h
#define vtkRayTracedSphereRepresentation_h

#include "ParticleOcclusionRepresentationsModule.h"
#include "vtkPVDataRepresentation.h"

class PARTICLEOCCLUSIONREPRESENTATIONS_EXPORT vtkRayTracedSphereRepresentation : public vtkPVDataRepresentation
{
public:
  static vtkRayTracedSphereRepresentation* New();
  vtkTypeMacro(vtkRayTracedSphereRepresentation, vtkPVDataRepresentation);

protected:
  vtkRayTracedSphereRepresentation() = default;
  ~vtkRayTracedSphereRepresentation() override = default;

private:
  vtkRayTracedSphereRepresentation(const vtkRayTracedSphereRepresentation&) = delete;
  void operator=(const vtkRayTracedSphereRepresentation&) = delete;
};

#endif
