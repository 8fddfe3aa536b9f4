// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRayTracedSphereMapperInternals_h
#define vtkRayTracedSphereMapperInternals_h

#include "FrameLayers.h"
#include "HiddenSpheres.h"
#include "InteractiveResolution.h"
#include "MapperInput.h"
#include "ParticleFilter.h"
#include "PointColors.h"
#include "SphereDrawer.h"
#include "SphereRenderer.h"
#include "TexturePaging.h"
#include "vtkRayTracedSphereMapper.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// What a mapper keeps from one frame to the next, and how that is brought up to date.
struct vtkRayTracedSphereMapper::Internals
{
  /// Of all mappers of the process: they often show the same spheres in several views.
  static const std::shared_ptr<po::SceneCache>& sharedScenes();

  po::MapperInput Input;
  po::TexturePaging Paging; ///< in place of the textures of the input
  po::SphereRenderer Renderer{ sharedScenes() };
  std::vector<po::CropRange> CropRanges;
  po::BlockStyles BlockStyles;
  std::uint64_t StylesVersion = 0;
  po::PointColors Colors;
  po::HiddenSpheres Hidden;
  po::InteractiveResolution Resolution;
  po::SphereDrawer Drawer;
  po::LastLayers Layers;
  std::uint64_t VersionBase = 0; ///< pictures of renderers that are gone

  /// Another number for other pictures.
  [[nodiscard]] std::uint64_t pictureVersion() const
  {
    const po::RenderStatistics& s = this->Renderer.statistics();
    return this->VersionBase + 1 + s.framesTraced + s.framesShaded + s.samplesAdded;
  }

  /// Of the texture file if there is one, else of the points.
  [[nodiscard]] const po::OcclusionTextures& textures() const
  {
    return this->Paging.isOn() ? this->Paging.textures() : this->Input.textures();
  }

  /// Is direct light in them?
  [[nodiscard]] bool hasBakedLight() const
  {
    return this->Paging.isOn() ? this->Paging.hasBakedLight() : this->Input.hasBakedLight();
  }

  /// Maps the scalars of the mapper's points.
  void updateColors(vtkRayTracedSphereMapper* mapper, vtkActor* actor);

  /// Hides spheres by cropping, styles of blocks and, if the actor is translucent, opacity.
  /// @return a warning, empty if there is none
  [[nodiscard]] std::string updateHidden(vtkRayTracedSphereMapper* mapper, vtkActor* actor);

  /// How the frame is to look. The style refers to arrays of this object, and waits for textures.
  [[nodiscard]] po::Style styleOf(
    const vtkRayTracedSphereMapper* mapper, vtkRenderer* renderer, vtkActor* actor) const;

  /// Layers of a picture of its own, which do not replace those of the last frame; an empty image
  /// if nothing can be drawn.
  [[nodiscard]] vtkSmartPointer<vtkImageData> traceLayers(const vtkRayTracedSphereMapper* mapper,
    vtkRenderer* renderer, vtkActor* actor, int width, int height);
};

#endif
