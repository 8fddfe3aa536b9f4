// SPDX-License-Identifier: BSD-3-Clause
/// The second input of the baking filter: meshes and spheres that occlude but are not baked.

#include "BakeFilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr int Port = vtkSphereAmbientOcclusion::OccludersPort;

using Cell = std::vector<vtkIdType>;

vtkSmartPointer<vtkCellArray> cellsOf(std::initializer_list<Cell> cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const Cell& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

/// The corners of a huge square at z = -1/2, counter-clockwise, without cells.
vtkSmartPointer<vtkPolyData> groundPoints()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1e4, -1e4, -0.5);
  points->InsertNextPoint(1e4, -1e4, -0.5);
  points->InsertNextPoint(1e4, 1e4, -0.5);
  points->InsertNextPoint(-1e4, 1e4, -0.5);
  data->SetPoints(points);
  return data;
}

/// The ground as one quadrangle.
vtkSmartPointer<vtkPolyData> ground()
{
  auto data = groundPoints();
  data->SetPolys(cellsOf({ { 0, 1, 2, 3 } }));
  return data;
}

/// Points of radius 1/2 at these places.
vtkSmartPointer<vtkPolyData> spheresAt(std::initializer_list<std::vector<double>> places)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  for (const std::vector<double>& place : places)
  {
    points->InsertNextPoint(place.data());
    radii->InsertNextValue(0.5);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

vtkSmartPointer<vtkSphereAmbientOcclusion> filterFor(
  vtkDataObject* particles, vtkDataObject* occluders)
{
  auto filter = vtkSmartPointer<vtkSphereAmbientOcclusion>::New();
  filter->SetInputDataObject(0, particles);
  filter->SetInputDataObject(Port, occluders);
  filter->SetTextureResolution(8);
  filter->SetEncoding(vtkSphereAmbientOcclusion::Float32Linear);
  return filter;
}

vtkPolyData* bakedBy(vtkSphereAmbientOcclusion* filter)
{
  EXPECT_EQ(errorOf(filter), "");
  return vtkPolyData::SafeDownCast(filter->GetOutput());
}

double meanOf(vtkPolyData* baked, vtkIdType particle)
{
  vtkDataArray* mean = baked->GetPointData()->GetArray("AmbientOcclusion");
  return mean ? mean->GetComponent(particle, 0) : -1;
}

std::vector<double> textureOf(vtkPolyData* baked, vtkIdType particle)
{
  auto* table = vtkFloatArray::SafeDownCast(
    baked->GetFieldData()->GetAbstractArray("AmbientOcclusionTextures"));
  const auto row = static_cast<vtkIdType>(
    baked->GetPointData()->GetArray("AmbientOcclusionTexture")->GetComponent(particle, 0));
  std::vector<double> texture(static_cast<std::size_t>(table->GetNumberOfComponents()));
  table->GetTuple(row, texture.data());
  return texture;
}

/// Standard error of the mean over 64 texels of 49 rays, times 4, and the gap at the horizon.
constexpr double MeanTolerance = 4 * 0.5 / 56 + 1e-3;

TEST(OccluderInput, TheGroundTakesHalfTheSky)
{
  const auto particles = spheresAt({ { 0, 0, 0 } });
  const auto filter = filterFor(particles, ground());
  vtkPolyData* baked = bakedBy(filter);
  EXPECT_NEAR(meanOf(baked, 0), 0.5, MeanTolerance);
  const std::vector<double> texture = textureOf(baked, 0);
  EXPECT_GT(texture.front(), 0.9); // towards +z
  EXPECT_LT(texture.back(), 0.1);
  EXPECT_STREQ(filter->GetMethodUsed(), "Embree"); // of Automatic: Sweep knows no triangles
  EXPECT_EQ(parameter(baked->GetFieldData(), "method"), "Embree");
  EXPECT_EQ(parameter(baked->GetFieldData(), "occluderTriangles"), "2");
  EXPECT_EQ(parameter(baked->GetFieldData(), "occluderSpheres"), "0");
  EXPECT_EQ(baked->GetNumberOfPoints(), 1);
  EXPECT_EQ(baked->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetNumberOfParticles(), 1);
}

TEST(OccluderInput, TrianglesPolygonsAndStripsAreTheSameGround)
{
  const auto particles = spheresAt({ { 0, 0, 0 } });
  const std::vector<double> expected = textureOf(bakedBy(filterFor(particles, ground())), 0);
  const auto triangles = groundPoints();
  triangles->SetPolys(cellsOf({ { 0, 1, 2 }, { 3, 2, 0 } })); // one from each side
  const auto strip = groundPoints();
  strip->SetStrips(cellsOf({ { 1, 2, 0, 3 } }));
  const auto other = ground();
  other->SetVerts(cellsOf({ { 0 }, { 1 } })); // no spheres beside a mesh
  other->SetLines(cellsOf({ { 0, 2 } }));
  for (vtkPolyData* mesh : { triangles.Get(), strip.Get(), other.Get() })
  {
    const auto filter = filterFor(particles, mesh);
    EXPECT_EQ(textureOf(bakedBy(filter), 0), expected);
    EXPECT_EQ(parameter(filter->GetOutput()->GetFieldData(), "occluderTriangles"), "2");
  }
}

TEST(OccluderInput, AConcavePolygonLeavesItsNotchOpen)
{
  // An arrowhead below the sphere, whose notch a fan of triangles from its first corner would fill.
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 5, -1);
  points->InsertNextPoint(-1000, -1000, -1);
  points->InsertNextPoint(0, 4, -1);
  points->InsertNextPoint(1000, -1000, -1);
  data->SetPoints(points);
  data->SetPolys(cellsOf({ { 1, 2, 3, 0 } }));
  const auto filter = filterFor(spheresAt({ { 0, 0, 0 } }), data);
  EXPECT_GT(textureOf(bakedBy(filter), 0).back(), 0.9); // straight down
}

