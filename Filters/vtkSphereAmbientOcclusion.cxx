// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphereAmbientOcclusion.h"

#include "BakedData.h"
#include "EmbreeEstimator.h"
#include "ErrorPilot.h"
#include "ExrBackground.h"
#include "OccluderInput.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <vtksys/SystemInformation.hxx>

#include <chrono>
#include <cmath>
#include <new>
#include <sstream>
#include <stdexcept>

vtkStandardNewMacro(vtkSphereAmbientOcclusion);

namespace
{
/// Version of the layout that AmbientOcclusionParameters describes.
constexpr int ContractVersion = 1;

constexpr const char* MethodNames[] = { "Automatic", "Sweep", "Embree", "Reference" };
constexpr const char* BackgroundNames[] = { "Uniform", "Gradient", "Image" };
constexpr const char* EncodingNames[] = { po::UInt8Gamma2, po::Float32Linear };

/// A parameter that is out of its range: throws a message that says the range.
template <typename T>
void requireRange(const char* name, T value, T low, T high)
{
  if (!(value >= low && value <= high))
  {
    std::ostringstream message;
    message << name << " must be between " << low << " and " << high << ", but is " << value << ".";
    throw std::invalid_argument(message.str());
  }
}

void requireNotNegative(const char* name, double value, const char* zeroMeans = "")
{
  if (!(value >= 0) || !std::isfinite(value))
  {
    std::ostringstream message;
    message << name << " must be a number of at least 0" << zeroMeans << ", but is " << value
            << ".";
    throw std::invalid_argument(message.str());
  }
}

std::string inGigabytes(double bytes)
{
  std::ostringstream text;
  text.precision(3);
  text << bytes / (1024.0 * 1024.0 * 1024.0) << " GiB";
  return text.str();
}

double freeMemory()
{
  vtksys::SystemInformation system;
  const double kibibytes = static_cast<double>(system.GetHostMemoryAvailable(nullptr)) -
    static_cast<double>(system.GetHostMemoryUsed());
  return 1024.0 * std::max(kibibytes, 0.0);
}

/// Says beforehand what would otherwise end in swapping or in a killed process.
void requireMemory(double needed, std::size_t particles)
{
  const double available = freeMemory();
  if (needed > available)
  {
    throw std::runtime_error("Baking " + std::to_string(particles) + " particles needs up to " +
      inGigabytes(needed) + " of memory, but " + inGigabytes(available) +
      " are free: lower TextureResolution, choose the Method Embree or the Encoding "
      "UInt8Gamma2, or bake fewer particles.");
  }
}

/// Reports to the user interface, which may stop the bake.
po::Progress::Report reportTo(vtkAlgorithm* algorithm)
{
  return [algorithm](double share)
  {
    algorithm->UpdateProgress(share);
    return !algorithm->CheckAbort();
  };
}

double sceneMemory(const po::SphereCloud& cloud, const po::Occluders& occluders,
  const po::BakeSettings& settings, const po::OcclusionEstimator& estimator)
{
  return po::bakeMemory(cloud.spheres.size(), settings, estimator) + po::occluderMemory(occluders);
}

/// Sweep is the fastest one for whole sets, wherever its memory is there, but knows spheres only.
int chooseMethod(int method, const po::SphereCloud& cloud, const po::Occluders& occluders,
  const po::BakeSettings& settings, const po::SweepOptions& sweep)
{
  const bool triangles = !occluders.mesh.triangles.empty();
  if (method == vtkSphereAmbientOcclusion::Sweep && triangles)
  {
    throw std::invalid_argument("Method Sweep does not see the triangles of the input Occluders: "
                                "choose the Method Automatic or Embree.");
  }
  if (method != vtkSphereAmbientOcclusion::Automatic)
  {
    return method;
  }
  // Within about two radii the near spheres, which Embree's method tests without rays, are all
  // there is: it was 1.1 to 1.8 times as fast up to that, and half as fast or less at five.
  const bool close = settings.maximumDistance > 0 && settings.maximumDistance <= 2 * cloud.scale;
  const bool fits =
    sceneMemory(cloud, occluders, settings, po::SweepEstimator(sweep)) <= freeMemory();
  return !triangles && !close && fits ? vtkSphereAmbientOcclusion::Sweep
                                      : vtkSphereAmbientOcclusion::Embree;
}
}

