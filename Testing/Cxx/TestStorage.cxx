// SPDX-License-Identifier: BSD-3-Clause
// The storages of the bake filter, and everything that reads what they leave.

#include "BakeFilterTestSupport.h"
#include "BakedTextures.h"
#include "ExrTestSupport.h"
#include "MergedParticles.h"
#include "OcclusionBaker.h"
#include "OcclusionParameters.h"
#include "ParallelBakeTestSupport.h"

#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkOcclusionTextureReader.h"
#include "vtkOcclusionTextureWriter.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using Filter = vtkSphereAmbientOcclusion;

constexpr int Particles = 300;

vtkSmartPointer<Filter> bakeWith(vtkDataObject* data, int storage, double error = 0.01)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputDataObject(data);
  filter->SetTextureResolution(8);
  filter->SetStorage(storage);
  filter->SetStorageError(error);
  filter->Update();
  return filter;
}

vtkPolyData* bakedBy(Filter* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPolyData> baked(int storage)
{
  return bakedBy(bakeWith(mixedCloud(Particles), storage));
}

/// The spheres, to tell what of them is inside of no other.
struct Spheres
{
  explicit Spheres(vtkPolyData* data)
  {
    vtkDataArray* array = data->GetPointData()->GetArray("radius");
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      double p[3];
      data->GetPoint(i, p);
      centers.push_back({ p[0], p[1], p[2] });
      radii.push_back(array->GetComponent(i, 0));
    }
  }

  [[nodiscard]] bool isVisible(std::size_t particle, const po::Vec3d& direction) const
  {
    const po::Vec3d point = centers[particle] + radii[particle] * direction;
    for (std::size_t i = 0; i < radii.size(); ++i)
    {
      const po::Vec3d away = point - centers[i];
      if (i != particle && dot(away, away) < radii[i] * radii[i])
      {
        return false;
      }
    }
    return true;
  }

  std::vector<po::Vec3d> centers;
  std::vector<double> radii;
};

/// RMS difference of what is looked up, over what is visible of all particles.
double lookupDifference(vtkPolyData* a, vtkPolyData* b)
{
  std::string fault;
  const po::BakedTextures first = po::readBakedTextures(*a, fault);
  EXPECT_EQ(fault, "");
  const po::BakedTextures second = po::readBakedTextures(*b, fault);
  EXPECT_EQ(fault, "");
  EXPECT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  const Spheres spheres(a);
  po::Random random(2, 0, 0);
  double sum = 0;
  int visible = 0;
  constexpr int Directions = 100;
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    for (int k = 0; k < Directions; ++k)
    {
      const double z = 2 * random.uniform() - 1, azimuth = 6.2831853 * random.uniform();
      const double r = std::sqrt(1 - z * z);
      const po::Vec3d direction{ r * std::cos(azimuth), r * std::sin(azimuth), z };
      const auto particle = static_cast<std::size_t>(i);
      if (spheres.isVisible(particle, direction))
      {
        const double d = static_cast<double>(first.textures.at(particle, direction.as<float>()) -
          second.textures.at(particle, direction.as<float>()));
        sum += d * d;
        ++visible;
      }
    }
  }
  return visible > 0 ? std::sqrt(sum / visible) : 0;
}

/// With the share of the noise that the bake is sure of.
double allowed(Filter* filter)
{
  const double e = filter->GetStorageError();
  return std::sqrt(e * e + 2 * e * po::SureShareOfError * filter->GetEstimatedError());
}
}

TEST(Storage, StaysWithinItsError)
{
  const auto full = bakeWith(mixedCloud(Particles), Filter::Full);
  EXPECT_EQ(full->GetStorageDifference(), 0);
  for (const int storage : { Filter::VariableSize, Filter::Compressed })
  {
    for (const double error : { 0.003, 0.01, 0.05 })
    {
      const auto filter = bakeWith(mixedCloud(Particles), storage, error);
      // A lookup between texels differs by no more than the texels, as an average.
      EXPECT_LE(lookupDifference(bakedBy(full), bakedBy(filter)), 1.05 * allowed(filter));
      EXPECT_LE(filter->GetStorageDifference(), allowed(filter));
      EXPECT_LT(filter->GetNumberOfTextureBytes(), full->GetNumberOfTextureBytes() + 8192);
    }
  }
}

TEST(Storage, OneValueIsTheMeanOfEachParticle)
{
  const auto filter = bakeWith(mixedCloud(Particles), Filter::OneValue);
  vtkPolyData* data = bakedBy(filter);
  std::string fault;
  const po::BakedTextures textures = po::readBakedTextures(*data, fault);
  EXPECT_EQ(fault, "");
  EXPECT_LE(filter->GetNumberOfTextureBytes(), 256);
  for (vtkIdType i = 0; i < Particles; ++i)
  {
    const double mean = data->GetPointData()->GetArray("AmbientOcclusion")->GetComponent(i, 0);
    EXPECT_NEAR(textures.textures.at(static_cast<std::size_t>(i), { 0, 0, 1 }), mean, 0.005);
  }
  const auto full = bakeWith(mixedCloud(Particles), Filter::Full);
  EXPECT_NEAR(filter->GetStorageDifference() / lookupDifference(bakedBy(full), data), 1, 0.15);
}

