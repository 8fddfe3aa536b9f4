// SPDX-License-Identifier: BSD-3-Clause
/// The light of the filter: what it changes in the output, and what it does not.

#include "BakeFilterTestSupport.h"
#include "BakedTextures.h"
#include "OcclusionTextureTestData.h"
#include "vtkOcclusionTextureReader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace
{
using Filter = vtkSphereAmbientOcclusion;

vtkSmartPointer<Filter> makeFilter(vtkPolyData* particles)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetController(nullptr);
  filter->SetTextureResolution(8);
  filter->SetInputData(particles);
  return filter;
}

vtkPolyData* output(Filter* filter)
{
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

std::vector<std::string> keysOf(vtkPolyData* data)
{
  const auto parameters = po::OcclusionParameters::fromFieldData(data->GetFieldData());
  std::vector<std::string> keys;
  for (const auto& [key, value] : parameters.entries())
  {
    keys.push_back(key);
  }
  return keys;
}

void expectSame(vtkAbstractArray* a, vtkAbstractArray* b)
{
  ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
  EXPECT_EQ(std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
              static_cast<std::size_t>(a->GetNumberOfValues() * a->GetDataTypeSize())),
    0)
    << a->GetName();
}

TEST(BakeLight, OffLeavesTheContractAsItIs)
{
  const auto plain = makeFilter(lattice(5));
  const auto off = makeFilter(lattice(5));
  off->SetLightDirection(0, 1, 0);
  off->SetLightIntensity(7);
  vtkPolyData* a = output(plain);
  vtkPolyData* b = output(off);
  for (const char* name : { po::OcclusionArray, po::TextureIndexArray })
  {
    expectSame(a->GetPointData()->GetArray(name), b->GetPointData()->GetArray(name));
  }
  expectSame(a->GetFieldData()->GetArray(po::TextureTableArray),
    b->GetFieldData()->GetArray(po::TextureTableArray));
  const std::vector<std::string> keys{ "version", "method", "resolution", "samplesPerTexel", "seed",
    "encoding", "gamma", "maximum", "storage", "storageError", "storageDifference",
    "bakedResolution", "insideThreshold", "dilateInside", "maximumDistance", "radiusArray",
    "radiusScale", "constantRadius", "idArray", "radiusFrom", "density", "background",
    "targetError", "estimatedError", "directions", "occluderTriangles", "occluderSpheres",
    "refinedParticles" };
  EXPECT_EQ(keysOf(a), keys);
  EXPECT_EQ(keysOf(b), keys);
  std::string warning;
  EXPECT_FALSE(po::readBakedTextures(*a, warning).hasLight);
}

TEST(BakeLight, IsToldInTheOutput)
{
  const auto filter = makeFilter(lattice(5));
  filter->BakeLightOn();
  filter->SetLightDirection(0, 1, -0.25);
  filter->SetLightIntensity(0.1);
  vtkPolyData* data = output(filter);
  EXPECT_EQ(parameter(data->GetFieldData(), "bakeLight"), "1");
  EXPECT_EQ(parameter(data->GetFieldData(), "lightDirection"), "0 1 -0.25");
  EXPECT_EQ(parameter(data->GetFieldData(), "lightIntensity"), "0.10000000000000001");
  std::string warning;
  EXPECT_TRUE(po::readBakedTextures(*data, warning).hasLight);
  EXPECT_EQ(warning, "");
}

TEST(BakeLight, LightensTheSideThatItComesFrom)
{
  // It shines along +x: the layer x = 0 is lit, what is behind it is not.
  const auto filter = makeFilter(lattice(5));
  vtkDataArray* occlusion = output(filter)->GetPointData()->GetArray(po::OcclusionArray);
  const double first = occlusion->GetComponent(62 - 2, 0),
               last = occlusion->GetComponent(62 + 2, 0);
  EXPECT_NEAR(first, last, 0.02);
  filter->BakeLightOn();
  filter->SetLightDirection(1, 0, 0);
  vtkDataArray* lit = output(filter)->GetPointData()->GetArray(po::OcclusionArray);
  // A touching neighbour on each of four sides takes no light; the mean of max(0, cos) is 1/4.
  EXPECT_NEAR(lit->GetComponent(62 - 2, 0), (first + 0.25) / 2, 0.01);
  EXPECT_NEAR(lit->GetComponent(62 + 2, 0), last / 2, 0.01);
}

TEST(BakeLight, GoesThroughTextureFiles)
{
  const auto filter = makeFilter(lattice(4));
  filter->BakeLightOn();
  vtkPolyData* data = output(filter);
  TemporaryFolder folder;
  write(data, folder.file("lit.exr"));
  vtkNew<vtkOcclusionTextureReader> reader;
  reader->SetFileName(folder.file("lit.exr").c_str());
  reader->SetInputData(lattice(4));
  reader->Update();
  for (const char* key : { "bakeLight", "lightDirection", "lightIntensity" })
  {
    EXPECT_EQ(
      parameter(reader->GetOutput()->GetFieldData(), key), parameter(data->GetFieldData(), key));
  }
  EXPECT_EQ(parameter(data->GetFieldData(), "bakeLight"), "1");
}

TEST(BakeLight, IsKeptByEveryStorage)
{
  const auto full = makeFilter(lattice(6));
  full->BakeLightOn();
  std::string warning;
  const po::BakedTextures all = po::readBakedTextures(*output(full), warning);
  for (const int storage : { Filter::VariableSize, Filter::Compressed, Filter::OneValue })
  {
    const auto filter = makeFilter(lattice(6));
    filter->BakeLightOn();
    filter->SetStorage(storage);
    const po::BakedTextures stored = po::readBakedTextures(*output(filter), warning);
    EXPECT_EQ(warning, "");
    EXPECT_TRUE(stored.hasLight);
    double squares = 0;
    constexpr int Side = 6, Count = Side * Side * Side;
    for (std::size_t i = 0; i < Count; ++i)
    {
      const po::Vec3f direction{ -1, 0.3f, 0.2f };
      const double difference = stored.textures.at(i, direction) - all.textures.at(i, direction);
      squares += difference * difference / Count;
    }
    EXPECT_LT(std::sqrt(squares), storage == Filter::OneValue ? 0.4 : 0.03) << storage;
  }
}

TEST(BakeLight, MistakesAreNamed)
{
  const auto errorWith = [](double z, double intensity)
  {
    const auto filter = makeFilter(lattice(2));
    filter->SetLightDirection(0, 0, z);
    filter->SetLightIntensity(intensity);
    EXPECT_EQ(errorOf(filter), "") << "off";
    filter->BakeLightOn();
    return errorOf(filter);
  };
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(errorWith(0, 1).find("LightDirection"), std::string::npos);
  EXPECT_NE(errorWith(NaN, 1).find("LightDirection"), std::string::npos);
  EXPECT_NE(errorWith(1, -1).find("LightIntensity"), std::string::npos);
  EXPECT_NE(errorWith(1, NaN).find("LightIntensity"), std::string::npos);
  EXPECT_NE(errorWith(1, HUGE_VAL).find("LightIntensity"), std::string::npos);
  EXPECT_EQ(errorWith(1, 0), "");
}
}
