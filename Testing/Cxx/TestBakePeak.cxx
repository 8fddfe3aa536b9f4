// SPDX-License-Identifier: BSD-3-Clause
/// The most memory that a bake has at a time: bytes that its structures ask for, which depend on
/// nothing but the particles where one thread works.

#include "BakeFilterTestSupport.h"
#include "FaultInjection.h"
#include "SyntheticSpheres.h"

#include "vtkDataArray.h"

#include <tbb/global_control.h>

#include <gtest/gtest.h>

namespace
{
/// Spheres that mostly see the sky: every texture is one of its own.
vtkSmartPointer<vtkPolyData> gas(std::size_t count)
{
  const po::SyntheticSpheres spheres =
    po::makeSyntheticSpheres(*po::syntheticFamilyFromName("gas"), count, 1);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  for (std::size_t i = 0; i < spheres.radii.size(); ++i)
  {
    points->InsertNextPoint(spheres.centers[i].data());
    radii->InsertNextValue(spheres.radii[i]);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

TEST(BakePeak, OutOfCoreIsNearWhatABakeCannotDoWithout)
{
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const vtkSmartPointer<vtkPolyData> input = gas(60000);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(input);
  filter->SetMethod(vtkSphereAmbientOcclusion::Sweep);
  const auto mostBytes = [&](bool outOfCore)
  {
    filter->SetOutOfCore(outOfCore);
    filter->Modified();
    const CountedMemory counted;
    EXPECT_EQ(errorOf(filter), "");
    return static_cast<double>(CountedMemory::most());
  };
  const double inMemory = mostBytes(false);
  filter->GetOutputDataObject(0)->Initialize(); // or the old table would still be counted in
  const double outOfCore = mostBytes(true);
  // The table with rows and means, and spheres with a hierarchy of boxes (33 bytes in Embree).
  const double sum = static_cast<double>(filter->GetNumberOfTextureBytes()) + 60000 * (8 + 16 + 33);
  std::printf("%.1f MB, out of core %.1f, sum %.1f\n", inMemory / 1e6, outOfCore / 1e6, sum / 1e6);
  // Buffers that do not grow with the particles are a part of it in so small a set.
  EXPECT_LT(outOfCore, 1.5 * sum);
  EXPECT_GT(inMemory, 4 * sum);
}
}
