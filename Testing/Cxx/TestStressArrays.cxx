// SPDX-License-Identifier: BSD-3-Clause
/// Arrays of every kind into the filter, and ways to cut the same particles.

#include "BakeFilterTestSupport.h"

#include "vtkCharArray.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <limits>
#include <vector>

namespace
{
/// The mean values of a bake with the default method, by point.
std::vector<float> meansOf(
  vtkPolyData* input, int method = vtkSphereAmbientOcclusion::Sweep, int samples = 0)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(input);
  filter->SetTextureResolution(4);
  filter->SetMethod(method);
  if (samples > 0)
  {
    filter->SetSamplesPerTexel(samples);
  }
  EXPECT_EQ(errorOf(filter), "");
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  vtkDataArray* means = output->GetPointData()->GetArray("AmbientOcclusion");
  std::vector<float> values;
  for (vtkIdType i = 0; means && i < means->GetNumberOfTuples(); ++i)
  {
    values.push_back(static_cast<float>(means->GetComponent(i, 0)));
  }
  return values;
}

/// The lattice, its points 2 apart and its radii 1, both of any type.
vtkSmartPointer<vtkPolyData> latticeOf(vtkDataArray* radii, int pointType)
{
  vtkSmartPointer<vtkPolyData> data = lattice(3);
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  radii->SetName("radius");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double* p = data->GetPoint(i);
    points->InsertNextPoint(2 * p[0], 2 * p[1], 2 * p[2]);
    radii->InsertNextTuple1(1);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

TEST(StressArrays, TypesOfNumbersMakeNoDifference)
{
  vtkNew<vtkDoubleArray> doubles;
  const std::vector<float> expected = meansOf(latticeOf(doubles, VTK_DOUBLE));
  ASSERT_EQ(expected.size(), 27u);
  const std::vector<vtkSmartPointer<vtkDataArray>> arrays{ vtkSmartPointer<vtkFloatArray>::New(),
    vtkSmartPointer<vtkIntArray>::New(), vtkSmartPointer<vtkTypeInt64Array>::New(),
    vtkSmartPointer<vtkIdTypeArray>::New(), vtkSmartPointer<vtkCharArray>::New(),
    vtkSmartPointer<vtkUnsignedCharArray>::New() };
  for (vtkDataArray* radii : arrays)
  {
    for (const int points : { VTK_FLOAT, VTK_DOUBLE, VTK_INT, VTK_LONG_LONG })
    {
      radii->Initialize();
      EXPECT_EQ(meansOf(latticeOf(radii, points)), expected)
        << radii->GetClassName() << " " << points;
    }
  }
}

TEST(StressArrays, WideIntegersAreReadAsWhatTheyAre)
{
  // Radii of 2^40 at points 2^41 apart: no 32-bit number holds them.
  vtkNew<vtkTypeInt64Array> radii;
  vtkSmartPointer<vtkPolyData> data = latticeOf(radii, VTK_DOUBLE);
  const std::vector<float> expected = meansOf(data);
  constexpr double unit = 1099511627776.0;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    data->GetPoints()->SetPoint(i, unit * p[0], unit * p[1], unit * p[2]);
    radii->SetValue(i, vtkTypeInt64(1) << 40);
  }
  data->Modified();
  EXPECT_EQ(meansOf(data), expected);
}

TEST(StressArrays, IdsOf64BitsPassThrough)
{
  vtkSmartPointer<vtkPolyData> data = lattice(2);
  vtkNew<vtkTypeInt64Array> ids;
  ids->SetName("id");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    ids->InsertNextValue(std::numeric_limits<vtkTypeInt64>::max() - i);
  }
  data->GetPointData()->AddArray(ids);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(data);
  EXPECT_EQ(errorOf(filter), "");
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  auto* after = vtkTypeInt64Array::SafeDownCast(output->GetPointData()->GetArray("id"));
  ASSERT_TRUE(after);
  EXPECT_EQ(after->GetValue(7), std::numeric_limits<vtkTypeInt64>::max() - 7);
}

/// Unless it was asked for by name such an array is passed over, as one that happens to have it.
TEST(StressArrays, ArraysOfSeveralComponentsAreRefusedByName)
{
  for (const int components : { 2, 3 })
  {
    vtkSmartPointer<vtkPolyData> data = lattice(2);
    vtkNew<vtkDoubleArray> radii;
    radii->SetName("radius");
    radii->SetNumberOfComponents(components);
    radii->SetNumberOfTuples(8);
    radii->Fill(1);
    data->GetPointData()->AddArray(radii);
    vtkNew<vtkSphereAmbientOcclusion> filter;
    filter->SetInputData(data);
    EXPECT_EQ(errorOf(filter), "");
    EXPECT_EQ(std::string(filter->GetRadiusUsed()).find("radius"), std::string::npos)
      << filter->GetRadiusUsed();
    filter->SetRadiusArray("radius");
    const std::string error = errorOf(filter);
    EXPECT_NE(error.find("'radius' has " + std::to_string(components)), std::string::npos) << error;
  }
}