TEST(OccluderInput, UsesTheUnitsOfTheParticles)
{
  // The same scene far away and a thousand times larger; the texture may not change.
  const auto filter = filterFor(spheresAt({ { 0, 0, 0 } }), ground());
  const std::vector<double> expected = textureOf(bakedBy(filter), 0);
  const auto particles = spheresAt({ { 7e6, 0, -3e6 } });
  radiiOf(particles)->SetValue(0, 500);
  const auto far = ground();

  vtkNew<vtkPoints> moved;
  moved->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    double p[3];
    ground()->GetPoint(i, p);
    moved->InsertNextPoint(1000 * p[0] + 7e6, 1000 * p[1], 1000 * p[2] - 3e6);
  }
  far->SetPoints(moved);
  EXPECT_EQ(textureOf(bakedBy(filterFor(particles, far)), 0), expected);
}

TEST(OccluderInput, SpheresOccludeAsOnTheFirstInput)
{
  // The occluders lie inside the extent and have the mean radius, so that the local coordinates are
  // the same; they come last, so that the ids, and with them the random numbers, are too. Reference
  // and Embree must then give the same bits, Sweep the same up to its shortcuts (bias below 0.002).
  const auto all = spheresAt({ { 0, 0, 0 }, { 2, 2, 2 }, { 0, 2, 0 }, { 1, 1, 1 }, { 1.5, 1, 1 } });
  const auto particles = spheresAt({ { 0, 0, 0 }, { 2, 2, 2 }, { 0, 2, 0 } });
  const auto occluders = spheresAt({ { 1, 1, 1 }, { 1.5, 1, 1 } });
  for (const int method : { vtkSphereAmbientOcclusion::Reference, vtkSphereAmbientOcclusion::Embree,
         vtkSphereAmbientOcclusion::Sweep })
  {
    const auto whole = filterFor(all, nullptr);
    const auto part = filterFor(particles, occluders);
    whole->SetMethod(method);
    part->SetMethod(method);
    vtkPolyData* baked = bakedBy(part);
    ASSERT_EQ(baked->GetNumberOfPoints(), 3);
    EXPECT_EQ(part->GetNumberOfParticles(), 3);
    EXPECT_EQ(parameter(baked->GetFieldData(), "occluderSpheres"), "2");
    EXPECT_EQ(parameter(baked->GetFieldData(), "occluderTriangles"), "0");
    const double tolerance = method == vtkSphereAmbientOcclusion::Sweep ? 0.002 : 0;
    for (vtkIdType i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(meanOf(baked, i), meanOf(bakedBy(whole), i), tolerance) << i;
      if (tolerance == 0)
      {
        EXPECT_EQ(textureOf(baked, i), textureOf(bakedBy(whole), i)) << i;
      }
    }
  }
}

TEST(OccluderInput, TheirRadiiFollowTheRuleOfTheParticles)
{
  const auto particles = spheresAt({ { 0, 0, 0 } });
  const auto occluders = spheresAt({ { 0, 0, 2 } });
  const auto diameters = spheresAt({ { 0, 0, 2 } });
  diameters->GetPointData()->GetArray("radius")->SetName("diameter");
  const double expected = meanOf(bakedBy(filterFor(particles, occluders)), 0);
  EXPECT_LT(expected, 1);
  EXPECT_GT(meanOf(bakedBy(filterFor(particles, diameters)), 0), expected);
  const auto filter = filterFor(particles, occluders);
  filter->SetRadiusScale(1.5);
  EXPECT_LT(meanOf(bakedBy(filter), 0), expected);
}

TEST(OccluderInput, BlocksMayBeMeshesAndSpheres)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, ground());
  inner->SetBlock(1, spheresAt({ { 0, 0, 1 }, { 0, 0, 3 } }));
  blocks->SetBlock(0, inner);
  blocks->SetBlock(2, spheresAt({ { 0, 1, 1 } })); // block 1 is empty
  const auto filter = filterFor(spheresAt({ { 0, 0, 0 } }), blocks);
  vtkPolyData* baked = bakedBy(filter);
  EXPECT_EQ(parameter(baked->GetFieldData(), "occluderTriangles"), "2");
  EXPECT_EQ(parameter(baked->GetFieldData(), "occluderSpheres"), "3");
  EXPECT_LT(meanOf(baked, 0), 0.45);
}

