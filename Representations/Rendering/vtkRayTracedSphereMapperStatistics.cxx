// SPDX-License-Identifier: BSD-3-Clause

// What vtkRayTracedSphereMapper says of the work that was done.

#include "vtkRayTracedSphereMapperInternals.h"

vtkIdType vtkRayTracedSphereMapper::GetNumberOfScenes()
{
  return static_cast<vtkIdType>(Internals::sharedScenes()->size());
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfSpheres()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.cloud().spheres.size());
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfShownSpheres()
{
  return this->GetNumberOfSpheres() - this->Internal->Hidden.count();
}

int vtkRayTracedSphereMapper::GetNumberOfSamples()
{
  return this->Internal->Renderer.samples();
}

int vtkRayTracedSphereMapper::GetNumberOfLayers()
{
  return this->Internal->Renderer.isShaded()
    ? 1 + static_cast<int>(this->Internal->Renderer.layersBehind().size())
    : 0;
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfRays()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().trace.rays);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfShadowRays()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().shadows.rays);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfSkippedTiles()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().trace.tilesSkipped);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfSkippedShadowRays()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().shadows.skipped);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfTracedFrames()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().framesTraced);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfTracedShadows()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().shadowsTraced);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfResidentTextures()
{
  const auto& paged = this->Internal->Paging.textures().paged();
  return paged ? static_cast<vtkIdType>(paged->resident()) : 0;
}

vtkIdType vtkRayTracedSphereMapper::GetResidentTextureBytes()
{
  const auto& paged = this->Internal->Paging.textures().paged();
  return paged ? static_cast<vtkIdType>(paged->bytes()) : 0;
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfMissingTextures()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().missingTextures);
}

double vtkRayTracedSphereMapper::GetBuildSeconds()
{
  return this->Internal->Renderer.statistics().buildSeconds;
}

double vtkRayTracedSphereMapper::GetTraceSeconds()
{
  return this->Internal->Renderer.statistics().traceSeconds;
}

double vtkRayTracedSphereMapper::GetShadowSeconds()
{
  return this->Internal->Renderer.statistics().shadowSeconds;
}

double vtkRayTracedSphereMapper::GetShadeSeconds()
{
  return this->Internal->Renderer.statistics().shadeSeconds;
}
