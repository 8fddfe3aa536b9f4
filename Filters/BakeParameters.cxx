// SPDX-License-Identifier: BSD-3-Clause
#include "BakeParameters.h"

#include "ExrBackground.h"
#include "vtkSphereAmbientOcclusion.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace po
{
namespace
{
/// Version of the layout that AmbientOcclusionParameters describes.
constexpr int ContractVersion = 1;

constexpr const char* MethodNames[] = { "Automatic", "Sweep", "Embree", "Reference" };
constexpr const char* BackgroundNames[] = { "Uniform", "Gradient", "Image" };
constexpr const char* EncodingNames[] = { UInt8Gamma2, Float32Linear };
constexpr const char* StorageNames[] = { FullStorage, VariableSizeStorage, CompressedStorage,
  OneValueStorage };

std::string textOf(const char* text)
{
  return text ? text : "";
}

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

Vec3d directionOf(const char* name, const double* value)
{
  const Vec3d direction{ value[0], value[1], value[2] };
  if (!(length(direction) > 0) || !std::isfinite(length(direction)))
  {
    throw std::invalid_argument(std::string(name) + " must be a direction, not the zero vector.");
  }
  return direction;
}

GradientBackground gradientOf(vtkSphereAmbientOcclusion& filter)
{
  const GradientBackground gradient{ directionOf("BackgroundUp", filter.GetBackgroundUp()),
    filter.GetBackgroundBottom(), filter.GetBackgroundTop() };
  requireNotNegative("BackgroundBottom", gradient.bottom);
  requireNotNegative("BackgroundTop", gradient.top);
  return gradient;
}

ImageBackground imageOf(vtkSphereAmbientOcclusion& filter)
{
  const std::string file = textOf(filter.GetBackgroundImage());
  if (file.empty())
  {
    throw std::invalid_argument("BackgroundImage is empty: choose an OpenEXR file in latitude and "
                                "longitude, or another Background.");
  }
  LatLongImage image = readLatLongImage(file);
  return { image.width, image.height, std::move(image.luminance) };
}

Background backgroundOf(vtkSphereAmbientOcclusion& filter)
{
  const int type = filter.GetBackground();
  requireRange<int>(
    "Background", type, vtkSphereAmbientOcclusion::Uniform, vtkSphereAmbientOcclusion::Image);
  if (type == vtkSphereAmbientOcclusion::Gradient)
  {
    return gradientOf(filter);
  }
  if (type == vtkSphereAmbientOcclusion::Image)
  {
    return imageOf(filter);
  }
  return UniformBackground{};
}

std::optional<DistantLight> lightOf(vtkSphereAmbientOcclusion& filter)
{
  if (!filter.GetBakeLight())
  {
    return {};
  }
  requireNotNegative("LightIntensity", filter.GetLightIntensity());
  return DistantLight{ directionOf("LightDirection", filter.GetLightDirection()),
    filter.GetLightIntensity() };
}

std::string textOf(const double* v)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << v[0] << ' ' << v[1] << ' ' << v[2];
  return text.str();
}

void describeBackground(vtkSphereAmbientOcclusion& filter, OcclusionParameters& parameters)
{
  parameters.set("background", BackgroundNames[filter.GetBackground()]);
  if (filter.GetBackground() == vtkSphereAmbientOcclusion::Gradient)
  {
    parameters.set("backgroundUp", textOf(filter.GetBackgroundUp()));
    parameters.set("backgroundBottom", filter.GetBackgroundBottom());
    parameters.set("backgroundTop", filter.GetBackgroundTop());
  }
  if (filter.GetBackground() == vtkSphereAmbientOcclusion::Image)
  {
    parameters.set("backgroundImage", textOf(filter.GetBackgroundImage()));
  }
}

/// Only what is in use.
void describeCrop(vtkSphereAmbientOcclusion& filter, OcclusionParameters& parameters)
{
  const CropSettings crop = cropOf(filter);
  if (!crop.range.array.empty())
  {
    parameters.set("cropArray", crop.range.array);
    parameters.set("cropComponent", crop.range.component);
    parameters.set("cropLow", crop.range.low);
    parameters.set("cropHigh", crop.range.high);
  }
  if (crop.plane)
  {
    parameters.set("cropPlaneOrigin", textOf(filter.GetCropPlaneOrigin()));
    parameters.set("cropPlaneNormal", textOf(filter.GetCropPlaneNormal()));
  }
  if (crop.box)
  {
    parameters.set("cropBoxOrigin", textOf(filter.GetCropBoxOrigin()));
    parameters.set("cropBoxSize", textOf(filter.GetCropBoxSize()));
  }
}

/// Only of a bake that has one: others are described as they were before there were lights.
void describeLight(vtkSphereAmbientOcclusion& filter, OcclusionParameters& parameters)
{
  if (filter.GetBakeLight())
  {
    parameters.set(BakedLightParameter, true);
    parameters.set("lightDirection", textOf(filter.GetLightDirection()));
    parameters.set("lightIntensity", filter.GetLightIntensity());
  }
}

Storage storageOf(vtkSphereAmbientOcclusion& filter)
{
  using Filter = vtkSphereAmbientOcclusion;
  requireRange<int>("Storage", filter.GetStorage(), Filter::Full, Filter::OneValue);
  requireRange("StorageError", filter.GetStorageError(), 0.0, 1.0);
  const bool packed =
    filter.GetStorage() == Filter::VariableSize || filter.GetStorage() == Filter::Compressed;
  if (packed && filter.GetEncoding() == Filter::Float32Linear)
  {
    throw std::invalid_argument(std::string("The Storage ") + StorageNames[filter.GetStorage()] +
      " needs the Encoding UInt8Gamma2; choose that, or the Storage Full.");
  }
  return static_cast<Storage>(filter.GetStorage());
}
}