/// The lattice in pieces of its points, with empty ones between.
vtkSmartPointer<vtkMultiBlockDataSet> pieces(vtkPolyData* whole, unsigned count)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned piece = 0; piece < count; ++piece)
  {
    vtkNew<vtkPolyData> part;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> radii;
    radii->SetName("radius");
    const vtkIdType last = (piece + 1) * whole->GetNumberOfPoints() / count;
    for (vtkIdType i = piece * whole->GetNumberOfPoints() / count; i < last; ++i)
    {
      points->InsertNextPoint(whole->GetPoint(i));
      radii->InsertNextValue(radiiOf(whole)->GetValue(i));
    }
    part->SetPoints(points);
    part->GetPointData()->AddArray(radii);
    blocks->SetBlock(2 * piece, part);
    vtkNew<vtkPolyData> empty;
    blocks->SetBlock(2 * piece + 1, empty);
  }
  return blocks;
}

TEST(StressArrays, BlocksAndEmptyPiecesMakeNoDifference)
{
  vtkSmartPointer<vtkPolyData> whole = lattice(4);
  for (const int method : { vtkSphereAmbientOcclusion::Sweep, vtkSphereAmbientOcclusion::Embree,
         vtkSphereAmbientOcclusion::Reference })
  {
    const std::vector<float> expected = meansOf(whole, method);
    for (const unsigned count : { 1u, 3u, 10u })
    {
      vtkNew<vtkSphereAmbientOcclusion> filter;
      filter->SetInputData(pieces(whole, count));
      filter->SetTextureResolution(4);
      filter->SetMethod(method);
      EXPECT_EQ(errorOf(filter), "");
      auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
      std::size_t point = 0;
      for (unsigned piece = 0; piece < count; ++piece)
      {
        auto* part = vtkPolyData::SafeDownCast(output->GetBlock(2 * piece));
        vtkDataArray* means = part->GetPointData()->GetArray("AmbientOcclusion");
        ASSERT_TRUE(means);
        for (vtkIdType i = 0; i < means->GetNumberOfTuples(); ++i)
        {
          EXPECT_EQ(static_cast<float>(means->GetComponent(i, 0)), expected[point++]);
        }
      }
      EXPECT_EQ(point, expected.size());
    }
  }
}

TEST(StressArrays, CloudsWiderThanFloatsComeOutAsTheyWouldAlone)
{
  // Two lattices 1e9 radii apart: each particle sees its own neighbours alone. The random numbers
  // of Reference differ: of 2 x 16 x 400 unstratified rays the difference of two means would have a
  // standard deviation of 0.009 at most, and 54 exceed 3.4 of these with a probability of 0.04;
  // stratified ones leave less (measured: 0.013 at most).
  const vtkSmartPointer<vtkPolyData> near = lattice(3);
  const vtkSmartPointer<vtkPolyData> both = lattice(3);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->DeepCopy(near->GetPoints());
  for (vtkIdType i = 0; i < near->GetNumberOfPoints(); ++i)
  {
    double p[3];
    near->GetPoint(i, p);
    points->InsertNextPoint(p[0] + 5e8, p[1] - 2e8, p[2] + 1e8);
    radiiOf(both)->InsertNextValue(0.5);
  }
  both->SetPoints(points);
  for (const int method : { vtkSphereAmbientOcclusion::Sweep, vtkSphereAmbientOcclusion::Embree,
         vtkSphereAmbientOcclusion::Reference })
  {
    const std::vector<float> alone = meansOf(near, method, 400);
    const std::vector<float> together = meansOf(both, method, 400);
    ASSERT_EQ(together.size(), 2 * alone.size());
    for (std::size_t i = 0; i < together.size(); ++i)
    {
      EXPECT_NEAR(together[i], alone[i % alone.size()], 0.03) << method << " " << i;
    }
  }
}

TEST(StressArrays, OneParticleIsOpen)
{
  for (const int method : { vtkSphereAmbientOcclusion::Sweep, vtkSphereAmbientOcclusion::Embree,
         vtkSphereAmbientOcclusion::Reference })
  {
    EXPECT_EQ(meansOf(lattice(1), method), std::vector<float>(1, 1.0f));
  }
}
}
