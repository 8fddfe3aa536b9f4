// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphereAmbientOcclusionInternals.h"

#include "BakeCache.h"
#include "BakeInput.h"
#include "BakeParameters.h"
#include "BakedData.h"
#include "ControllerGroup.h"
#include "HeapMemory.h"

#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <chrono>
#include <functional>
#include <utility>

vtkStandardNewMacro(vtkSphereAmbientOcclusion);

namespace
{
/// Reports to the user interface, which may stop the bake.
/// @param progress what the report is for
po::Progress::Report reportTo(vtkAlgorithm* algorithm, const po::Progress& progress)
{
  return [algorithm, &progress](double share)
  {
    algorithm->SetProgressText(progress.phase().c_str()); // ParaView adds the share
    algorithm->UpdateProgress(share);
    return !algorithm->CheckAbort();
  };
}

/// For what has no share that is known.
void announce(vtkAlgorithm* algorithm, double share, const char* phase)
{
  algorithm->SetProgressText(phase);
  algorithm->UpdateProgress(share);
}
}

void vtkSphereAmbientOcclusion::Internals::Reset()
{
  this->Report = {};
  this->Seconds = 0;
  this->RadiusUsed.clear();
}

void vtkSphereAmbientOcclusion::Internals::Bake(vtkSphereAmbientOcclusion* self,
  const po::ProcessGroup& group, const std::vector<vtkPointSet*>& blocks,
  vtkDataObject* occluderData)
{
  const po::BakeSettings settings = po::settingsOf(*self);
  announce(self, 0, "Reading particles");
  po::BakeInput input = po::readBakeInput(*self, settings, blocks, occluderData, group);
  this->Report = input.report;
  this->RadiusUsed = input.radiusUsed;
  for (const std::string& warning : input.warnings)
  {
    vtkWarningWithObjectMacro(self, << warning);
  }

  po::Progress progress(reportTo(self, progress)); // which is called later
  const int method = po::chooseMethod(self->Method, input.task, group);
  std::string warning;
  if (!po::BakeReuse::suits(method, input.task))
  {
    this->Reuse = {}; // its memory may be needed
  }
  po::BakeResult result = po::bakeOrLoad(
    po::cacheOf(*self), method, input.task, group, progress, this->Report, this->Reuse, warning);
  if (!warning.empty())
  {
    vtkWarningWithObjectMacro(self, << warning);
  }
  if (result.aborted)
  {
    group.stop(po::WorkState::Aborted);
    throw po::WorkStopped(po::WorkState::Aborted, "");
  }
  po::returnFreeMemory();
  this->CountParticles(input, result, settings, group);
  const double error = this->Report.estimatedError;
  if (self->TargetError > 0 && error > self->TargetError && group.rank() == 0)
  {
    vtkWarningWithObjectMacro(self, << "TargetError " << self->TargetError
                                    << " is out of reach: the most that this method can do leaves "
                                    << error << ".");
  }
  group.agree(); // nobody was aborted: from here on it is all or nothing
  announce(self, 1, "Storing textures");
  po::attachBake(
    blocks, input.points, std::move(result), po::describeBake(*self, settings, this->Report));
  group.agree();
}

/// Ghosts were baked, since they are drawn, but count where they are at home.
void vtkSphereAmbientOcclusion::Internals::CountParticles(const po::BakeInput& input,
  const po::BakeResult& result, const po::BakeSettings& settings, const po::ProcessGroup& group)
{
  std::uint64_t owned = 0;
  std::uint64_t dark = 0;
  for (std::size_t point = 0; point < input.points.size(); ++point)
  {
    const bool isGhost = !input.ghosts.empty() && input.ghosts[point] != 0;
    if (input.points[point] != po::NoReceiver && !isGhost)
    {
      ++owned;
      dark += result.mean[input.points[point]] == 0 ? 1 : 0;
    }
  }
  const auto side = static_cast<std::uint64_t>(settings.textureResolution);
  this->Report.counters.particles = group.sum(owned);
  this->Report.counters.texels = this->Report.counters.particles * side * side;
  this->Report.counters.particlesDark = group.sum(dark);
  this->Report.textureBytes = group.sum(std::uint64_t(result.table.size()));
}