BakeSettings settingsOf(vtkSphereAmbientOcclusion& filter)
{
  using Filter = vtkSphereAmbientOcclusion;
  requireRange(
    "TextureResolution", filter.GetTextureResolution(), 1, BakeSettings::MaximumTextureResolution);
  requireRange(
    "SamplesPerTexel", filter.GetSamplesPerTexel(), 1, BakeSettings::MaximumSamplesPerTexel);
  requireRange("TargetError", filter.GetTargetError(), 0.0, 1.0);
  requireRange("InsideThreshold", filter.GetInsideThreshold(), 0.0, 1.0);
  requireRange<int>("Encoding", filter.GetEncoding(), Filter::UInt8Gamma2, Filter::Float32Linear);
  requireRange("Seed", filter.GetSeed(), 0, VTK_INT_MAX);
  requireNotNegative("MaximumDistance", filter.GetMaximumDistance(), " (0 = unbounded)");
  requireRange<int>("Method", filter.GetMethod(), Filter::Automatic, Filter::Reference);
  BakeSettings settings;
  settings.textureResolution = filter.GetTextureResolution();
  settings.samplesPerTexel = filter.GetSamplesPerTexel();
  settings.maximumDistance = filter.GetMaximumDistance();
  settings.dilateInside = filter.GetDilateInside();
  settings.insideThreshold = filter.GetInsideThreshold();
  settings.encoding = static_cast<Encoding>(filter.GetEncoding());
  settings.storage = storageOf(filter);
  settings.storageError = filter.GetStorageError();
  settings.seed = static_cast<std::uint64_t>(filter.GetSeed());
  settings.background = backgroundOf(filter);
  settings.light = lightOf(filter);
  return settings;
}

RadiusSettings radiiOf(vtkSphereAmbientOcclusion& filter)
{
  return { textOf(filter.GetRadiusArray()), filter.GetRadiusScale(), filter.GetConstantRadius(),
    static_cast<RadiusSource>(filter.GetRadiusFrom()), filter.GetDensity() };
}

