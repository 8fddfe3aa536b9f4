// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRayTracedSphereRepresentationInternals_h
#define vtkRayTracedSphereRepresentationInternals_h

#include "BlockLooks.h"
#include "CropSettings.h"
#include "LayersFile.h"
#include "ParticleDelivery.h"
#include "RadiusChoice.h"
#include "Refinement.h"
#include "SelectionSight.h"
#include "Tracked.h"
#include "vtkRayTracedSphereRepresentation.h"

#include "vtkMath.h"
#include "vtkPVRenderView.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkWeakPointer.h"

struct vtkRayTracedSphereRepresentation::Internals
{
  explicit Internals(vtkRayTracedSphereMapper* mapper)
    : Refinement(mapper)
  {
    vtkMath::UninitializeBounds(this->Bounds);
  }

  vtkSmartPointer<vtkPolyData> Particles;
  vtkSmartPointer<vtkDataObject> Piece; ///< the particles as they are delivered
  po::DeliveredParticles Delivered;
  po::RadiusChoice Radii;
  double Bounds[6]; ///< of the spheres, radii included, before the actor's matrix
  vtkTimeStamp BoundsTime;
  po::Tracked<po::CropSettings> Crop;
  po::AppliedBlockLooks Blocks;
  po::LayersFile Layers;
  po::Refinement Refinement;
  po::SelectionSight Sight;
  vtkWeakPointer<vtkPVRenderView> View;
};

#endif