TEST(OccluderInput, MayBeEmpty)
{
  const auto particles = lattice(2);
  const auto without = filterFor(particles, nullptr);
  const double expected = meanOf(bakedBy(without), 0);
  EXPECT_EQ(parameter(without->GetOutput()->GetFieldData(), "occluderTriangles"), "0");
  EXPECT_EQ(parameter(without->GetOutput()->GetFieldData(), "occluderSpheres"), "0");
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkMultiBlockDataSet> noBlocks;
  for (vtkDataObject* empty : std::initializer_list<vtkDataObject*>{ nothing, noBlocks })
  {
    const auto filter = filterFor(particles, empty);
    EXPECT_EQ(meanOf(bakedBy(filter), 0), expected);
    EXPECT_STREQ(filter->GetMethodUsed(), "Sweep");
  }
}

TEST(OccluderInput, ACompositeOutputHasTheParticlesOnly)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, spheresAt({ { 0, 0, 0 } }));
  blocks->SetBlock(1, spheresAt({ { 3, 0, 0 } }));
  const auto filter = filterFor(blocks, ground());
  EXPECT_EQ(errorOf(filter), "");
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->GetNumberOfBlocks(), 2u);
  EXPECT_EQ(output->GetNumberOfPoints(), 2);
}

TEST(OccluderInput, CountsTheTrianglesAndSpheresThatItLeavesOut)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  const auto mesh = groundPoints();
  mesh->GetPoints()->InsertNextPoint(NaN, 0, 0);
  mesh->SetPolys(cellsOf({ { 0, 1, 4 }, { 0, 1, 2, 3 }, { 0, 1, 2, 4 } })); // the last one is two
  blocks->SetBlock(0, mesh);
  const auto spheres = spheresAt({ { 0, 0, 5 }, { 0, NaN, 5 } });
  blocks->SetBlock(1, spheres);
  const auto line = groundPoints();
  line->SetLines(cellsOf({ { 0, 1 } }));
  blocks->SetBlock(2, line);
  const auto filter = filterFor(spheresAt({ { 0, 0, 0 } }), blocks);
  WarningCatcher warnings(filter);
  vtkPolyData* baked = bakedBy(filter);
  EXPECT_EQ(warnings.count(), 3);
  for (const char* says : { "Occluders: 3 triangles are left out",
         "Occluders: 1 particles are left out", "Occluders: 1 data sets of lines" })
  {
    EXPECT_NE(warnings.text().find(says), std::string::npos) << warnings.text();
  }
  EXPECT_EQ(parameter(baked->GetFieldData(), "occluderTriangles"), "2");
  EXPECT_EQ(parameter(baked->GetFieldData(), "occluderSpheres"), "1");
  EXPECT_EQ(filter->GetNumberOfParticlesLeftOut(), 0);
}

TEST(OccluderInput, ErrorsNameThePort)
{
  const auto expectError = [](vtkDataObject* occluders, const char* says,
                             const std::function<void(vtkSphereAmbientOcclusion*)>& set)
  {
    const auto filter = filterFor(lattice(2), occluders);
    set(filter);
    const std::string error = errorOf(filter);
    EXPECT_NE(error.find("Occluders"), std::string::npos) << error;
    EXPECT_NE(error.find(says), std::string::npos) << error;
    vtkPointData* passedOn = vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData();
    EXPECT_TRUE(passedOn->HasArray("radius"));
    EXPECT_FALSE(passedOn->HasArray("AmbientOcclusion"));
  };
  const auto nothing = [](vtkSphereAmbientOcclusion*) {};

  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 2);
  expectError(image, "vtkImageData", nothing);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(groundPoints()->GetPoints());
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, grid);
  expectError(blocks, "vtkUnstructuredGrid", nothing);

  vtkNew<vtkPolyData> lonePoint;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 9);
  lonePoint->SetPoints(points);
  expectError(lonePoint, "No radius can be estimated", nothing);
  const auto charged = spheresAt({ { 0, 0, 9 } });
  charged->GetPointData()->GetArray("radius")->SetName("charge");
  expectError(charged,
    "there is no point array 'radius'. The point arrays of the input are: charge",
    [](vtkSphereAmbientOcclusion* f) { f->SetRadiusArray("radius"); });
  const auto negative = spheresAt({ { 0, 0, 9 } });
  radiiOf(negative)->SetValue(0, -1);
  expectError(negative, "No particle is usable", nothing);
  expectError(ground(), "choose the Method Automatic or Embree",
    [](vtkSphereAmbientOcclusion* f) { f->SetMethod(vtkSphereAmbientOcclusion::Sweep); });
}
}
