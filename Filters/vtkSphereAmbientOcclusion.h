// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSphereAmbientOcclusion_h
#define vtkSphereAmbientOcclusion_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkSphereAmbientOcclusion : public vtkPolyDataAlgorithm
{
public:
  static vtkSphereAmbientOcclusion* New();
  vtkTypeMacro(vtkSphereAmbientOcclusion, vtkPolyDataAlgorithm);

protected:
  vtkSphereAmbientOcclusion() = default;
  ~vtkSphereAmbientOcclusion() override = default;

private:
  vtkSphereAmbientOcclusion(const vtkSphereAmbientOcclusion&) = delete;
  void operator=(const vtkSphereAmbientOcclusion&) = delete;
};

#endif
