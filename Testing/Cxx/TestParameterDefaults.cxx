// SPDX-License-Identifier: BSD-3-Clause
/// One parameter, one name, one default: from the server-manager XML over the VTK setters to the
/// plain structs of the core.

#include "BakeSettings.h"
#include "CropSettings.h"
#include "ParameterTable.h"
#include "SilhouetteParametersOf.h"
#include "SphereInput.h"

#include "vtkDepthSilhouettes.h"
#include "vtkNew.h"
#include "vtkOcclusionTextureWriter.h"
#include "vtkSphereAmbientOcclusion.h"

#include <gtest/gtest.h>

#include <sstream>

namespace
{
ParameterValue vector(const double* v)
{
  return { v[0], v[1], v[2] };
}

TEST(ParameterDefaults, OfTheBakingFilterAgreeWithItsXml)
{
  vtkNew<vtkSphereAmbientOcclusion> f;
  const ParameterTable defaults{
    { "RadiusArray", { po::RadiusSettings::Automatic } }, // what no name asks for
    { "RadiusScale", { f->GetRadiusScale() } },
    { "ConstantRadius", { f->GetConstantRadius() } },
    { "RadiusFrom", { f->GetRadiusFrom() } },
    { "Density", { f->GetDensity() } },
    { "TextureResolution", { f->GetTextureResolution() } },
    { "SamplesPerTexel", { f->GetSamplesPerTexel() } },
    { "TargetError", { f->GetTargetError() } },
    { "Method", { f->GetMethod() } },
    { "MaximumDistance", { f->GetMaximumDistance() } },
    { "Background", { f->GetBackground() } },
    { "BackgroundUp", vector(f->GetBackgroundUp()) },
    { "BackgroundBottom", { f->GetBackgroundBottom() } },
    { "BackgroundTop", { f->GetBackgroundTop() } },
    { "BackgroundImage", { f->GetBackgroundImage() } },
    { "CropArray", { po::RadiusSettings::NoArray } }, // what no name asks for
    { "CropComponent", { f->GetCropComponent() } },
    { "CropRange", { f->GetCropRange()[0], f->GetCropRange()[1] } },
    { "CropPlane", { f->GetCropPlane() } },
    { "CropPlaneOrigin", vector(f->GetCropPlaneOrigin()) },
    { "CropPlaneNormal", vector(f->GetCropPlaneNormal()) },
    { "CropBox", { f->GetCropBox() } },
    { "CropBoxOrigin", vector(f->GetCropBoxOrigin()) },
    { "CropBoxSize", vector(f->GetCropBoxSize()) },
    { "BakeLight", { f->GetBakeLight() } },
    { "LightDirection", vector(f->GetLightDirection()) },
    { "LightIntensity", { f->GetLightIntensity() } },
    { "DilateInside", { f->GetDilateInside() } },
    { "InsideThreshold", { f->GetInsideThreshold() } },
    { "Encoding", { f->GetEncoding() } },
    { "Storage", { f->GetStorage() } },
    { "StorageError", { f->GetStorageError() } },
    { "Seed", { f->GetSeed() } },
    { "IdArray", { po::RadiusSettings::Automatic } },
    { "ReuseUnchanged", { f->GetReuseUnchanged() } },
    { "OutOfCore", { f->GetOutOfCore() } },
    { "UseCache", { f->GetUseCache() } },
    { "CacheDirectory", { f->GetCacheDirectory() } },
    { "CacheSizeLimit", { f->GetCacheSizeLimit() } },
  };
  expectDefaultsOfXml("Filters.xml", "SphereAmbientOcclusion", defaults);
}

TEST(ParameterDefaults, OfTheBakingFilterAgreeWithTheCore)
{
  vtkNew<vtkSphereAmbientOcclusion> f;
  EXPECT_EQ(f->GetRadiusArray(), nullptr);
  const po::RadiusSettings radii;
  EXPECT_EQ(f->GetRadiusScale(), radii.scale);
  EXPECT_EQ(f->GetConstantRadius(), radii.constant);
  EXPECT_EQ(f->GetRadiusFrom(), static_cast<int>(radii.from));
  EXPECT_EQ(f->GetDensity(), radii.density);
  const po::BakeSettings core;
  EXPECT_EQ(f->GetTextureResolution(), core.textureResolution);
  EXPECT_EQ(f->GetSamplesPerTexel(), core.samplesPerTexel);
  EXPECT_EQ(f->GetMaximumDistance(), core.maximumDistance);
  EXPECT_EQ(f->GetDilateInside(), core.dilateInside);
  EXPECT_EQ(f->GetInsideThreshold(), core.insideThreshold);
  EXPECT_EQ(f->GetEncoding(), static_cast<int>(core.encoding));
  EXPECT_EQ(f->GetStorage(), static_cast<int>(core.storage));
  EXPECT_EQ(f->GetStorageError(), core.storageError);
  EXPECT_EQ(static_cast<std::uint64_t>(f->GetSeed()), core.seed);
  EXPECT_EQ(f->GetBackground(), static_cast<int>(core.background.index()));
  const po::GradientBackground gradient;
  EXPECT_EQ(f->GetBackgroundBottom(), gradient.bottom);
  EXPECT_EQ(f->GetBackgroundTop(), gradient.top);
  EXPECT_EQ(f->GetBackgroundUp()[2], gradient.up.z);
  const po::CropSettings crop;
  EXPECT_EQ(f->GetCropArray(), nullptr);
  EXPECT_EQ(f->GetCropComponent(), crop.range.component);
  EXPECT_EQ(f->GetCropRange()[0], crop.range.low);
  EXPECT_EQ(f->GetCropRange()[1], crop.range.high);
  EXPECT_EQ(f->GetCropPlane(), crop.plane);
  EXPECT_EQ(f->GetCropPlaneNormal()[2], crop.planeNormal.z);
  EXPECT_EQ(f->GetCropBox(), crop.box);
  EXPECT_EQ(f->GetCropBoxSize()[0], crop.boxSize.x);
  EXPECT_EQ(f->GetBakeLight(), core.light.has_value());
  const po::DistantLight light;
  EXPECT_EQ(f->GetLightDirection()[0], light.direction.x);
  EXPECT_EQ(f->GetLightDirection()[1], light.direction.y);
  EXPECT_EQ(f->GetLightDirection()[2], light.direction.z);
  EXPECT_EQ(f->GetLightIntensity(), light.intensity);
}

TEST(ParameterDefaults, OfTheTextureWriterAgreeWithItsXml)
{
  vtkNew<vtkOcclusionTextureWriter> f;
  const ParameterTable defaults{
    { "FileName", { f->GetFileName() } },
    { "Precision", { f->GetPrecision() } },
  };
  expectDefaultsOfXml("OcclusionTextures.xml", "OcclusionTextureWriter", defaults);
}

TEST(ParameterDefaults, OfTheImageFilterAgreeWithItsXml)
{
  vtkNew<vtkDepthSilhouettes> f;
  const ParameterTable defaults{
    { "LineDensity", { f->GetLineDensity() } },
    { "Threshold", { f->GetThreshold() } },
    { "ThresholdUnit", { f->GetThresholdUnit() } },
    { "Samples", { f->GetSamples() } },
    { "LineWidth", { f->GetLineWidth() } },
    { "WidthByJump", { f->GetWidthByJump() } },
    { "MaximumLineWidth", { f->GetMaximumLineWidth() } },
    { "GreyByJump", { f->GetGreyByJump() } },
    { "JumpFrom", { f->GetJumpFrom() } },
    { "JumpTo", { f->GetJumpTo() } },
    { "SlopeTest", { f->GetSlopeTest() } },
    { "BackgroundLines", { f->GetBackgroundLines() } },
    { "BackgroundDepth", { f->GetBackgroundDepth() } },
    { "ParticleRadius", { f->GetParticleRadius() } },
  };
  expectDefaultsOfXml("DepthSilhouettes.xml", "DepthSilhouettes", defaults);
}

TEST(ParameterDefaults, OfTheImageFilterAgreeWithTheCore)
{
  vtkNew<vtkDepthSilhouettes> f;
  po::SilhouetteParameters core = po::silhouetteParametersOf(*f);
  EXPECT_EQ(core.samples, 1); // a depth image has one depth a pixel
  core.samples = po::SilhouetteParameters().samples;
  std::ostringstream ofFilter, ofCore;
  po::print(ofFilter, "", core);
  po::print(ofCore, "", po::SilhouetteParameters());
  EXPECT_EQ(ofFilter.str(), ofCore.str());
}
}