vtkSphereAmbientOcclusion::vtkSphereAmbientOcclusion()
  : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkSphereAmbientOcclusion::~vtkSphereAmbientOcclusion()
{
  this->SetRadiusArray(nullptr);
  this->SetIdArray(nullptr);
  this->SetCropArray(nullptr);
  this->SetBackgroundImage(nullptr);
  this->SetCacheDirectory(nullptr);
}

int vtkSphereAmbientOcclusion::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == OccludersPort)
  {
    // Any type, so that the one error of a wrong one is this filter's own.
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkSphereAmbientOcclusion::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto start = std::chrono::steady_clock::now();
  this->Impl->Reset();
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  vtkDataObject* occluders = vtkDataObject::GetData(inputVector[OccludersPort]);
  const po::ControllerGroup group(this->Controller);
  const auto bake = [&]
  {
    output->ShallowCopy(input); // of a composite data set the leaves too
    this->Impl->Bake(this, group, po::particleBlocks(output), occluders);
  };
  std::string error;
  // By reference: a copy would be memory that may be missing.
  const bool baked = po::runTogether(group, std::ref(bake), error);
  this->SetProgressText(nullptr);
  if (!baked)
  {
    this->Impl->Reset();
    output->ShallowCopy(input); // without what some blocks may have got before the fault
    this->SetErrorCode(vtkErrorCode::UserError);
    if (group.rank() == 0)
    {
      vtkErrorMacro(<< error);
    }
    return 1; // so that what is downstream shows the particles, though unbaked
  }
  this->SetAbortOutput(false); // or the pipeline would empty the output of an aborted bake
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  this->Impl->Seconds = elapsed.count();
  return 1;
}

void vtkSphereAmbientOcclusion::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkSphereAmbientOcclusion::GetController()
{
  return this->Controller;
}

void vtkSphereAmbientOcclusion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArray: " << (this->RadiusArray ? this->RadiusArray : "(automatic)") << "\n"
     << indent << "RadiusScale: " << this->RadiusScale << "\n"
     << indent << "ConstantRadius: " << this->ConstantRadius << "\n"
     << indent << "RadiusFrom: " << this->RadiusFrom << "\n"
     << indent << "Density: " << this->Density << "\n"
     << indent << "TextureResolution: " << this->TextureResolution << "\n"
     << indent << "SamplesPerTexel: " << this->SamplesPerTexel << "\n"
     << indent << "TargetError: " << this->TargetError << "\n"
     << indent << "Method: " << this->Method << "\n"
     << indent << "MaximumDistance: " << this->MaximumDistance << "\n"
     << indent << "Background: " << this->Background << "\n"
     << indent << "CropArray: " << (this->CropArray ? this->CropArray : "(none)") << "\n"
     << indent << "CropPlane: " << this->CropPlane << "\n"
     << indent << "CropBox: " << this->CropBox << "\n"
     << indent << "BakeLight: " << this->BakeLight << "\n"
     << indent << "LightDirection: " << this->LightDirection[0] << " " << this->LightDirection[1]
     << " " << this->LightDirection[2] << "\n"
     << indent << "LightIntensity: " << this->LightIntensity << "\n"
     << indent << "DilateInside: " << this->DilateInside << "\n"
     << indent << "InsideThreshold: " << this->InsideThreshold << "\n"
     << indent << "Encoding: " << this->Encoding << "\n"
     << indent << "Storage: " << this->Storage << "\n"
     << indent << "StorageError: " << this->StorageError << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "IdArray: " << (this->IdArray ? this->IdArray : "(automatic)") << "\n"
     << indent << "ReuseUnchanged: " << this->ReuseUnchanged << "\n"
     << indent << "OutOfCore: " << this->OutOfCore << "\n"
     << indent << "UseCache: " << this->UseCache << "\n"
     << indent << "CacheDirectory: " << (this->CacheDirectory ? this->CacheDirectory : "") << "\n"
     << indent << "CacheSizeLimit: " << this->CacheSizeLimit << "\n";
}
