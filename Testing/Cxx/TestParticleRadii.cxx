// SPDX-License-Identifier: BSD-3-Clause
/// Radii of particles: from arrays of radii, diameters, elements and masses, and what is chosen
/// where the user says nothing.

#include "BakeFilterTestSupport.h"
#include "ElementRadii.h"
#include "ParticleRadii.h"
#include "SphereInput.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

namespace
{
using po::RadiusSettings;
using po::RadiusSource;

/// Particles 4 apart on a line.
vtkSmartPointer<vtkPolyData> line(int count)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  for (int i = 0; i < count; ++i)
  {
    points->InsertNextPoint(4.0 * i, 0, 0);
  }
  data->SetPoints(points);
  return data;
}

template <typename Array, typename Value>
void add(vtkPolyData* data, const char* name, std::initializer_list<Value> values)
{
  vtkNew<Array> array;
  array->SetName(name);
  for (const Value& value : values)
  {
    array->InsertNextValue(value);
  }
  data->GetPointData()->AddArray(array);
}

/// Radii in world units, in the order of the points; empty with the message in `error`.
std::vector<double> radiiBy(
  vtkPolyData* data, const RadiusSettings& settings, std::string& used, std::string& error)
{
  const auto input = po::readSphereCloud(*data, settings, error);
  std::vector<double> radii;
  if (input)
  {
    for (const po::Sphere& sphere : input->cloud.spheres)
    {
      radii.push_back(sphere.radius * input->cloud.scale);
    }
    used = po::describe(settings, input->radii);
  }
  return radii;
}

void expectRadii(vtkPolyData* data, const RadiusSettings& settings,
  const std::vector<double>& expected, const std::string& says)
{
  std::string used, error;
  const std::vector<double> radii = radiiBy(data, settings, used, error);
  ASSERT_EQ(radii.size(), expected.size()) << error;
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    EXPECT_NEAR(radii[i], expected[i], 1e-6 * expected[i]) << "particle " << i;
  }
  EXPECT_NE(used.find(says), std::string::npos) << "it says: " << used;
}

void expectError(vtkPolyData* data, const RadiusSettings& settings, const std::string& says)
{
  std::string used, error;
  EXPECT_TRUE(radiiBy(data, settings, used, error).empty());
  EXPECT_NE(error.find(says), std::string::npos) << "the message was: " << error;
}

RadiusSettings from(RadiusSource source, const char* array = "")
{
  RadiusSettings settings;
  settings.array = array;
  settings.from = source;
  return settings;
}

TEST(ElementRadii, AreThoseOfBondiAndMantina)
{
  EXPECT_EQ(po::vanDerWaalsRadius(1), 1.20);
  EXPECT_EQ(po::vanDerWaalsRadius(6), 1.70);
  EXPECT_EQ(po::vanDerWaalsRadius(7), 1.55);
  EXPECT_EQ(po::vanDerWaalsRadius(8), 1.52);
  EXPECT_EQ(po::vanDerWaalsRadius(16), 1.80);
  EXPECT_EQ(po::vanDerWaalsRadius(20), 2.31); // of Mantina et al.
  EXPECT_EQ(po::vanDerWaalsRadius(26), 2.00); // nobody's
  EXPECT_EQ(po::vanDerWaalsRadius(92), 1.86);
  EXPECT_EQ(po::vanDerWaalsRadius(118), 2.00);
  EXPECT_TRUE(std::isnan(po::vanDerWaalsRadius(0)));
  EXPECT_TRUE(std::isnan(po::vanDerWaalsRadius(119)));
  EXPECT_TRUE(std::isnan(po::vanDerWaalsRadius(-1)));
}

TEST(ElementRadii, SymbolsAreReadAsFilesHaveThem)
{
  // Numbers of elements that lie far apart in the table pin its order.
  const std::vector<std::pair<const char*, int>> symbols{ { "H", 1 }, { "Ne", 10 }, { "Ca", 20 },
    { "Zn", 30 }, { "Zr", 40 }, { "Sn", 50 }, { "Nd", 60 }, { "Yb", 70 }, { "Hg", 80 },
    { "Th", 90 }, { "Fm", 100 }, { "Ds", 110 }, { "Og", 118 }, { "fe", 26 }, { "FE", 26 },
    { " C ", 6 }, { "C12", 6 }, { "Na+", 11 }, { "Fe3+", 26 }, { "", 0 }, { "X", 0 }, { "12", 0 },
    { "Qq", 0 } };
  for (const auto& [symbol, number] : symbols)
  {
    EXPECT_EQ(po::atomicNumberOf(symbol), number) << "'" << symbol << "'";
  }
}