/// What the last execution did.
struct vtkSphereAmbientOcclusion::Internals
{
  po::BakeCounters Counters;
  std::size_t LeftOut = 0;
  std::size_t TextureBytes = 0;
  int Method = Automatic; ///< the one that was used
  int Directions = 0;
  std::size_t Refined = 0;
  int SamplesUsed = 0;
  double EstimatedError = 0;
  double Seconds = 0;

  /// Throws std::invalid_argument naming the parameter that is out of range.
  static po::BakeSettings ReadSettings(vtkSphereAmbientOcclusion* self);
  static po::Background ReadBackground(vtkSphereAmbientOcclusion* self);
  static po::RadiusSettings ReadRadius(vtkSphereAmbientOcclusion* self);
  static po::SweepOptions SweepOptions(vtkSphereAmbientOcclusion* self);

  po::OcclusionParameters Describe(vtkSphereAmbientOcclusion* self,
    const po::BakeSettings& settings, const po::EncodedTable& table,
    const po::Occluders& occluders) const;

  void Bake(vtkSphereAmbientOcclusion* self, const std::vector<vtkPolyData*>& blocks,
    vtkDataObject* occluderData);
  static po::SphereCloud ReadParticles(
    vtkSphereAmbientOcclusion* self, const std::vector<vtkPolyData*>& blocks);
  static po::Occluders ReadOccluders(
    vtkSphereAmbientOcclusion* self, vtkDataObject* data, const po::SphereCloud& cloud);

  /// Settings are changed to what is used in their place.
  po::BakeResult BakeByMethod(vtkSphereAmbientOcclusion* self, const po::SphereCloud& cloud,
    const po::Occluders& occluders, po::BakeSettings& settings);
  po::BakeResult BakeBySweep(vtkSphereAmbientOcclusion* self, const po::SphereCloud& cloud,
    const po::Occluders& occluders, const po::BakeSettings& settings);
  po::BakeResult BakeByEmbree(vtkSphereAmbientOcclusion* self, const po::SphereCloud& cloud,
    const po::Occluders& occluders, const po::BakeSettings& settings);

  /// With a target error the samples that reach it are put into the settings.
  po::BakeResult BakeByReference(vtkSphereAmbientOcclusion* self, const po::SphereCloud& cloud,
    const po::Occluders& occluders, po::BakeSettings& settings);
};

po::Background vtkSphereAmbientOcclusion::Internals::ReadBackground(vtkSphereAmbientOcclusion* self)
{
  requireRange<int>("Background", self->Background, Uniform, Image);
  if (self->Background == Gradient)
  {
    const double* up = self->BackgroundUp;
    const po::GradientBackground gradient{ { up[0], up[1], up[2] }, self->BackgroundBottom,
      self->BackgroundTop };
    if (!(po::length(gradient.up) > 0) || !std::isfinite(po::length(gradient.up)))
    {
      throw std::invalid_argument("BackgroundUp must be a direction, not the zero vector.");
    }
    requireNotNegative("BackgroundBottom", gradient.bottom);
    requireNotNegative("BackgroundTop", gradient.top);
    return gradient;
  }
  if (self->Background == Image)
  {
    if (!self->BackgroundImage || !self->BackgroundImage[0])
    {
      throw std::invalid_argument(
        "BackgroundImage is empty: choose an OpenEXR file in latitude and "
        "longitude, or another Background.");
    }
    po::LatLongImage image = po::readLatLongImage(self->BackgroundImage);
    return po::ImageBackground{ image.width, image.height, std::move(image.luminance) };
  }
  return po::UniformBackground{};
}

po::BakeSettings vtkSphereAmbientOcclusion::Internals::ReadSettings(vtkSphereAmbientOcclusion* self)
{
  requireRange(
    "TextureResolution", self->TextureResolution, 1, po::BakeSettings::MaximumTextureResolution);
  requireRange(
    "SamplesPerTexel", self->SamplesPerTexel, 1, po::BakeSettings::MaximumSamplesPerTexel);
  requireRange("TargetError", self->TargetError, 0.0, 1.0);
  requireRange("InsideThreshold", self->InsideThreshold, 0.0, 1.0);
  requireRange<int>("Encoding", self->Encoding, UInt8Gamma2, Float32Linear);
  requireRange("Seed", self->Seed, 0, VTK_INT_MAX);
  requireNotNegative("MaximumDistance", self->MaximumDistance, " (0 = unbounded)");
  requireRange<int>("Method", self->Method, Automatic, Reference);
  po::BakeSettings settings;
  settings.textureResolution = self->TextureResolution;
  settings.samplesPerTexel = self->SamplesPerTexel;
  settings.maximumDistance = self->MaximumDistance;
  settings.dilateInside = self->DilateInside;
  settings.insideThreshold = self->InsideThreshold;
  settings.encoding = static_cast<po::Encoding>(self->Encoding);
  settings.seed = static_cast<std::uint64_t>(self->Seed);
  settings.background = ReadBackground(self);
  return settings;
}

