// SPDX-License-Identifier: BSD-3-Clause
/// Bakes of a part of the particles: as if the others were not there.

#include "BakeFilterTestSupport.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace
{
using Filter = vtkSphereAmbientOcclusion;

constexpr int Side = 5;
constexpr int Count = Side * Side * Side;

/// A lattice with the array "height", and a vector.
vtkSmartPointer<vtkPolyData> cloud()
{
  auto data = lattice(Side);
  vtkNew<vtkFloatArray> heights, velocities;
  heights->SetName("height");
  velocities->SetName("velocity");
  velocities->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double z = data->GetPoint(i)[2];
    heights->InsertNextValue(static_cast<float>(z));
    velocities->InsertNextTuple3(0.6 * z, 0, -0.8 * z);
  }
  data->GetPointData()->AddArray(heights);
  data->GetPointData()->AddArray(velocities);
  return data;
}

vtkSmartPointer<Filter> makeFilter(vtkDataObject* particles)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetController(nullptr);
  filter->SetTextureResolution(8);
  filter->SetInputDataObject(particles);
  return filter;
}

vtkPolyData* output(Filter* filter)
{
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPolyData> only(vtkPolyData* whole, const std::function<bool(vtkIdType)>& keep)
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
  {
    if (keep(i))
    {
      points->InsertNextPoint(whole->GetPoint(i));
      radii->InsertNextValue(0.5);
    }
  }
  part->SetPoints(points);
  part->GetPointData()->AddArray(radii);
  return part;
}

double at(vtkPolyData* data, const char* name, vtkIdType i)
{
  return data->GetPointData()->GetArray(name)->GetComponent(i, 0);
}

/// All particles are there in their order; those that are kept are as if they had been baked by
/// themselves, the others dark and without a texture.
void expectBakedAlone(Filter* cropped, const std::function<bool(vtkIdType)>& keep)
{
  const auto whole = cloud();
  cropped->SetInputData(whole);
  vtkPolyData* all = output(cropped);
  const auto alone = makeFilter(only(whole, keep));
  vtkPolyData* part = output(alone);
  ASSERT_GT(part->GetNumberOfPoints(), 0);
  ASSERT_EQ(all->GetNumberOfPoints(), Count);
  EXPECT_EQ(all->GetPoints(), whole->GetPoints());
  vtkDataArray* table = all->GetFieldData()->GetArray("AmbientOcclusionTextures");
  vtkDataArray* partTable = part->GetFieldData()->GetArray("AmbientOcclusionTextures");
  vtkIdType next = 0;
  for (vtkIdType i = 0; i < Count; ++i)
  {
    const auto row = static_cast<vtkIdType>(at(all, "AmbientOcclusionTexture", i));
    if (!keep(i))
    {
      EXPECT_EQ(row, -1) << i;
      EXPECT_EQ(at(all, "AmbientOcclusion", i), 0) << i;
      continue;
    }
    // The lattice is one of wholes and halves: another middle of the cloud changes no bit.
    const auto partRow = static_cast<vtkIdType>(at(part, "AmbientOcclusionTexture", next));
    EXPECT_NEAR(at(all, "AmbientOcclusion", i), at(part, "AmbientOcclusion", next), 1e-5) << i;
    for (int texel = 0; texel < table->GetNumberOfComponents(); ++texel)
    {
      EXPECT_NEAR(table->GetComponent(row, texel), partTable->GetComponent(partRow, texel), 1);
    }
    ++next;
  }
  EXPECT_EQ(next, part->GetNumberOfPoints());
  EXPECT_EQ(cropped->GetNumberOfParticles(), next);
  EXPECT_EQ(cropped->GetNumberOfParticlesLeftOut(), Count - next);
}

TEST(BakeCrop, OfAnArrayIsTheBakeOfTheRestAlone)
{
  const auto filter = makeFilter(cloud());
  filter->SetCropArray("height");
  filter->SetCropRange(1, 3);
  const auto keep = [](vtkIdType i)
  {
    const auto z = i / (Side * Side);
    return z >= 1 && z <= 3;
  };
  expectBakedAlone(filter, keep);
  filter->SetCropArray("velocity"); // its magnitude is the height
  filter->SetCropRange(0.999, 3.001);
  expectBakedAlone(filter, keep);
  filter->SetCropComponent(2);
  filter->SetCropRange(-2.401, -0.799);
  expectBakedAlone(filter, keep);
}

