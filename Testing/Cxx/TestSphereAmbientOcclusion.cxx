// SPDX-License-Identifier: BSD-3-Clause
#include "BakeFilterTestSupport.h"
#include "WorkingThreads.h"

#include "vtkSphereAmbientOcclusion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

TEST(SphereAmbientOcclusion, OutputFollowsTheDataContract)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  const auto input = lattice(3);
  filter->SetInputData(input);
  filter->Update();
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  ASSERT_EQ(output->GetNumberOfPoints(), 27);
  EXPECT_TRUE(output->GetPointData()->HasArray("radius"));
  EXPECT_FALSE(input->GetPointData()->HasArray("AmbientOcclusion")); // the input is untouched

  auto* mean =
    vtkFloatArray::SafeDownCast(output->GetPointData()->GetAbstractArray("AmbientOcclusion"));
  auto* index =
    vtkIntArray::SafeDownCast(output->GetPointData()->GetAbstractArray("AmbientOcclusionTexture"));
  auto* table = vtkUnsignedCharArray::SafeDownCast(
    output->GetFieldData()->GetAbstractArray("AmbientOcclusionTextures"));
  ASSERT_TRUE(mean && index && table);
  EXPECT_EQ(mean->GetNumberOfTuples(), 27);
  EXPECT_EQ(mean->GetNumberOfComponents(), 1);
  EXPECT_EQ(table->GetNumberOfComponents(), 256);
  EXPECT_EQ(table->GetNumberOfTuples(), filter->GetNumberOfTextures());
  for (vtkIdType i = 0; i < 27; ++i)
  {
    EXPECT_GE(mean->GetValue(i), 0);
    EXPECT_LE(mean->GetValue(i), 1);
    EXPECT_GE(index->GetValue(i), 0);
    EXPECT_LT(index->GetValue(i), table->GetNumberOfTuples());
  }
  const unsigned char* bytes = table->GetPointer(0);
  // The largest value of the table is the scale.
  EXPECT_EQ(*std::max_element(bytes, bytes + table->GetNumberOfValues()), 255);

  EXPECT_EQ(parameter(output->GetFieldData(), "resolution"), "16");
  EXPECT_EQ(parameter(output->GetFieldData(), "encoding"), "UInt8Gamma2");
  EXPECT_EQ(std::stod(parameter(output->GetFieldData(), "gamma")), 2);
  EXPECT_EQ(std::stod(parameter(output->GetFieldData(), "maximum")), 1);
  EXPECT_EQ(parameter(output->GetFieldData(), "samplesPerTexel"), "49");
  EXPECT_EQ(parameter(output->GetFieldData(), "seed"), "1");
  EXPECT_EQ(parameter(output->GetFieldData(), "version"), "1");
}

TEST(SphereAmbientOcclusion, CornersSeeMoreThanTheMiddle)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(lattice(3));
  filter->SetEncoding(vtkSphereAmbientOcclusion::Float32Linear);
  filter->SetTextureResolution(8);
  filter->Update();
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  vtkDataArray* mean = output->GetPointData()->GetArray("AmbientOcclusion");
  EXPECT_GT(mean->GetComponent(0, 0), 2 * mean->GetComponent(13, 0));
  auto* table = vtkFloatArray::SafeDownCast(
    output->GetFieldData()->GetAbstractArray("AmbientOcclusionTextures"));
  ASSERT_TRUE(table);
  EXPECT_EQ(table->GetNumberOfComponents(), 64);
  // Corner 0 has its neighbours towards +x, +y, +z: direction (-1,-1,-1), row 5, column 5, is open.
  const double row =
    output->GetPointData()->GetArray("AmbientOcclusionTexture")->GetComponent(0, 0);
  EXPECT_GT(table->GetComponent(static_cast<vtkIdType>(row), 5 * 8 + 5), 0.95);
  EXPECT_LT(table->GetComponent(static_cast<vtkIdType>(row), 2 * 8 + 1), 0.5);
}

TEST(SphereAmbientOcclusion, EqualTexturesAreStoredOnce)
{
  // Far apart: all particles are fully open.
  auto data = lattice(2);
  for (vtkIdType i = 0; i < 8; ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    data->GetPoints()->SetPoint(i, 1e9 * p[0], 1e9 * p[1], 1e9 * p[2]);
  }
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(data);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfTextures(), 1);
  EXPECT_EQ(filter->GetNumberOfTextureBytes(), 256);
}