TEST(Storage, IsDescribed)
{
  const auto compressed = baked(Filter::Compressed);
  EXPECT_EQ(parameter(compressed->GetFieldData(), "storage"), "Compressed");
  EXPECT_EQ(parameter(compressed->GetFieldData(), "resolution"), "8");
  EXPECT_NE(compressed->GetFieldData()->GetArray("AmbientOcclusionBasis"), nullptr);
  const auto one = baked(Filter::OneValue);
  EXPECT_EQ(parameter(one->GetFieldData(), "resolution"), "1");
  EXPECT_EQ(parameter(one->GetFieldData(), "bakedResolution"), "8");
}

TEST(Storage, AnEarlierBasisIsForgotten)
{
  const auto again = bakeWith(baked(Filter::Compressed), Filter::Full);
  EXPECT_EQ(bakedBy(again)->GetFieldData()->GetArray("AmbientOcclusionBasis"), nullptr);
}

TEST(Storage, ShorterTexturesAreNoFloats)
{
  for (const int storage : { Filter::VariableSize, Filter::Compressed })
  {
    vtkNew<Filter> filter;
    filter->SetInputData(lattice(2));
    filter->SetStorage(storage);
    filter->SetEncoding(Filter::Float32Linear);
    const std::string error = errorOf(filter);
    EXPECT_NE(error.find("Storage"), std::string::npos) << error;
    EXPECT_NE(error.find("UInt8Gamma2"), std::string::npos) << error;
  }
  vtkNew<Filter> negative;
  negative->SetInputData(lattice(2));
  negative->SetStorageError(-1);
  EXPECT_NE(errorOf(negative).find("StorageError"), std::string::npos);
}

TEST(Storage, NothingLitNeedsNoBasis)
{
  const auto filter = bakeWith(lattice(1), Filter::Compressed);
  EXPECT_EQ(filter->GetNumberOfTextures(), 1);
  EXPECT_EQ(filter->GetNumberOfTextureBytes(), 4);
  EXPECT_EQ(lookupDifference(bakedBy(filter), bakedBy(bakeWith(lattice(1), Filter::Full))), 0);
}

TEST(Storage, BlocksGetTheirOwnTexturesAndMergeAgain)
{
  const auto whole = mixedCloud(Particles);
  for (const int storage : { Filter::VariableSize, Filter::Compressed })
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, part(whole, [](vtkIdType i) { return i % 3 == 0; }));
    blocks->SetBlock(1, part(whole, [](vtkIdType i) { return i % 3 != 0; }));
    const auto filter = bakeWith(blocks, storage);
    auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    std::string fault;
    const auto merged = po::mergeParticles({ vtkPolyData::SafeDownCast(output->GetBlock(0)),
                                             vtkPolyData::SafeDownCast(output->GetBlock(1)) },
      fault);
    EXPECT_EQ(fault, "");
    EXPECT_EQ(merged->GetFieldData()->GetArray("AmbientOcclusionTextures")->GetDataType(),
      VTK_UNSIGNED_CHAR)
      << "of one bake: no need to decode";
    // The same particles in the order of the blocks.
    vtkNew<vtkPolyData> expected;
    const auto full = bakeWith(blocks, Filter::Full);
    auto* fullOutput = vtkMultiBlockDataSet::SafeDownCast(full->GetOutputDataObject(0));
    const auto fullMerged =
      po::mergeParticles({ vtkPolyData::SafeDownCast(fullOutput->GetBlock(0)),
                           vtkPolyData::SafeDownCast(fullOutput->GetBlock(1)) },
        fault);
    EXPECT_LE(lookupDifference(fullMerged, merged), 1.05 * allowed(filter));
  }
}

TEST(Storage, BakesOfOtherBasesMergeDecoded)
{
  const auto a = baked(Filter::Compressed), c = baked(Filter::VariableSize);
  const auto b =
    vtkSmartPointer<vtkPolyData>(bakedBy(bakeWith(mixedCloud(Particles / 2), Filter::Compressed)));
  std::string fault;
  const auto merged = po::mergeParticles({ a, b, c }, fault);
  EXPECT_EQ(fault, "");
  EXPECT_EQ(parameter(merged->GetFieldData(), "storage"), "Full");
  const auto alone = po::mergeParticles({ a }, fault);
  std::string none;
  const po::BakedTextures all = po::readBakedTextures(*merged, none),
                          first = po::readBakedTextures(*a, none),
                          last = po::readBakedTextures(*c, none);
  for (std::size_t i = 0; i < Particles; ++i)
  {
    const po::Vec3f direction{ 0.3f, -0.5f, 0.7f };
    EXPECT_NEAR(all.textures.at(i, direction), first.textures.at(i, direction), 0.02) << i;
    EXPECT_NEAR(
      all.textures.at(i + Particles * 3 / 2, direction), last.textures.at(i, direction), 0.05)
      << i;
  }
}

