// SPDX-License-Identifier: BSD-3-Clause

// Parameters and results of vtkRayTracedSphereRepresentation that are those of its mapper, its
// actor or the actor's property.

#include "vtkRayTracedSphereRepresentation.h"

#include "vtkActor.h"
#include "vtkProperty.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkScalarsToColors.h"

void vtkRayTracedSphereRepresentation::SetShadingMode(int mode)
{
  this->Mapper->SetShadingMode(mode);
}

void vtkRayTracedSphereRepresentation::SetOcclusionOnDiffuse(bool on)
{
  this->Mapper->SetOcclusionOnDiffuse(on);
}

void vtkRayTracedSphereRepresentation::SetShadows(bool on)
{
  this->Mapper->SetShadows(on);
}

void vtkRayTracedSphereRepresentation::SetSamplesPerPixel(int samples)
{
  this->Mapper->SetSamplesPerPixel(samples);
}

void vtkRayTracedSphereRepresentation::SetInteractiveRate(double framesPerSecond)
{
  this->Mapper->SetInteractiveRate(framesPerSecond);
}

void vtkRayTracedSphereRepresentation::SetTextureFile(const char* name)
{
  this->Mapper->SetTextureFile(name);
}

void vtkRayTracedSphereRepresentation::SetTextureBudget(double mebibytes)
{
  this->Mapper->SetTextureBudget(mebibytes);
}

void vtkRayTracedSphereRepresentation::SetLookupTable(vtkScalarsToColors* table)
{
  this->Mapper->SetLookupTable(table);
}

void vtkRayTracedSphereRepresentation::SetMapScalars(int map)
{
  this->Mapper->SetColorMode(map != 0 ? VTK_COLOR_MODE_MAP_SCALARS : VTK_COLOR_MODE_DIRECT_SCALARS);
}

vtkImageData* vtkRayTracedSphereRepresentation::GetLayers()
{
  return this->Mapper->GetLayers();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfSpheres()
{
  return this->Mapper->GetNumberOfSpheres();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfShownSpheres()
{
  return this->Mapper->GetNumberOfShownSpheres();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfTracedFrames()
{
  return this->Mapper->GetNumberOfTracedFrames();
}

int vtkRayTracedSphereRepresentation::GetNumberOfSamples()
{
  return this->Mapper->GetNumberOfSamples();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfResidentTextures()
{
  return this->Mapper->GetNumberOfResidentTextures();
}

vtkIdType vtkRayTracedSphereRepresentation::GetResidentTextureBytes()
{
  return this->Mapper->GetResidentTextureBytes();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfMissingTextures()
{
  return this->Mapper->GetNumberOfMissingTextures();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfScenes()
{
  return vtkRayTracedSphereMapper::GetNumberOfScenes();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfRays()
{
  return this->Mapper->GetNumberOfRays();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfShadowRays()
{
  return this->Mapper->GetNumberOfShadowRays();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfSkippedTiles()
{
  return this->Mapper->GetNumberOfSkippedTiles();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfSkippedShadowRays()
{
  return this->Mapper->GetNumberOfSkippedShadowRays();
}

double vtkRayTracedSphereRepresentation::GetTraceSeconds()
{
  return this->Mapper->GetTraceSeconds();
}

double vtkRayTracedSphereRepresentation::GetShadowSeconds()
{
  return this->Mapper->GetShadowSeconds();
}

double vtkRayTracedSphereRepresentation::GetShadeSeconds()
{
  return this->Mapper->GetShadeSeconds();
}

void vtkRayTracedSphereRepresentation::SetOrientation(double x, double y, double z)
{
  this->Actor->SetOrientation(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetOrigin(double x, double y, double z)
{
  this->Actor->SetOrigin(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetPickable(int pickable)
{
  this->Actor->SetPickable(pickable);
}

void vtkRayTracedSphereRepresentation::SetPosition(double x, double y, double z)
{
  this->Actor->SetPosition(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetScale(double x, double y, double z)
{
  this->Actor->SetScale(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetAmbient(double coefficient)
{
  this->Actor->GetProperty()->SetAmbient(coefficient);
}

void vtkRayTracedSphereRepresentation::SetAmbientColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetAmbientColor(r, g, b);
}

void vtkRayTracedSphereRepresentation::SetDiffuse(double coefficient)
{
  this->Actor->GetProperty()->SetDiffuse(coefficient);
}

void vtkRayTracedSphereRepresentation::SetDiffuseColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetDiffuseColor(r, g, b);
}

void vtkRayTracedSphereRepresentation::SetOpacity(double opacity)
{
  this->Actor->GetProperty()->SetOpacity(opacity);
}

void vtkRayTracedSphereRepresentation::SetSpecular(double coefficient)
{
  this->Actor->GetProperty()->SetSpecular(coefficient);
}

void vtkRayTracedSphereRepresentation::SetSpecularColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetSpecularColor(r, g, b);
}

void vtkRayTracedSphereRepresentation::SetSpecularPower(double power)
{
  this->Actor->GetProperty()->SetSpecularPower(power);
}
