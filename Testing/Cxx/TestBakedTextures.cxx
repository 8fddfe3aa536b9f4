// SPDX-License-Identifier: BSD-3-Clause
#include "BakedTextures.h"
#include "MergedParticles.h"
#include "OcclusionParameters.h"
#include "TextureTable.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

namespace
{
using namespace po;

/// Particles with textures of 1 x 1 texel: one a particle, of the given codes.
struct Block
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkIntArray> rows;
  vtkNew<vtkUnsignedCharArray> table;
  vtkNew<vtkFloatArray> means;

  explicit Block(const std::vector<unsigned char>& codes, double maximum = 1)
  {
    vtkNew<vtkPoints> points;
    this->rows->SetName(TextureIndexArray);
    this->table->SetName(TextureTableArray);
    this->means->SetName(OcclusionArray);
    for (const unsigned char code : codes)
    {
      points->InsertNextPoint(0, 0, 0);
      this->rows->InsertNextValue(static_cast<int>(this->table->GetNumberOfTuples()));
      this->table->InsertNextValue(code);
      this->means->InsertNextValue(0.25f);
    }
    this->data->SetPoints(points);
    this->data->GetPointData()->AddArray(this->rows);
    this->data->GetPointData()->AddArray(this->means);
    this->data->GetFieldData()->AddArray(this->table);
    this->describe(1, maximum);
  }

  void describe(int resolution, double maximum)
  {
    OcclusionParameters parameters;
    parameters.set("resolution", resolution);
    parameters.set("encoding", UInt8Gamma2);
    parameters.set("maximum", maximum);
    parameters.toFieldData(this->data->GetFieldData());
  }
};

float valueOf(vtkPointSet* points, std::size_t particle)
{
  std::string warning;
  const BakedTextures baked = readBakedTextures(*points, warning);
  EXPECT_EQ(warning, "");
  return baked.textures.at(particle, { 1, 0, 0 });
}

std::string warningOf(vtkPointSet* points)
{
  std::string warning;
  EXPECT_TRUE(readBakedTextures(*points, warning).textures.empty());
  return warning;
}

TEST(BakedTextures, ParticlesGetTheirTextures)
{
  Block block({ 0, 128, 255 }, 0.5);
  EXPECT_EQ(valueOf(block.data, 0), 0);
  EXPECT_NEAR(valueOf(block.data, 1), decodeGamma2(128, 0.5), 1e-7);
  EXPECT_NEAR(valueOf(block.data, 2), 0.5, 1e-7);
  block.rows->SetValue(1, -1);
  EXPECT_EQ(valueOf(block.data, 1), 0.25f) << "the mean";
}

TEST(BakedTextures, WithoutArraysThereIsNoWarning)
{
  vtkNew<vtkPolyData> bare;
  bare->SetPoints(vtkNew<vtkPoints>());
  EXPECT_EQ(warningOf(bare), "");
}

TEST(BakedTextures, MeansAloneAreUsed)
{
  Block block({ 10, 20 });
  block.data->GetPointData()->RemoveArray(TextureIndexArray);
  block.data->GetFieldData()->RemoveArray(TextureTableArray);
  EXPECT_EQ(valueOf(block.data, 1), 0.25f);
}

TEST(BakedTextures, EachMistakeIsNamed)
{
  const auto expectNamed = [](Block& block, const char* array)
  { EXPECT_NE(warningOf(block.data).find(array), std::string::npos) << warningOf(block.data); };
  Block outOfRange({ 1, 2 });
  outOfRange.rows->SetValue(0, 2);
  expectNamed(outOfRange, TextureIndexArray);

  Block wrongSize({ 1, 2 });
  wrongSize.describe(2, 1);
  expectNamed(wrongSize, TextureTableArray);

  Block noRows({ 1, 2 });
  noRows.data->GetPointData()->RemoveArray(TextureIndexArray);
  expectNamed(noRows, TextureIndexArray);

  Block noTable({ 1, 2 });
  noTable.data->GetFieldData()->RemoveArray(TextureTableArray);
  expectNamed(noTable, TextureTableArray);

  Block noParameters({ 1, 2 });
  noParameters.data->GetFieldData()->RemoveArray(ParametersArray);
  expectNamed(noParameters, ParametersArray);

  Block shortRows({ 1, 2 });
  shortRows.rows->SetNumberOfTuples(1);
  expectNamed(shortRows, TextureIndexArray);
}

TEST(MergedParticles, TexturesStayWithTheirParticles)
{
  Block a({ 10, 20 }), b({ 30, 40, 50 });
  b.rows->SetValue(1, -1);
  vtkNew<vtkPolyData> empty;
  std::string warning;
  const auto merged = mergeParticles({ a.data, empty, b.data }, warning);
  EXPECT_EQ(warning, "");
  ASSERT_EQ(merged->GetNumberOfPoints(), 5);
  const unsigned char codes[] = { 10, 20, 30, 40, 50 };
  for (const std::size_t i : { 0, 1, 2, 4 })
  {
    EXPECT_NEAR(valueOf(merged, i), decodeGamma2(codes[i], 1), 1e-7) << i;
  }
  EXPECT_EQ(valueOf(merged, 3), 0.25f) << "a particle with its mean only";
  EXPECT_EQ(merged->GetFieldData()->GetArray(TextureTableArray)->GetDataType(), VTK_UNSIGNED_CHAR);
}

TEST(MergedParticles, TablesOfOtherMaximaAreDecoded)
{
  Block a({ 100, 200 }, 1), b({ 100 }, 0.3);
  std::string warning;
  const auto merged = mergeParticles({ a.data, b.data }, warning);
  EXPECT_EQ(warning, "");
  EXPECT_NEAR(valueOf(merged, 1), decodeGamma2(200, 1), 1e-6);
  EXPECT_NEAR(valueOf(merged, 2), decodeGamma2(100, 0.3), 1e-6);
}

TEST(MergedParticles, OtherResolutionsAreReportedAndLeaveTheParticles)
{
  Block a({ 100 }), b({ 1 });
  vtkNew<vtkUnsignedCharArray> larger;
  larger->SetName(TextureTableArray);
  larger->SetNumberOfComponents(4);
  larger->SetNumberOfTuples(1);
  larger->Fill(7);
  b.data->GetFieldData()->AddArray(larger);
  b.describe(2, 1);
  std::string warning;
  const auto merged = mergeParticles({ a.data, b.data }, warning);
  EXPECT_NE(warning.find("resolution"), std::string::npos);
  EXPECT_EQ(merged->GetNumberOfPoints(), 2);
  EXPECT_EQ(valueOf(merged, 0), 0.25f) << "the means are left";
}

TEST(MergedParticles, NothingGivesNothing)
{
  std::string warning;
  EXPECT_EQ(mergeParticles({}, warning)->GetNumberOfPoints(), 0);
  EXPECT_EQ(warning, "");
}
}
