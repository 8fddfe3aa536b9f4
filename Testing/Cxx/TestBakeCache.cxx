// SPDX-License-Identifier: BSD-3-Clause
/// Bakes that are kept on disk: what is loaded is what was baked, and nothing else.

#include "BakeCacheTestSupport.h"

#include <tbb/global_control.h>

#include <map>

using namespace bake_cache;

namespace
{
/// All that a filter says of its execution but for its duration.
std::map<std::string, double> numbersOf(Filter* f)
{
  const auto number = [](auto value) { return static_cast<double>(value); };
  return { { "particles", number(f->GetNumberOfParticles()) },
    { "texels", number(f->GetNumberOfTexels()) }, { "rays", number(f->GetNumberOfRays()) },
    { "samples inside", number(f->GetNumberOfSamplesInside()) },
    { "texels inside", number(f->GetNumberOfTexelsInside()) },
    { "buried", number(f->GetNumberOfParticlesBuried()) },
    { "dark", number(f->GetNumberOfParticlesDark()) },
    { "left out", number(f->GetNumberOfParticlesLeftOut()) },
    { "textures", number(f->GetNumberOfTextures()) },
    { "bytes", number(f->GetNumberOfTextureBytes()) },
    { "refined", number(f->GetNumberOfParticlesRefined()) },
    { "reused", number(f->GetNumberOfParticlesReused()) },
    { "closed", number(f->GetNumberOfVisitsClosed()) },
    { "never seen", number(f->GetNumberOfVisitsNeverSeen()) },
    { "black", number(f->GetNumberOfDirectionsBlack()) },
    { "alone", number(f->GetNumberOfParticlesAlone()) },
    { "directions", number(f->GetNumberOfDirections()) },
    { "threads", number(f->GetNumberOfThreads()) },
    { "samples", number(f->GetNumberOfSamplesUsed()) }, { "error", f->GetEstimatedError() },
    { "method " + std::string(f->GetMethodUsed()), 1 } };
}

void expectSecondIsLoaded(vtkPolyData* data, const Prepare& prepare)
{
  TemporaryFolder folder;
  const CachedBake first(folder.file("cache"), data, prepare);
  EXPECT_FALSE(first.loaded());
  EXPECT_GT(first.filter->GetNumberOfTextures(), Particles / 2);
  const CachedBake second(folder.file("cache"), data, prepare);
  EXPECT_TRUE(second.loaded());
  EXPECT_TRUE(first.warnings.empty() && second.warnings.empty());
  expectSameOutput(first.data(), second.data());
  EXPECT_EQ(numbersOf(first.filter), numbersOf(second.filter));
}
}

TEST(BakeCache, IsOffByDefault)
{
  TemporaryFolder folder;
  const CachedBake bake(folder.file("cache"), cloud(), [](Filter* f) { f->UseCacheOff(); });
  EXPECT_FALSE(bake.loaded());
  EXPECT_EQ(folder.count(), 0u);
}

TEST(BakeCache, ASecondBakeIsLoadedBitByBit)
{
  for (const int method : { Filter::Sweep, Filter::Embree, Filter::Reference })
  {
    for (const int encoding : { Filter::UInt8Gamma2, Filter::Float32Linear })
    {
      SCOPED_TRACE(method);
      expectSecondIsLoaded(cloud(),
        [&](Filter* f)
        {
          f->SetMethod(method);
          f->SetEncoding(encoding);
        });
    }
  }
}

TEST(BakeCache, WhatTargetErrorAndBackgroundFoundIsLoadedToo)
{
  expectSecondIsLoaded(cloud(),
    [](Filter* f)
    {
      f->SetTargetError(0.05);
      f->SetBackground(Filter::Gradient);
    });
  expectSecondIsLoaded(cloud(),
    [](Filter* f)
    {
      f->SetMethod(Filter::Reference);
      f->SetTargetError(0.2);
      f->SetMaximumDistance(2);
    });
}