po::RadiusSettings vtkSphereAmbientOcclusion::Internals::ReadRadius(vtkSphereAmbientOcclusion* self)
{
  return { self->RadiusArray ? self->RadiusArray : "", self->RadiusScale, self->ConstantRadius };
}

po::SweepOptions vtkSphereAmbientOcclusion::Internals::SweepOptions(vtkSphereAmbientOcclusion* self)
{
  po::SweepOptions options;
  options.targetError = self->TargetError;
  return options;
}

po::OcclusionParameters vtkSphereAmbientOcclusion::Internals::Describe(
  vtkSphereAmbientOcclusion* self, const po::BakeSettings& settings, const po::EncodedTable& table,
  const po::Occluders& occluders) const
{
  po::OcclusionParameters parameters;
  parameters.set("version", ContractVersion);
  parameters.set("method", MethodNames[this->Method]);
  parameters.set("resolution", settings.textureResolution);
  parameters.set("samplesPerTexel", settings.samplesPerTexel);
  parameters.set("seed", self->Seed);
  parameters.set("encoding", EncodingNames[self->Encoding]);
  parameters.set("gamma", settings.encoding == po::Encoding::UInt8Gamma2 ? 2.0 : 1.0);
  parameters.set("maximum", table.maximum);
  parameters.set("insideThreshold", settings.insideThreshold);
  parameters.set("dilateInside", settings.dilateInside);
  parameters.set("maximumDistance", settings.maximumDistance);
  parameters.set("radiusArray", self->RadiusArray ? self->RadiusArray : "");
  parameters.set("radiusScale", self->RadiusScale);
  parameters.set("constantRadius", self->ConstantRadius);
  parameters.set("background", BackgroundNames[self->Background]);
  if (self->Background == Gradient)
  {
    std::ostringstream up;
    up.imbue(std::locale::classic());
    up.precision(17);
    up << self->BackgroundUp[0] << ' ' << self->BackgroundUp[1] << ' ' << self->BackgroundUp[2];
    parameters.set("backgroundUp", up.str());
    parameters.set("backgroundBottom", self->BackgroundBottom);
    parameters.set("backgroundTop", self->BackgroundTop);
  }
  if (self->Background == Image)
  {
    parameters.set("backgroundImage", self->BackgroundImage);
  }
  parameters.set("targetError", self->TargetError);
  parameters.set("estimatedError", this->EstimatedError);
  parameters.set("directions", this->Directions);
  parameters.set("occluderTriangles", static_cast<long long>(occluders.mesh.triangles.size()));
  parameters.set("occluderSpheres", static_cast<long long>(occluders.spheres.size()));
  parameters.set("refinedParticles", static_cast<long long>(this->Refined));
  return parameters;
}

po::SphereCloud vtkSphereAmbientOcclusion::Internals::ReadParticles(
  vtkSphereAmbientOcclusion* self, const std::vector<vtkPolyData*>& blocks)
{
  std::string error;
  std::optional<po::SphereCloud> cloud = po::readBlocks(blocks, ReadRadius(self), error);
  if (!cloud)
  {
    throw std::invalid_argument(error);
  }
  if (cloud->rejected.total() > 0)
  {
    vtkWarningWithObjectMacro(self, << po::describe(cloud->rejected));
  }
  return std::move(*cloud);
}

po::Occluders vtkSphereAmbientOcclusion::Internals::ReadOccluders(
  vtkSphereAmbientOcclusion* self, vtkDataObject* data, const po::SphereCloud& cloud)
{
  po::OccluderInput input = po::readOccluders(data, ReadRadius(self), cloud);
  for (const std::string& warning : input.warnings)
  {
    vtkWarningWithObjectMacro(self, << warning);
  }
  return std::move(input.occluders);
}