TEST(BakeCrop, OfAPlaneAndABoxIsTheBakeOfTheRestAlone)
{
  for (const int method : { Filter::Sweep, Filter::Embree })
  {
    const auto filter = makeFilter(cloud());
    filter->SetMethod(method);
    filter->CropPlaneOn();
    filter->SetCropPlaneOrigin(9, 2.5, 9);
    filter->SetCropPlaneNormal(0, -2, 0);
    if (method == Filter::Sweep)
    {
      expectBakedAlone(filter, [](vtkIdType i) { return i / Side % Side < 3; });
    }
    filter->CropBoxOn();
    filter->SetCropBoxOrigin(-1, -1, 0.5);
    filter->SetCropBoxSize(3.5, 9, 9);
    filter->Update();
    EXPECT_EQ(filter->GetNumberOfParticles(), 3 * 3 * 4);
    EXPECT_EQ(filter->GetNumberOfParticlesLeftOut(), Count - 3 * 3 * 4);
  }
}

TEST(BakeCrop, WhatWasBuriedSeesTheLight)
{
  const auto filter = makeFilter(cloud());
  const vtkIdType middle = Count / 2;
  const double before = at(output(filter), "AmbientOcclusion", middle);
  filter->CropPlaneOn();
  filter->SetCropPlaneOrigin(2, 2, 2);
  filter->SetCropPlaneNormal(0, 0, -1); // keeps the plane itself
  const double after = at(output(filter), "AmbientOcclusion", middle);
  EXPECT_GT(after, before + 0.2);
  EXPECT_EQ(parameter(output(filter)->GetFieldData(), "cropPlaneNormal"), "0 0 -1");
  filter->CropPlaneOff();
  EXPECT_EQ(at(output(filter), "AmbientOcclusion", middle), before);
  EXPECT_EQ(parameter(output(filter)->GetFieldData(), "cropPlaneNormal"), "(missing)");
}

TEST(BakeCrop, CountsThroughBlocks)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  const auto first = cloud(), second = cloud();
  for (vtkIdType i = 0; i < Count; ++i)
  {
    double p[3];
    second->GetPoint(i, p);
    second->GetPoints()->SetPoint(i, p[0] + Side, p[1], p[2]);
    second->GetPointData()->GetArray("height")->SetComponent(i, 0, 10 + p[2]);
  }
  blocks->SetBlock(0, first);
  blocks->SetBlock(1, second);
  const auto filter = makeFilter(blocks);
  filter->SetCropArray("height");
  filter->SetCropRange(4, 11);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfParticles(), 3 * Side * Side);
  auto* baked = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  for (unsigned block = 0; block < 2; ++block)
  {
    auto* data = vtkPolyData::SafeDownCast(baked->GetBlock(block));
    for (vtkIdType i = 0; i < Count; ++i)
    {
      const auto z = i / (Side * Side);
      const bool kept = block == 0 ? z == 4 : z <= 1;
      EXPECT_EQ(at(data, "AmbientOcclusionTexture", i) >= 0, kept) << block << " " << i;
    }
  }
}

TEST(BakeCrop, MistakesAreNamed)
{
  const auto errorWith = [](const std::function<void(Filter*)>& change)
  {
    const auto filter = makeFilter(cloud());
    change(filter);
    return errorOf(filter);
  };
  const std::string noArray = errorWith([](Filter* f) { f->SetCropArray("nothing"); });
  EXPECT_NE(noArray.find("\"nothing\""), std::string::npos) << noArray;
  EXPECT_NE(noArray.find("height"), std::string::npos) << "lists what there is";
  const auto noComponent = [](Filter* f)
  {
    f->SetCropArray("velocity");
    f->SetCropComponent(3);
  };
  EXPECT_NE(errorWith(noComponent).find("component 3"), std::string::npos);
  const auto nothingLeft = [](Filter* f)
  {
    f->CropPlaneOn();
    f->SetCropPlaneOrigin(0, 0, 100);
  };
  EXPECT_NE(errorWith(nothingLeft).find("leaves no particle"), std::string::npos);
  const auto noNormal = [](Filter* f)
  {
    f->CropPlaneOn();
    f->SetCropPlaneNormal(0, 0, 0);
  };
  EXPECT_NE(errorWith(noNormal).find("CropPlaneNormal"), std::string::npos);
  EXPECT_EQ(errorWith([](Filter* f) { f->SetCropArray("(none)"); }), "");
}
}
