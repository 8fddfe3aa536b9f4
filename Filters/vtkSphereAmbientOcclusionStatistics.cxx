// SPDX-License-Identifier: BSD-3-Clause

// What vtkSphereAmbientOcclusion says of the work that was done, and of that to come.

#include "vtkSphereAmbientOcclusionInternals.h"

#include "BakeCost.h"
#include "BakeParameters.h"
#include "BakedData.h"

#include "vtkBakeResources.h"
#include "vtkNew.h"
#include "vtkPointSet.h"

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticles()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.particles);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTexels()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.texels);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfRays()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.rays);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfSamplesInside()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.samplesInside);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTexelsInside()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.texelsInside);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesBuried()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.particlesBuried);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesDark()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.particlesDark);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesLeftOut()
{
  return static_cast<vtkIdType>(this->Impl->Report.leftOut);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTextures()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.texturesStored);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTextureBytes()
{
  return static_cast<vtkIdType>(this->Impl->Report.textureBytes);
}

int vtkSphereAmbientOcclusion::GetNumberOfThreads()
{
  return static_cast<int>(this->Impl->Report.counters.threads);
}

const char* vtkSphereAmbientOcclusion::GetMethodUsed()
{
  return po::nameOfMethod(this->Impl->Report.method);
}

int vtkSphereAmbientOcclusion::GetNumberOfDirections()
{
  return this->Impl->Report.directions;
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesRefined()
{
  return static_cast<vtkIdType>(this->Impl->Report.refined);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesReused()
{
  return static_cast<vtkIdType>(this->Impl->Report.reused);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfVisitsClosed()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.spheresClosed);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfVisitsNeverSeen()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.spheresNeverSeen);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfDirectionsBlack()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.directionsBlack);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesAlone()
{
  return static_cast<vtkIdType>(this->Impl->Report.counters.particlesAlone);
}

const char* vtkSphereAmbientOcclusion::GetRadiusUsed()
{
  return this->Impl->RadiusUsed.c_str();
}

int vtkSphereAmbientOcclusion::GetNumberOfSamplesUsed()
{
  return this->Impl->Report.samplesUsed;
}

double vtkSphereAmbientOcclusion::GetStorageDifference()
{
  return this->Impl->Report.storageDifference;
}

double vtkSphereAmbientOcclusion::GetEstimatedError()
{
  return this->Impl->Report.estimatedError;
}

double vtkSphereAmbientOcclusion::GetBakeSeconds()
{
  return this->Impl->Seconds;
}

bool vtkSphereAmbientOcclusion::GetLoadedFromCache()
{
  return this->Impl->Report.loaded;
}

const char* vtkSphereAmbientOcclusion::GetBakeEstimate()
{
  po::BakeWork work;
  if (this->GetNumberOfInputConnections(ParticlesPort) > 0)
  {
    for (vtkPointSet* block : po::particleBlocks(this->GetInputDataObject(ParticlesPort, 0)))
    {
      work.particles += static_cast<std::size_t>(block->GetNumberOfPoints());
    }
  }
  work.method = this->Method;
  work.settings.textureResolution = this->TextureResolution;
  work.settings.samplesPerTexel = this->SamplesPerTexel;
  work.settings.encoding = static_cast<po::Encoding>(this->Encoding);
  work.settings.storage = static_cast<po::Storage>(this->Storage);
  if (this->BakeLight)
  {
    work.settings.light.emplace();
  }
  work.targetError = this->TargetError;
  work.outOfCore = this->OutOfCore;
  work.reuseUnchanged = this->ReuseUnchanged;
  work.settings.maximumDistance = this->MaximumDistance;
  const vtkNew<vtkBakeResources> resources;
  this->Impl->Estimate = po::describe(po::estimateCost(work), work.particles,
    resources->GetNumberOfCores(), resources->GetFreeMemory());
  return this->Impl->Estimate.c_str();
}
