// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereRepresentationInternals.h"

#include "vtkDataObject.h"

#include <string>

// Cropping takes effect when the view is rendered next; nothing is updated for it.

void vtkRayTracedSphereRepresentation::AddCropRange(
  const char* array, int component, double low, double high)
{
  this->Internal->Crop.change().moreRanges.push_back({ array ? array : "", component, low, high });
}

void vtkRayTracedSphereRepresentation::RemoveAllCropRanges()
{
  this->Internal->Crop.change().moreRanges.clear();
}

void vtkRayTracedSphereRepresentation::SetCropArray(
  int, int, int, int association, const char* name)
{
  const bool ofPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  const bool isOne = name && std::string(name) != po::RadiusSettings::NoArray;
  this->Internal->Crop.change().range.array = ofPoints && isOne ? name : "";
}

void vtkRayTracedSphereRepresentation::SetCropComponent(int component)
{
  this->Internal->Crop.change().range.component = component;
}

void vtkRayTracedSphereRepresentation::SetCropRange(double low, double high)
{
  po::CropSettings& crop = this->Internal->Crop.change();
  crop.range.low = low;
  crop.range.high = high;
}

void vtkRayTracedSphereRepresentation::SetCropPlane(bool on)
{
  this->Internal->Crop.change().plane = on;
}

void vtkRayTracedSphereRepresentation::SetCropPlaneOrigin(double x, double y, double z)
{
  this->Internal->Crop.change().planeOrigin = { x, y, z };
}

void vtkRayTracedSphereRepresentation::SetCropPlaneNormal(double x, double y, double z)
{
  this->Internal->Crop.change().planeNormal = { x, y, z };
}

void vtkRayTracedSphereRepresentation::SetCropBox(bool on)
{
  this->Internal->Crop.change().box = on;
}

void vtkRayTracedSphereRepresentation::SetCropBoxOrigin(double x, double y, double z)
{
  this->Internal->Crop.change().boxOrigin = { x, y, z };
}

void vtkRayTracedSphereRepresentation::SetCropBoxSize(double x, double y, double z)
{
  this->Internal->Crop.change().boxSize = { x, y, z };
}
