// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereMapperInternals.h"

#include "RenderState.h"

#include "vtkActor.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

const std::shared_ptr<po::SceneCache>& vtkRayTracedSphereMapper::Internals::sharedScenes()
{
  static const auto scenes = std::make_shared<po::SceneCache>();
  return scenes;
}

void vtkRayTracedSphereMapper::Internals::updateColors(
  vtkRayTracedSphereMapper* mapper, vtkActor* actor)
{
  int cellFlag = 0;
  vtkPolyData* points = mapper->GetInput();
  vtkProperty* property = actor->GetProperty();
  vtkUnsignedCharArray* colors = mapper->MapScalars(points, property->GetOpacity(), cellFlag);
  const bool onePerPoint = colors && cellFlag == 0 && colors->GetNumberOfComponents() == 4 &&
    colors->GetNumberOfTuples() == points->GetNumberOfPoints();
  this->Colors.update(
    *points, onePerPoint ? colors : nullptr, *property, this->BlockStyles, this->StylesVersion);
}

po::Style vtkRayTracedSphereMapper::Internals::styleOf(
  const vtkRayTracedSphereMapper* mapper, vtkRenderer* renderer, vtkActor* actor) const
{
  po::Style style;
  style.lights = po::lightsOf(renderer);
  style.material = po::materialOf(actor->GetProperty(), !style.lights.empty());
  style.material.mode = static_cast<po::ShadingMode>(mapper->ShadingMode);
  if (style.material.mode == po::ShadingMode::Both && this->hasBakedLight())
  {
    style.material.mode = po::ShadingMode::AmbientOcclusion; // light is not to count twice
  }
  style.material.occlusionOnDiffuse = mapper->OcclusionOnDiffuse;
  style.material.translucent = actor->HasTranslucentPolygonalGeometry();
  style.material.particleColors = this->Colors.rgba();
  style.material.colorsVersion = this->Colors.version();
  style.textures = this->textures();
  style.texturesVersion = this->Input.texturesVersion() + this->Paging.version();
  style.waitForTextures = true;
  style.shadows = mapper->Shadows;
  return style;
}

std::string vtkRayTracedSphereMapper::Internals::updateHidden(
  vtkRayTracedSphereMapper* mapper, vtkActor* actor)
{
  const bool translucent = actor->HasTranslucentPolygonalGeometry();
  const po::HidingRules rules{ po::clippingPlanesOf(*mapper, *actor), this->CropRanges,
    this->BlockStyles, this->StylesVersion, translucent ? &this->Colors : nullptr };
  return this->Hidden.update(*mapper->GetInput(), this->Input, rules, this->Renderer);
}

vtkSmartPointer<vtkImageData> vtkRayTracedSphereMapper::Internals::traceLayers(
  const vtkRayTracedSphereMapper* mapper, vtkRenderer* renderer, vtkActor* actor, int width,
  int height)
{
  vtkSmartPointer<vtkImageData> layers =
    po::traceLayers(this->Renderer, po::cameraOfPicture(renderer, width, height),
      po::placementOf(actor), this->styleOf(mapper, renderer, actor), mapper->SamplesPerPixel);
  if (layers->GetNumberOfPoints() > 0)
  {
    this->Layers.keepAt(this->pictureVersion());
  }
  return layers;
}
