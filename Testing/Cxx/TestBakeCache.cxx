// SPDX-License-Identifier: BSD-3-Clause
/// Bakes that are kept on disk: what is loaded is what was baked, and nothing else.

#include "BakeFilterTestSupport.h"
#include "ExrTestSupport.h"
#include "Random.h"

#include "vtkDataArray.h"
#include "vtkSphereAmbientOcclusion.h"

#include <tbb/global_control.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <thread>

namespace fs = std::filesystem;

namespace
{
using Filter = vtkSphereAmbientOcclusion;
using Prepare = std::function<void(Filter*)>;

constexpr int Particles = 400;

/// Overlapping spheres; all of their textures differ.
vtkSmartPointer<vtkPolyData> cloud(int seed = 1, int count = Particles)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  po::Random random(static_cast<std::uint64_t>(seed), 0, 0);
  for (int i = 0; i < count; ++i)
  {
    points->InsertNextPoint(10 * random.uniform(), 10 * random.uniform(), 10 * random.uniform());
    radii->InsertNextValue(0.2 + 0.5 * random.uniform());
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

/// A bake with the cache in a folder, and its warnings.
struct CachedBake
{
  vtkSmartPointer<Filter> filter = vtkSmartPointer<Filter>::New();
  std::vector<std::string> warnings;

  CachedBake(const std::string& folder, vtkPolyData* data, const Prepare& prepare = {})
  {
    Messages messages(filter);
    filter->SetController(nullptr);
    filter->SetTextureResolution(4);
    filter->SetSamplesPerTexel(4);
    filter->UseCacheOn();
    filter->SetCacheDirectory(folder.c_str());
    if (prepare)
    {
      prepare(filter);
    }
    filter->SetInputData(data);
    filter->Update();
    EXPECT_TRUE(messages.errors.empty());
    warnings = messages.warnings;
  }

  [[nodiscard]] bool loaded() const { return filter->GetLoadedFromCache(); }
  [[nodiscard]] vtkPolyData* data() const
  {
    return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  }
};

void expectSameBits(vtkAbstractArray* a, vtkAbstractArray* b)
{
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->GetDataType(), b->GetDataType());
  ASSERT_EQ(a->GetNumberOfComponents(), b->GetNumberOfComponents());
  ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
  EXPECT_EQ(std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
              static_cast<std::size_t>(a->GetNumberOfValues() * a->GetDataTypeSize())),
    0)
    << a->GetName();
}

void expectSameStrings(vtkPolyData* a, vtkPolyData* b)
{
  const auto strings = [](vtkPolyData* data)
  {
    return vtkStringArray::SafeDownCast(
      data->GetFieldData()->GetAbstractArray("AmbientOcclusionParameters"));
  };
  ASSERT_EQ(strings(a)->GetNumberOfValues(), strings(b)->GetNumberOfValues());
  for (vtkIdType i = 0; i < strings(a)->GetNumberOfValues(); ++i)
  {
    EXPECT_EQ(strings(a)->GetValue(i), strings(b)->GetValue(i));
  }
}

void expectSameOutput(vtkPolyData* a, vtkPolyData* b)
{
  for (const char* name : { "AmbientOcclusion", "AmbientOcclusionTexture" })
  {
    expectSameBits(a->GetPointData()->GetArray(name), b->GetPointData()->GetArray(name));
  }
  const char* table = "AmbientOcclusionTextures";
  expectSameBits(a->GetFieldData()->GetArray(table), b->GetFieldData()->GetArray(table));
  expectSameStrings(a, b);
}

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

std::string onlyFileIn(const std::string& folder)
{
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    files.push_back(entry.path().string());
  }
  EXPECT_EQ(files.size(), 1u);
  return files.empty() ? "" : files.front();
}