TEST(BakeCache, OrderOfParticlesAndThreadsDoNotMatter)
{
  TemporaryFolder folder;
  const auto data = cloud();
  const CachedBake first(folder.file("cache"), data);
  auto reversed = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  for (vtkIdType i = Particles - 1; i >= 0; --i)
  {
    points->InsertNextPoint(data->GetPoint(i));
    radii->InsertNextValue(radiiOf(data)->GetValue(i));
  }
  reversed->SetPoints(points);
  reversed->GetPointData()->AddArray(radii);
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const CachedBake second(folder.file("cache"), reversed);
  EXPECT_TRUE(second.loaded());
  for (vtkIdType i = 0; i < Particles; ++i)
  {
    EXPECT_EQ(first.data()->GetPointData()->GetArray("AmbientOcclusion")->GetComponent(i, 0),
      second.data()
        ->GetPointData()
        ->GetArray("AmbientOcclusion")
        ->GetComponent(Particles - 1 - i, 0));
  }
}

namespace
{
/// Of what is baked and how exactly, and of how it is stored.
std::map<std::string, Prepare> changesOfTheBake()
{
  return {
    { "RadiusScale", [](Filter* f) { f->SetRadiusScale(1.01); } },
    { "RadiusArray",
      [](Filter* f)
      {
        f->SetRadiusArray("(none)");
        f->SetConstantRadius(0.4);
      } },
    { "TextureResolution", [](Filter* f) { f->SetTextureResolution(5); } },
    { "SamplesPerTexel", [](Filter* f) { f->SetSamplesPerTexel(5); } },
    { "TargetError", [](Filter* f) { f->SetTargetError(0.1); } },
    { "Method", [](Filter* f) { f->SetMethod(Filter::Embree); } },
    { "MaximumDistance", [](Filter* f) { f->SetMaximumDistance(3); } },
    { "DilateInside", [](Filter* f) { f->DilateInsideOff(); } },
    { "InsideThreshold", [](Filter* f) { f->SetInsideThreshold(0.1); } },
    { "Encoding", [](Filter* f) { f->SetEncoding(Filter::Float32Linear); } },
    { "Storage", [](Filter* f) { f->SetStorage(Filter::VariableSize); } },
    { "StorageError",
      [](Filter* f)
      {
        f->SetStorage(Filter::VariableSize);
        f->SetStorageError(0.02);
      } },
    { "Seed", [](Filter* f) { f->SetSeed(2); } },
    { "Occluders", [](Filter* f) { f->SetInputData(Filter::OccludersPort, cloud(7, 3)); } },
  };
}

/// Of what shines, and of the part that is baked.
std::map<std::string, Prepare> changesOfTheLight()
{
  return {
    { "Background", [](Filter* f) { f->SetBackground(Filter::Gradient); } },
    { "BackgroundUp",
      [](Filter* f)
      {
        f->SetBackground(Filter::Gradient);
        f->SetBackgroundUp(1, 0, 0);
      } },
    { "CropPlane",
      [](Filter* f)
      {
        f->CropPlaneOn();
        f->SetCropPlaneOrigin(0, 0, 5);
      } },
    { "BakeLight", [](Filter* f) { f->BakeLightOn(); } },
    { "LightDirection",
      [](Filter* f)
      {
        f->BakeLightOn();
        f->SetLightDirection(0, 0, -1);
      } },
    { "LightIntensity",
      [](Filter* f)
      {
        f->BakeLightOn();
        f->SetLightIntensity(2);
      } },
  };
}
}

TEST(BakeCache, WhateverChangesTheResultIsBakedAnew)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  ASSERT_FALSE(CachedBake(cache, cloud()).loaded());
  std::map<std::string, Prepare> changes = changesOfTheBake();
  changes.merge(changesOfTheLight());
  for (const auto& [name, change] : changes)
  {
    EXPECT_FALSE(CachedBake(cache, cloud(), change).loaded()) << name;
    EXPECT_TRUE(CachedBake(cache, cloud(), change).loaded()) << name;
  }
  auto moved = cloud();
  double p[3];
  moved->GetPoint(17, p);
  moved->GetPoints()->SetPoint(17, p[0], p[1] + 1e-5, p[2]);
  EXPECT_FALSE(CachedBake(cache, moved).loaded());
  auto larger = cloud();
  radiiOf(larger)->SetValue(17, radiiOf(larger)->GetValue(17) * 1.00001);
  EXPECT_FALSE(CachedBake(cache, larger).loaded());
  EXPECT_FALSE(CachedBake(cache, cloud(1, Particles - 1)).loaded());
  EXPECT_TRUE(CachedBake(cache, cloud()).loaded());
}