TEST(SphereAmbientOcclusion, GivesTheSameBitsForAnyNumberOfThreads)
{
  std::vector<std::string> tables;
  for (const std::size_t limit : { 1, 2, 7 })
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);
    vtkNew<vtkSphereAmbientOcclusion> filter;
    filter->SetInputData(lattice(6));
    filter->Update();
    auto* table =
      vtkUnsignedCharArray::SafeDownCast(vtkPolyData::SafeDownCast(filter->GetOutput())
                                           ->GetFieldData()
                                           ->GetAbstractArray("AmbientOcclusionTextures"));
    tables.emplace_back(reinterpret_cast<const char*>(table->GetPointer(0)),
      static_cast<std::size_t>(table->GetNumberOfValues()));
  }
  EXPECT_TRUE(tables[0] == tables[1]);
  EXPECT_TRUE(tables[0] == tables[2]);
}

TEST(SphereAmbientOcclusion, UsesMoreThanOneThread)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(lattice(12));
  EXPECT_TRUE(moreThanOneThreadTakesPart(
    [&]
    {
      filter->Modified();
      filter->Update();
      return filter->GetNumberOfThreads();
    }));
}

TEST(SphereAmbientOcclusion, LeavesOutBadParticlesWithOneWarning)
{
  auto data = lattice(3);
  radiiOf(data)->SetValue(0, NaN);
  radiiOf(data)->SetValue(1, -1);
  radiiOf(data)->SetValue(2, Infinity);
  radiiOf(data)->SetValue(3, 0);
  data->GetPoints()->SetPoint(4, NaN, 0, 0);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(data);
  WarningCatcher warnings(filter);
  EXPECT_EQ(errorOf(filter), "");
  EXPECT_EQ(warnings.count(), 1);
  EXPECT_NE(warnings.text().find("5 particles are left out"), std::string::npos) << warnings.text();
  EXPECT_EQ(filter->GetNumberOfParticlesLeftOut(), 5);
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  ASSERT_EQ(output->GetNumberOfPoints(), 27);
  vtkPointData* arrays = output->GetPointData();
  EXPECT_EQ(arrays->GetArray("AmbientOcclusionTexture")->GetComponent(0, 0), -1);
  EXPECT_EQ(arrays->GetArray("AmbientOcclusion")->GetComponent(4, 0), 0);
  EXPECT_GE(arrays->GetArray("AmbientOcclusionTexture")->GetComponent(5, 0), 0);
}

TEST(SphereAmbientOcclusion, RadiiComeFromWhereTheUserSays)
{
  const auto meanOf = [](vtkPolyData* data, const char* array, double constant)
  {
    vtkNew<vtkSphereAmbientOcclusion> filter;
    filter->SetInputData(data);
    filter->SetRadiusArray(array);
    filter->SetConstantRadius(constant);
    filter->SetTextureResolution(4);
    EXPECT_EQ(errorOf(filter), "");
    return vtkPolyData::SafeDownCast(filter->GetOutput())
      ->GetPointData()
      ->GetArray("AmbientOcclusion")
      ->GetComponent(0, 0);
  };
  const double expected = meanOf(lattice(3), "radius", 0);
  EXPECT_EQ(meanOf(lattice(3), "", 0), expected);
  EXPECT_EQ(meanOf(lattice(3), "(automatic)", 0), expected);
  EXPECT_EQ(meanOf(lattice(3), "(none)", 0.5), expected);
  EXPECT_EQ(meanOf(lattice(3, "charge"), "", 0), expected); // estimated from the spacing: 1/2
  EXPECT_GT(meanOf(lattice(3), "(none)", 0.2), expected);
}