std::size_t filesIn(const std::string& folder)
{
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
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

TEST(BakeCache, WhateverChangesTheResultIsBakedAnew)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  ASSERT_FALSE(CachedBake(cache, cloud()).loaded());
  const std::map<std::string, Prepare> changes = {
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

TEST(BakeCache, DamagedEntriesAreNoticedAndReplaced)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  const auto data = cloud();
  const CachedBake first(cache, data);
  const std::string entry = onlyFileIn(cache);
  const Bytes whole = readBytes(entry);
  forEachDamage(whole, 40,
    [&](const Bytes& damaged)
    {
      writeBytes(entry, damaged);
      const CachedBake bake(cache, data);
      EXPECT_EQ(bake.loaded(), damaged == whole);
      if (damaged != whole)
      {
        EXPECT_TRUE(oneMessage(bake.warnings, "will be replaced"));
      }
      EXPECT_EQ(onlyFileIn(cache), entry);
      EXPECT_TRUE(CachedBake(cache, data).loaded());
      expectSameOutput(first.data(), bake.data());
    });
}

TEST(BakeCache, AnEntryOfOtherDataIsNotUsed)
{
  TemporaryFolder folder;
  const CachedBake first(folder.file("a"), cloud(1));
  const CachedBake other(folder.file("b"), cloud(2));
  writeBytes(onlyFileIn(folder.file("a")), readBytes(onlyFileIn(folder.file("b"))));
  const CachedBake again(folder.file("a"), cloud(1));
  EXPECT_FALSE(again.loaded());
  EXPECT_TRUE(oneMessage(again.warnings, "other particles"));
  expectSameOutput(first.data(), again.data());
}

TEST(BakeCache, AFolderThatCannotBeMadeIsOneWarning)
{
  TemporaryFolder folder;
  writeBytes(folder.file("file"), { 'x' });
  const CachedBake bake(folder.file("file") + "/cache", cloud());
  EXPECT_TRUE(oneMessage(bake.warnings, "CacheDirectory"));
  EXPECT_EQ(bake.filter->GetNumberOfParticles(), Particles);
  EXPECT_FALSE(bake.loaded());
  EXPECT_EQ(folder.count(), 1u);
}

#ifndef _WIN32
TEST(BakeCache, AFullDiskIsOneWarningAndLeavesNoFile)
{
  TemporaryFolder folder;
  const CachedBake full = [&]
  {
    const FileSizeLimit limit(2000);
    return CachedBake(folder.file("cache"), cloud());
  }();
  EXPECT_TRUE(oneMessage(full.warnings, "not kept"));
  EXPECT_EQ(filesIn(folder.file("cache")), 0u);
  EXPECT_EQ(full.filter->GetNumberOfParticles(), Particles);
}

TEST(BakeCache, WithoutAFolderItIsInTheUsersCacheDirectory)
{
  TemporaryFolder folder;
  const char* before = std::getenv("XDG_CACHE_HOME");
  const std::string kept = before ? before : "";
  setenv("XDG_CACHE_HOME", folder.file("xdg").c_str(), 1);
  const CachedBake bake("", cloud());
  before ? setenv("XDG_CACHE_HOME", kept.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
  EXPECT_TRUE(bake.warnings.empty());
  EXPECT_EQ(filesIn(folder.file("xdg/ParticleOcclusion")), 1u);
}
#endif

namespace
{
/// About 0.4 MiB each.
CachedBake largeBake(const std::string& folder, int seed, int limit)
{
  return CachedBake(folder, cloud(seed),
    [=](Filter* f)
    {
      f->SetTextureResolution(32);
      f->SetSamplesPerTexel(1);
      f->SetCacheSizeLimit(limit);
    });
}
}

TEST(BakeCache, WhatWasUsedLeastRecentlyIsRemovedBeyondTheLimit)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  const auto bake = [&](int seed, int limit) { return largeBake(cache, seed, limit).loaded(); };
  EXPECT_FALSE(bake(1, 1));
  EXPECT_FALSE(bake(2, 1));
  for (const auto& entry : fs::directory_iterator(cache))
  {
    fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  EXPECT_TRUE(bake(1, 1));  // used: 2 is now the oldest
  EXPECT_FALSE(bake(3, 1)); // too much
  EXPECT_EQ(filesIn(cache), 2u);
  EXPECT_TRUE(bake(1, 1));
  EXPECT_TRUE(bake(3, 1));
  EXPECT_FALSE(bake(2, 0)); // no limit
  EXPECT_FALSE(bake(4, 0));
  EXPECT_EQ(filesIn(cache), 4u);
}

TEST(BakeCache, AnEntryBeyondTheLimitIsAWarning)
{
  TemporaryFolder folder;
  const CachedBake bake(folder.file("cache"), cloud(),
    [](Filter* f)
    {
      f->SetTextureResolution(64);
      f->SetSamplesPerTexel(1);
      f->SetCacheSizeLimit(1);
    });
  EXPECT_TRUE(oneMessage(bake.warnings, "2 MiB are more than CacheSizeLimit"));
  EXPECT_EQ(folder.count(), 0u);
}

TEST(BakeCache, WhatACrashLeftBehindIsRemovedInTheEnd)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  fs::create_directory(cache);
  const std::string young = cache + "/0.pobake.partial-1", old = cache + "/0.pobake.partial-2";
  const std::string foreign = cache + "/notes.txt";
  for (const std::string& file : { young, old, foreign })
  {
    writeBytes(file, { 'x' });
    fs::last_write_time(
      file, fs::file_time_type::clock::now() - std::chrono::hours(file == young ? 1 : 48));
  }
  ASSERT_FALSE(CachedBake(cache, cloud()).loaded());
  EXPECT_TRUE(fs::exists(young));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(foreign));
}

TEST(BakeCache, ManyMayUseAFolderAtTheSameTime)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  std::vector<vtkSmartPointer<vtkPolyData>> expected;
  for (int seed = 0; seed < 4; ++seed)
  {
    expected.push_back(largeBake(folder.file("other"), seed, 0).data());
  }
  std::vector<std::thread> users;
  for (int user = 0; user < 3; ++user)
  {
    users.emplace_back(
      [&, user]
      {
        for (int i = 0; i < 8; ++i)
        {
          const int seed = (user + i) % 4;
          const CachedBake bake = largeBake(cache, seed, 1); // so that entries come and go
          EXPECT_TRUE(bake.warnings.empty()) << bake.warnings.front();
          expectSameOutput(expected[static_cast<std::size_t>(seed)], bake.data());
        }
      });
  }
  for (std::thread& user : users)
  {
    user.join();
  }
}