TEST(Storage, GoesThroughFiles)
{
  TemporaryFolder folder;
  for (const int storage : { Filter::VariableSize, Filter::Compressed, Filter::OneValue })
  {
    const auto data = baked(storage);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->SetDataModeToBinary();
    writer->SetFileName(folder.file("baked.vtp").c_str());
    ASSERT_EQ(writer->Write(), 1);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(folder.file("baked.vtp").c_str());
    reader->Update();
    EXPECT_EQ(lookupDifference(data, reader->GetOutput()), 0) << storage;

    vtkNew<vtkOcclusionTextureWriter> images;
    images->SetInputData(data);
    images->SetFileName(folder.file("baked.exr").c_str());
    ASSERT_EQ(images->Write(), 1);
    vtkNew<vtkOcclusionTextureReader> loaded;
    loaded->SetInputData(mixedCloud(Particles));
    loaded->SetFileName(folder.file("baked.exr").c_str());
    loaded->Update();
    // At full size: lookups between the texels of fewer ones differ a little.
    EXPECT_LE(lookupDifference(data, loaded->GetOutput()), 0.01) << storage;
  }
}

TEST(Storage, IsKeptByTheCache)
{
  TemporaryFolder folder;
  for (const int storage : { Filter::VariableSize, Filter::Compressed, Filter::OneValue })
  {
    vtkSmartPointer<Filter> bakes[2];
    for (auto& filter : bakes)
    {
      filter = vtkSmartPointer<Filter>::New();
      filter->SetInputData(mixedCloud(Particles));
      filter->SetTextureResolution(8);
      filter->SetStorage(storage);
      filter->UseCacheOn();
      filter->SetCacheDirectory(folder.file("cache").c_str());
      filter->Update();
    }
    EXPECT_FALSE(bakes[0]->GetLoadedFromCache());
    EXPECT_TRUE(bakes[1]->GetLoadedFromCache());
    EXPECT_EQ(lookupDifference(bakedBy(bakes[0]), bakedBy(bakes[1])), 0);
    EXPECT_EQ(bakes[0]->GetStorageDifference(), bakes[1]->GetStorageDifference());
    EXPECT_EQ(bakes[0]->GetNumberOfTextureBytes(), bakes[1]->GetNumberOfTextureBytes());
  }
}

TEST(Storage, EachMistakeIsNamed)
{
  const auto warningOf = [](const std::function<void(vtkPolyData*)>& spoil)
  {
    const auto data = baked(Filter::Compressed);
    spoil(data);
    std::string warning;
    EXPECT_TRUE(po::readBakedTextures(*data, warning).textures.empty());
    return warning;
  };
  const auto set = [](vtkPolyData* data, const char* key, const char* value)
  {
    auto parameters = po::OcclusionParameters::fromFieldData(data->GetFieldData());
    parameters.set(key, value);
    parameters.toFieldData(data->GetFieldData());
  };
  const auto expectNamed = [](const std::string& warning, const char* what)
  { EXPECT_NE(warning.find(what), std::string::npos) << warning; };
  expectNamed(warningOf([](vtkPolyData* data)
                { data->GetFieldData()->RemoveArray("AmbientOcclusionBasis"); }),
    "AmbientOcclusionBasis");
  expectNamed(
    warningOf(
      [](vtkPolyData* data)
      {
        vtkIntArray::SafeDownCast(data->GetPointData()->GetArray("AmbientOcclusionTexture"))
          ->SetValue(0,
            static_cast<int>(
              data->GetFieldData()->GetArray("AmbientOcclusionTextures")->GetNumberOfTuples() - 1));
      }),
    "AmbientOcclusionTexture");
  expectNamed(
    warningOf([](vtkPolyData* data)
      { data->GetFieldData()->GetArray("AmbientOcclusionTextures")->SetNumberOfComponents(3); }),
    "AmbientOcclusionTextures");
  expectNamed(warningOf([&](vtkPolyData* data) { set(data, "storage", "Woven"); }), "Woven");
  expectNamed(warningOf([&](vtkPolyData* data) { set(data, "componentBits", "12x"); }), "bits");
  expectNamed(
    warningOf([&](vtkPolyData* data) { set(data, "componentBits", ""); }), "texture begins");
  expectNamed(
    warningOf([&](vtkPolyData* data) { set(data, "resolution", "16"); }), "AmbientOcclusionBasis");
  expectNamed(
    warningOf([&](vtkPolyData* data) { set(data, "encoding", "Float32Linear"); }), "encoding");
}