TEST(SphereAmbientOcclusion, BlocksOccludeEachOther)
{
  // The same six layers as one data set and as two blocks: the same values at the same places.
  const auto whole = lattice(4);
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int half = 0; half < 2; ++half)
  {
    vtkNew<vtkPolyData> block;
    vtkNew<vtkPoints> points;
    vtkNew<vtkDoubleArray> radii;
    radii->SetName("radius");
    for (vtkIdType i = 32 * half; i < 32 * (half + 1); ++i)
    {
      points->InsertNextPoint(whole->GetPoint(i));
      radii->InsertNextValue(0.5);
    }
    block->SetPoints(points);
    block->GetPointData()->AddArray(radii);
    blocks->SetBlock(static_cast<unsigned>(half), block);
  }
  vtkNew<vtkSphereAmbientOcclusion> one;
  one->SetInputData(whole);
  one->Update();
  vtkNew<vtkSphereAmbientOcclusion> two;
  two->SetInputData(blocks);
  two->Update();
  auto* all = vtkPolyData::SafeDownCast(one->GetOutput());
  auto* output = vtkMultiBlockDataSet::SafeDownCast(two->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  auto* table = vtkUnsignedCharArray::SafeDownCast(
    all->GetFieldData()->GetAbstractArray("AmbientOcclusionTextures"));
  for (int half = 0; half < 2; ++half)
  {
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(static_cast<unsigned>(half)));
    ASSERT_TRUE(block);
    auto* blockTable = vtkUnsignedCharArray::SafeDownCast(
      block->GetFieldData()->GetAbstractArray("AmbientOcclusionTextures"));
    ASSERT_TRUE(blockTable);
    for (vtkIdType i = 0; i < 32; ++i)
    {
      const auto row = [](vtkPolyData* data, vtkIdType point)
      {
        return static_cast<vtkIdType>(
          data->GetPointData()->GetArray("AmbientOcclusionTexture")->GetComponent(point, 0));
      };
      const vtkIdType there = row(all, i + 32 * half);
      const vtkIdType here = row(block, i);
      ASSERT_LT(here, blockTable->GetNumberOfTuples());
      EXPECT_EQ(
        std::memcmp(table->GetPointer(256 * there), blockTable->GetPointer(256 * here), 256), 0);
    }
    EXPECT_FALSE(vtkPolyData::SafeDownCast(blocks->GetBlock(static_cast<unsigned>(half)))
                   ->GetPointData()
                   ->HasArray("AmbientOcclusion"));
  }
}

TEST(SphereAmbientOcclusion, ATargetErrorChoosesTheWork)
{
  for (const int method : { vtkSphereAmbientOcclusion::Sweep, vtkSphereAmbientOcclusion::Embree,
         vtkSphereAmbientOcclusion::Reference })
  {
    vtkNew<vtkSphereAmbientOcclusion> filter;
    filter->SetInputData(lattice(5));
    filter->SetTextureResolution(4);
    filter->SetMethod(method);
    EXPECT_EQ(errorOf(filter), "");
    const int directions = filter->GetNumberOfDirections();
    filter->SetTargetError(0.01);
    EXPECT_EQ(errorOf(filter), "");
    EXPECT_LE(filter->GetEstimatedError(), 0.01);
    EXPECT_GT(filter->GetEstimatedError(), 0);
    auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
    EXPECT_EQ(parameter(output->GetFieldData(), "refinedParticles"),
      std::to_string(filter->GetNumberOfParticlesRefined()));
    const bool hasDirections = method != vtkSphereAmbientOcclusion::Reference;
    EXPECT_TRUE(hasDirections ? filter->GetNumberOfDirections() != directions
                              : filter->GetNumberOfSamplesUsed() > 49);
  }
}

TEST(SphereAmbientOcclusion, AllMethodsGiveTheSameValues)
{
  std::vector<double> means;
  for (const int method : { vtkSphereAmbientOcclusion::Automatic, vtkSphereAmbientOcclusion::Sweep,
         vtkSphereAmbientOcclusion::Embree, vtkSphereAmbientOcclusion::Reference })
  {
    vtkNew<vtkSphereAmbientOcclusion> filter;
    filter->SetInputData(lattice(4));
    filter->SetSamplesPerTexel(400);
    filter->SetTextureResolution(6);
    filter->SetMethod(method);
    EXPECT_EQ(errorOf(filter), "");
    auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
    EXPECT_EQ(parameter(output->GetFieldData(), "method"), filter->GetMethodUsed());
    vtkDataArray* mean = output->GetPointData()->GetArray("AmbientOcclusion");
    for (vtkIdType i = 0; i < mean->GetNumberOfTuples(); ++i)
    {
      means.push_back(mean->GetComponent(i, 0));
    }
  }
  ASSERT_EQ(means.size(), 4 * 64u);
  for (std::size_t i = 0; i < 64; ++i)
  {
    EXPECT_EQ(means[i], means[i + 64]); // Automatic is Sweep
    EXPECT_NEAR(means[i + 64], means[i + 192], 0.01);
    EXPECT_NEAR(means[i + 128], means[i + 192], 0.01);
  }
}
}