void vtkSphereAmbientOcclusion::Internals::Bake(vtkSphereAmbientOcclusion* self,
  const std::vector<vtkPolyData*>& blocks, vtkDataObject* occluderData)
{
  po::BakeSettings settings = ReadSettings(self);
  const po::SphereCloud cloud = ReadParticles(self, blocks);
  this->LeftOut = cloud.rejected.total();
  const po::Occluders occluders = ReadOccluders(self, occluderData, cloud);
  this->Method = chooseMethod(self->Method, cloud, occluders, settings, SweepOptions(self));
  const po::BakeResult result = this->BakeByMethod(self, cloud, occluders, settings);
  if (result.aborted)
  {
    return;
  }
  this->SamplesUsed = settings.samplesPerTexel;
  this->Counters = result.counters;
  this->TextureBytes = result.table.bytes.size() + result.table.floats.size() * sizeof(float);
  if (self->TargetError > 0 && this->EstimatedError > self->TargetError)
  {
    vtkWarningWithObjectMacro(self, << "TargetError " << self->TargetError
                                    << " is out of reach: the most that this method can do leaves "
                                    << this->EstimatedError << ".");
  }
  po::attachBake(blocks, cloud, result, this->Describe(self, settings, result.table, occluders));
}

po::BakeResult vtkSphereAmbientOcclusion::Internals::BakeByMethod(vtkSphereAmbientOcclusion* self,
  const po::SphereCloud& cloud, const po::Occluders& occluders, po::BakeSettings& settings)
{
  switch (this->Method)
  {
    case Sweep:
      return this->BakeBySweep(self, cloud, occluders, settings);
    case Embree:
      return this->BakeByEmbree(self, cloud, occluders, settings);
    default:
      return this->BakeByReference(self, cloud, occluders, settings);
  }
}

po::BakeResult vtkSphereAmbientOcclusion::Internals::BakeBySweep(vtkSphereAmbientOcclusion* self,
  const po::SphereCloud& cloud, const po::Occluders& occluders, const po::BakeSettings& settings)
{
  const po::SweepEstimator sweep(Internals::SweepOptions(self));
  requireMemory(sceneMemory(cloud, occluders, settings, sweep), cloud.spheres.size());
  po::Progress progress(reportTo(self));
  po::BakeResult result =
    po::bakeOcclusion(po::BakeScene(cloud, occluders), settings, sweep, progress);
  this->Directions = sweep.report().directions;
  this->Refined = sweep.report().refined;
  this->EstimatedError = sweep.report().estimatedError;
  return result;
}

po::BakeResult vtkSphereAmbientOcclusion::Internals::BakeByEmbree(vtkSphereAmbientOcclusion* self,
  const po::SphereCloud& cloud, const po::Occluders& occluders, const po::BakeSettings& settings)
{
  po::EmbreeOptions options;
  options.targetError = self->TargetError;
  const po::EmbreeEstimator embree(options);
  requireMemory(sceneMemory(cloud, occluders, settings, embree), cloud.spheres.size());
  po::Progress progress(reportTo(self));
  po::BakeResult result =
    po::bakeOcclusion(po::BakeScene(cloud, occluders), settings, embree, progress);
  this->Directions = embree.report().directions;
  this->EstimatedError = embree.report().estimatedError;
  return result;
}

po::BakeResult vtkSphereAmbientOcclusion::Internals::BakeByReference(
  vtkSphereAmbientOcclusion* self, const po::SphereCloud& cloud, const po::Occluders& occluders,
  po::BakeSettings& settings)
{
  const po::ReferenceEstimator reference;
  requireMemory(sceneMemory(cloud, occluders, settings, reference), cloud.spheres.size());
  const po::BakeScene scene(cloud, occluders);
  po::Progress progress(reportTo(self));
  if (self->TargetError > 0)
  {
    const po::PilotResult pilot =
      po::samplesForError(scene, settings, reference, self->TargetError, progress);
    settings.samplesPerTexel = pilot.samplesPerTexel;
    this->EstimatedError = pilot.estimatedError;
  }
  return po::bakeOcclusion(scene, settings, reference, progress);
}

vtkSphereAmbientOcclusion::vtkSphereAmbientOcclusion()
  : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
}