TEST(ParticleRadii, OfElements)
{
  const auto data = line(4);
  add<vtkStringArray, const char*>(data, "species", { "O", "H", "h1", "Fe2+" });
  const std::vector<double> expected{ 1.52, 1.20, 1.20, 2.0 };
  expectRadii(
    data, from(RadiusSource::Element, "species"), expected, "elements in point array species");
  add<vtkIntArray, int>(data, "atom_type", { 8, 1, 1, 26 });
  expectRadii(data, from(RadiusSource::Element, "atom_type"), expected, "atom_type");
  // Nothing is said, and there are no radii: the elements that a reader of molecules gives.
  expectRadii(data, {}, expected, "van der Waals");
  RadiusSettings constant;
  constant.constant = 0.5;
  expectRadii(data, constant, { 0.5, 0.5, 0.5, 0.5 }, "0.5 for all");
  // Three radii a particle, as ParaView's PDB reader gives them, are no radii.
  vtkNew<vtkDoubleArray> triples;
  triples->SetName("radius");
  triples->SetNumberOfComponents(3);
  triples->SetNumberOfTuples(4);
  triples->Fill(7);
  data->GetPointData()->AddArray(triples);
  expectRadii(data, {}, expected, "atom_type");
  // Radii go before elements.
  add<vtkDoubleArray, double>(data, "rad", { 1, 2, 1, 2 });
  expectRadii(data, {}, { 1, 2, 1, 2 }, "point array rad");
}

TEST(ParticleRadii, WhatIsNoElementIsLeftOut)
{
  const auto data = line(3);
  add<vtkStringArray, const char*>(data, "element", { "C", "Xx", "N" });
  std::string error;
  const auto input = po::readSphereCloud(*data, from(RadiusSource::Element), error);
  ASSERT_TRUE(input) << error;
  EXPECT_EQ(input->cloud.spheres.size(), 2u);
  EXPECT_EQ(input->cloud.rejected.nonFiniteRadius, 1u);
}

TEST(ParticleRadii, OfDiameters)
{
  const auto data = line(2);
  add<vtkDoubleArray, double>(data, "size", { 3, 1 });
  expectRadii(data, from(RadiusSource::Diameter, "size"), { 1.5, 0.5 }, "half of point array size");
  add<vtkDoubleArray, double>(data, "d", { 1, 2 });
  expectRadii(data, from(RadiusSource::Diameter), { 0.5, 1 }, "half of point array d");
  add<vtkDoubleArray, double>(data, "diameter", { 4, 2 });
  expectRadii(data, from(RadiusSource::Diameter), { 2, 1 }, "half of point array diameter");
  expectRadii(data, {}, { 2, 1 }, "half of point array diameter"); // by its name
}

TEST(ParticleRadii, OfMassesAndADensity)
{
  const auto data = line(2);
  constexpr double Pi = 3.14159265358979323846;
  add<vtkDoubleArray, double>(data, "mass", { 2.5 * 4 * Pi / 3, 2.5 * 36 * Pi });
  RadiusSettings settings = from(RadiusSource::Mass);
  settings.density = 2.5;
  expectRadii(data, settings, { 1, 3 }, "density 2.5");
  settings.scale = 2;
  expectRadii(data, settings, { 2, 6 }, "times 2");
  settings.density = 0;
  expectError(data, settings, "Density must be a positive number");
}

TEST(ParticleRadii, AnEstimateSaysSo)
{
  expectRadii(line(5), {}, { 2, 2, 2, 2, 2 }, "2 for all, estimated from the spacing");
}

TEST(ParticleRadii, ErrorsNameWhatIsMissing)
{
  const auto data = line(2);
  add<vtkStringArray, const char*>(data, "name", { "qa", "qb" });
  expectError(data, from(RadiusSource::Element), "known for elements (element, atom_type");
  expectError(data, from(RadiusSource::Mass),
    "known for masses (mass, Mass, m): choose one. "
    "The point arrays of the input are: name.");
  expectError(data, from(RadiusSource::Diameter, "name"), "is not numeric");
  expectError(data, from(static_cast<RadiusSource>(4)), "RadiusFrom must be between");
  expectError(data, from(RadiusSource::Element, "name"), "No particle is usable");
}

TEST(ParticleRadii, OfAnUnstructuredGrid)
{
  // The points of any point set are particles, whatever its cells are: the same bake.
  const auto particles = lattice(3);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(particles->GetPoints());
  grid->GetPointData()->ShallowCopy(particles->GetPointData());
  vtkNew<vtkSphereAmbientOcclusion> ofGrid, ofParticles;
  ofGrid->SetInputData(grid);
  ofParticles->SetInputData(particles);
  EXPECT_EQ(errorOf(ofGrid), "");
  EXPECT_EQ(errorOf(ofParticles), "");
  EXPECT_STREQ(ofGrid->GetRadiusUsed(), "point array radius");
  auto* baked = vtkUnstructuredGrid::SafeDownCast(ofGrid->GetOutputDataObject(0));
  ASSERT_TRUE(baked);
  EXPECT_TRUE(baked->GetFieldData()->HasArray("AmbientOcclusionTextures"));
  auto* means = baked->GetPointData()->GetArray("AmbientOcclusion");
  auto* expected = vtkPolyData::SafeDownCast(ofParticles->GetOutput())
                     ->GetPointData()
                     ->GetArray("AmbientOcclusion");
  ASSERT_TRUE(means);
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(means->GetComponent(i, 0), expected->GetComponent(i, 0));
  }
}
}
