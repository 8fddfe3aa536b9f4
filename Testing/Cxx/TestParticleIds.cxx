// SPDX-License-Identifier: BSD-3-Clause
/// Particles that are followed through time by their ids.

#include "BakeFilterTestSupport.h"
#include "Random.h"

#include "vtkIdTypeArray.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace
{
using Filter = vtkSphereAmbientOcclusion;

constexpr int Static = 300;

/// A cluster that does not move, then one particle far away, whose place changes the frame of all.
vtkSmartPointer<vtkPolyData> step(double place, const std::vector<int>& order, bool withIds = true)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("id");
  for (const int i : order)
  {
    po::Random random(1, static_cast<std::uint64_t>(i), 0);
    const double x = 9 * random.uniform(), y = 9 * random.uniform(), z = 9 * random.uniform();
    points->InsertNextPoint(i == Static ? place : x, y, z);
    radii->InsertNextValue(0.5);
    ids->InsertNextValue(1000 + i);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  if (withIds)
  {
    data->GetPointData()->AddArray(ids);
  }
  return data;
}

std::vector<int> inOrder(int count = Static + 1)
{
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

vtkSmartPointer<vtkPolyData> bake(vtkPolyData* data, int method, const char* idArray = nullptr)
{
  vtkNew<Filter> filter;
  filter->SetController(nullptr);
  filter->SetTextureResolution(8);
  filter->SetSamplesPerTexel(25);
  filter->SetEncoding(Filter::Float32Linear);
  filter->SetMethod(method);
  filter->SetIdArray(idArray);
  filter->SetInputData(data);
  filter->Update();
  EXPECT_EQ(filter->GetErrorCode(), 0u);
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

/// RMS over the texels of the static particles, point `placeOf(i)` of `b` being point i of `a`.
double difference(
  vtkPolyData* a, vtkPolyData* b,
  const std::function<vtkIdType(vtkIdType)>& placeOf = [](vtkIdType i) { return i; })
{
  const auto texel = [](vtkPolyData* data, vtkIdType point, int k)
  {
    const auto row = static_cast<vtkIdType>(
      data->GetPointData()->GetArray("AmbientOcclusionTexture")->GetComponent(point, 0));
    return data->GetFieldData()->GetArray("AmbientOcclusionTextures")->GetComponent(row, k);
  };
  double sum = 0;
  for (vtkIdType i = 0; i < Static; ++i)
  {
    for (int k = 0; k < 64; ++k)
    {
      sum += std::pow(texel(a, i, k) - texel(b, placeOf(i), k), 2);
    }
  }
  return std::sqrt(sum / (Static * 64));
}

std::string errorWith(vtkPolyData* data, const char* idArray)
{
  vtkNew<Filter> filter;
  filter->SetController(nullptr);
  filter->SetTextureResolution(2);
  filter->SetIdArray(idArray);
  filter->SetInputData(data);
  return errorOf(filter);
}
}

TEST(ParticleIds, WhatDoesNotMoveKeepsItsNoise)
{
  for (const int method : { Filter::Embree, Filter::Reference })
  {
    const auto change = [&](bool withIds)
    {
      return difference(
        bake(step(800, inOrder(), withIds), method), bake(step(803.7, inOrder(), withIds), method));
    };
    const double without = change(false);
    EXPECT_GT(without, 0.003) << method;
    EXPECT_LT(change(true), 0.2 * without) << method;
  }
}

TEST(ParticleIds, SweepNeedsNone)
{
  EXPECT_LT(difference(bake(step(800, inOrder(), false), Filter::Sweep),
              bake(step(803.7, inOrder(), false), Filter::Sweep)),
    0.001);
}

TEST(ParticleIds, ParticlesAreFollowedWhenOthersVanishAndTheirOrderChanges)
{
  const auto before = bake(step(800, inOrder()), Filter::Embree);
  std::vector<int> order = inOrder(Static); // without the far one
  std::reverse(order.begin(), order.end());
  const auto after = bake(step(0, order), Filter::Embree);
  EXPECT_LT(difference(before, after, [](vtkIdType i) { return Static - 1 - i; }), 0.001);
}

TEST(ParticleIds, RepeatedIdsAreNoFault)
{
  const auto data = step(800, inOrder());
  data->GetPointData()->GetArray("id")->Fill(7);
  const auto repeated = bake(data, Filter::Embree);
  // The error of a bake, not of something that went wrong.
  EXPECT_LT(difference(repeated, bake(data, Filter::Sweep)), 0.05);
  EXPECT_EQ(difference(repeated, bake(data, Filter::Embree)), 0);
}

TEST(ParticleIds, NoneMeansSeedsByPlace)
{
  const auto data = step(800, inOrder());
  const auto without = bake(step(800, inOrder(), false), Filter::Embree);
  EXPECT_EQ(difference(bake(data, Filter::Embree, "(none)"), without), 0);
  EXPECT_GT(difference(bake(data, Filter::Embree), without), 0);
  EXPECT_EQ(difference(bake(data, Filter::Embree, "id"), bake(data, Filter::Embree)), 0);
}

TEST(ParticleIds, AnArrayThatIsMissingOrOfAnotherShapeIsAnError)
{
  const auto data = step(800, inOrder());
  EXPECT_NE(
    errorWith(data, "number").find("IdArray: there is no point array 'number'"), std::string::npos);
  vtkNew<vtkDoubleArray> pairs;
  pairs->SetName("pairs");
  pairs->SetNumberOfComponents(2);
  pairs->SetNumberOfTuples(data->GetNumberOfPoints());
  pairs->Fill(0);
  data->GetPointData()->AddArray(pairs);
  EXPECT_NE(errorWith(data, "pairs").find("'pairs'"), std::string::npos);
  EXPECT_EQ(errorWith(data, "id"), "");
}