vtkSphereAmbientOcclusion::~vtkSphereAmbientOcclusion()
{
  this->SetRadiusArray(nullptr);
  this->SetBackgroundImage(nullptr);
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
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkSphereAmbientOcclusion::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto start = std::chrono::steady_clock::now();
  *this->Impl = Internals();
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  output->ShallowCopy(input); // of a composite data set the leaves too

  vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
  if (processes && processes->GetNumberOfProcesses() > 1 && processes->GetLocalProcessId() == 0)
  {
    vtkWarningMacro("Every process bakes its own particles as if there were no others: expect too "
                    "bright values where processes meet.");
  }

  std::string error;
  try
  {
    this->Impl->Bake(
      this, po::particleBlocks(output), vtkDataObject::GetData(inputVector[OccludersPort]));
  }
  catch (const std::bad_alloc&)
  {
    error = "Memory ran out while baking: lower TextureResolution or bake fewer particles.";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  if (!error.empty())
  {
    output->Initialize();
    vtkErrorMacro(<< error);
    return 0;
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  this->Impl->Seconds = elapsed.count();
  return 1;
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticles()
{
  return static_cast<vtkIdType>(this->Impl->Counters.particles);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTexels()
{
  return static_cast<vtkIdType>(this->Impl->Counters.texels);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfRays()
{
  return static_cast<vtkIdType>(this->Impl->Counters.rays);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfSamplesInside()
{
  return static_cast<vtkIdType>(this->Impl->Counters.samplesInside);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTexelsInside()
{
  return static_cast<vtkIdType>(this->Impl->Counters.texelsInside);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesBuried()
{
  return static_cast<vtkIdType>(this->Impl->Counters.particlesBuried);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesDark()
{
  return static_cast<vtkIdType>(this->Impl->Counters.particlesDark);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesLeftOut()
{
  return static_cast<vtkIdType>(this->Impl->LeftOut);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTextures()
{
  return static_cast<vtkIdType>(this->Impl->Counters.texturesStored);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfTextureBytes()
{
  return static_cast<vtkIdType>(this->Impl->TextureBytes);
}

int vtkSphereAmbientOcclusion::GetNumberOfThreads()
{
  return static_cast<int>(this->Impl->Counters.threads);
}

const char* vtkSphereAmbientOcclusion::GetMethodUsed()
{
  return MethodNames[this->Impl->Method];
}

int vtkSphereAmbientOcclusion::GetNumberOfDirections()
{
  return this->Impl->Directions;
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesRefined()
{
  return static_cast<vtkIdType>(this->Impl->Refined);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfVisitsClosed()
{
  return static_cast<vtkIdType>(this->Impl->Counters.spheresClosed);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfVisitsNeverSeen()
{
  return static_cast<vtkIdType>(this->Impl->Counters.spheresNeverSeen);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfDirectionsBlack()
{
  return static_cast<vtkIdType>(this->Impl->Counters.directionsBlack);
}

vtkIdType vtkSphereAmbientOcclusion::GetNumberOfParticlesAlone()
{
  return static_cast<vtkIdType>(this->Impl->Counters.particlesAlone);
}

int vtkSphereAmbientOcclusion::GetNumberOfSamplesUsed()
{
  return this->Impl->SamplesUsed;
}

double vtkSphereAmbientOcclusion::GetEstimatedError()
{
  return this->Impl->EstimatedError;
}

double vtkSphereAmbientOcclusion::GetBakeSeconds()
{
  return this->Impl->Seconds;
}

void vtkSphereAmbientOcclusion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArray: " << (this->RadiusArray ? this->RadiusArray : "(automatic)") << "\n"
     << indent << "RadiusScale: " << this->RadiusScale << "\n"
     << indent << "ConstantRadius: " << this->ConstantRadius << "\n"
     << indent << "TextureResolution: " << this->TextureResolution << "\n"
     << indent << "SamplesPerTexel: " << this->SamplesPerTexel << "\n"
     << indent << "TargetError: " << this->TargetError << "\n"
     << indent << "Method: " << this->Method << "\n"
     << indent << "MaximumDistance: " << this->MaximumDistance << "\n"
     << indent << "Background: " << this->Background << "\n"
     << indent << "DilateInside: " << this->DilateInside << "\n"
     << indent << "InsideThreshold: " << this->InsideThreshold << "\n"
     << indent << "Encoding: " << this->Encoding << "\n"
     << indent << "Seed: " << this->Seed << "\n";
}