CropSettings cropOf(vtkSphereAmbientOcclusion& filter)
{
  const auto vector = [](const double* v) { return Vec3d{ v[0], v[1], v[2] }; };
  const std::string array = textOf(filter.GetCropArray());
  CropSettings crop;
  crop.range = { array == RadiusSettings::NoArray ? "" : array, filter.GetCropComponent(),
    filter.GetCropRange()[0], filter.GetCropRange()[1] };
  crop.plane = filter.GetCropPlane();
  crop.planeOrigin = vector(filter.GetCropPlaneOrigin());
  crop.planeNormal = crop.plane ? directionOf("CropPlaneNormal", filter.GetCropPlaneNormal())
                                : vector(filter.GetCropPlaneNormal());
  crop.box = filter.GetCropBox();
  crop.boxOrigin = vector(filter.GetCropBoxOrigin());
  crop.boxSize = vector(filter.GetCropBoxSize());
  return crop;
}

std::string idArrayOf(vtkSphereAmbientOcclusion& filter)
{
  return textOf(filter.GetIdArray());
}

bool reusesTextures(vtkSphereAmbientOcclusion& filter)
{
  return filter.GetReuseUnchanged() &&
    mayReuse(filter.GetMethod(), filter.GetMaximumDistance(), filter.GetTargetError());
}

CacheSettings cacheOf(vtkSphereAmbientOcclusion& filter)
{
  return { filter.GetUseCache(), textOf(filter.GetCacheDirectory()), filter.GetCacheSizeLimit() };
}

const char* nameOfMethod(int method)
{
  return MethodNames[method];
}

OcclusionParameters describeBake(
  vtkSphereAmbientOcclusion& filter, const BakeSettings& settings, const BakeReport& report)
{
  OcclusionParameters parameters;
  parameters.set("version", ContractVersion);
  parameters.set("method", nameOfMethod(report.method));
  const bool oneValue = settings.storage == Storage::OneValue;
  parameters.set("resolution", oneValue ? 1 : settings.textureResolution);
  parameters.set("samplesPerTexel", report.samplesUsed);
  parameters.set("seed", filter.GetSeed());
  parameters.set("encoding", EncodingNames[filter.GetEncoding()]);
  parameters.set("gamma", settings.encoding == Encoding::UInt8Gamma2 ? 2.0 : 1.0);
  parameters.set("maximum", report.maximum);
  parameters.set("storage", StorageNames[filter.GetStorage()]);
  parameters.set("storageError", settings.storageError);
  parameters.set("storageDifference", report.storageDifference);
  parameters.set("bakedResolution", settings.textureResolution);
  parameters.set("insideThreshold", settings.insideThreshold);
  parameters.set("dilateInside", settings.dilateInside);
  parameters.set("maximumDistance", settings.maximumDistance);
  parameters.set("radiusArray", textOf(filter.GetRadiusArray()));
  parameters.set("radiusScale", filter.GetRadiusScale());
  parameters.set("constantRadius", filter.GetConstantRadius());
  parameters.set("idArray", textOf(filter.GetIdArray()));
  parameters.set("radiusFrom", filter.GetRadiusFrom());
  parameters.set("density", filter.GetDensity());
  describeBackground(filter, parameters);
  describeLight(filter, parameters);
  describeCrop(filter, parameters);
  parameters.set("targetError", filter.GetTargetError());
  parameters.set("estimatedError", report.estimatedError);
  parameters.set("directions", report.directions);
  parameters.set("occluderTriangles", static_cast<long long>(report.occluderTriangles));
  parameters.set("occluderSpheres", static_cast<long long>(report.occluderSpheres));
  parameters.set("refinedParticles", static_cast<long long>(report.refined));
  if (filter.GetReuseUnchanged())
  {
    parameters.set("reusedParticles", static_cast<long long>(report.reused));
  }
  return parameters;
}
}
