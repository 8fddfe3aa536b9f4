// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParallelBakeTestSupport_h
#define po_ParallelBakeTestSupport_h

// Particles that several processes share, and how their bake differs from that of one alone.

#include "BakeFilterTestSupport.h"
#include "Random.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cmath>
#include <functional>

inline vtkMultiProcessController* processes()
{
  return vtkMultiProcessController::GetGlobalController();
}

inline int rank()
{
  return processes()->GetLocalProcessId();
}

inline int size()
{
  return processes()->GetNumberOfProcesses();
}

/// Which process a particle belongs to.
using Owner = std::function<int(vtkIdType)>;

inline int interleaved(vtkIdType i)
{
  return static_cast<int>(i % size());
}

/// Overlapping spheres of many sizes, far from the origin.
inline vtkSmartPointer<vtkPolyData> mixedCloud(int count, bool withRadii = true)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  po::Random random(11, 0, 0);
  const auto coordinate = [&] { return 1000 + std::cbrt(count) * random.uniform(); };
  for (int i = 0; i < count; ++i)
  {
    points->InsertNextPoint(coordinate(), coordinate(), coordinate());
    radii->InsertNextValue(0.1 + 0.5 * random.uniform());
  }
  data->SetPoints(points);
  if (withRadii)
  {
    data->GetPointData()->AddArray(radii);
  }
  return data;
}

/// A part of the particles in reverse order, with the numbers they have in the whole set.
inline vtkSmartPointer<vtkPolyData> part(
  vtkPolyData* whole, const std::function<bool(vtkIdType)>& keep)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName("number");
  vtkDataArray* radii = whole->GetPointData()->GetArray("radius");
  vtkNew<vtkDoubleArray> keptRadii;
  keptRadii->SetName("radius");
  for (vtkIdType i = whole->GetNumberOfPoints() - 1; i >= 0; --i)
  {
    if (keep(i))
    {
      points->InsertNextPoint(whole->GetPoint(i));
      numbers->InsertNextValue(i);
      keptRadii->InsertNextValue(radii ? radii->GetComponent(i, 0) : 0);
    }
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(numbers);
  if (radii)
  {
    data->GetPointData()->AddArray(keptRadii);
  }
  return data;
}

inline vtkSmartPointer<vtkPolyData> ownPart(vtkPolyData* whole, const Owner& owner)
{
  return part(whole, [&](vtkIdType i) { return owner(i) == rank(); });
}

/// Means and textures, value by value: the number of particles that differ, and the largest
/// difference.
struct Difference
{
  int particles = 0;
  double largest = 0;
};

inline Difference difference(vtkPolyData* whole, vtkPolyData* own)
{
  Difference found;
  vtkDataArray* numbers = own->GetPointData()->GetArray("number");
  vtkDataArray* wholeTable = whole->GetFieldData()->GetArray("AmbientOcclusionTextures");
  vtkDataArray* ownTable = own->GetFieldData()->GetArray("AmbientOcclusionTextures");
  const auto at = [](vtkPolyData* data, const char* name, vtkIdType i)
  { return data->GetPointData()->GetArray(name)->GetComponent(i, 0); };
  for (vtkIdType i = 0; i < own->GetNumberOfPoints(); ++i)
  {
    const auto number = static_cast<vtkIdType>(numbers->GetComponent(i, 0));
    double largest =
      std::abs(at(whole, "AmbientOcclusion", number) - at(own, "AmbientOcclusion", i));
    const auto wholeRow = static_cast<vtkIdType>(at(whole, "AmbientOcclusionTexture", number));
    const auto ownRow = static_cast<vtkIdType>(at(own, "AmbientOcclusionTexture", i));
    EXPECT_EQ(wholeRow < 0, ownRow < 0) << number;
    for (int k = 0; ownRow >= 0 && k < ownTable->GetNumberOfComponents(); ++k)
    {
      largest = std::max(largest,
        std::abs(wholeTable->GetComponent(wholeRow, k) - ownTable->GetComponent(ownRow, k)));
    }
    found.particles += largest > 0;
    found.largest = std::max(found.largest, largest);
  }
  return found;
}

using Prepare = std::function<void(vtkSphereAmbientOcclusion*)>;

/// @param together all processes, or this one by itself
inline vtkSmartPointer<vtkSphereAmbientOcclusion> bake(
  vtkPolyData* particles, bool together, const Prepare& prepare)
{
  auto filter = vtkSmartPointer<vtkSphereAmbientOcclusion>::New();
  filter->SetController(together ? processes() : nullptr);
  filter->SetTextureResolution(8);
  filter->SetEncoding(vtkSphereAmbientOcclusion::Float32Linear);
  filter->SetInputData(particles);
  prepare(filter);
  filter->Update();
  return filter;
}

inline vtkPolyData* output(vtkSphereAmbientOcclusion* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

inline Difference differenceFromAlone(
  vtkPolyData* whole, const Owner& owner, const Prepare& prepare)
{
  const auto alone = bake(whole, false, prepare);
  const auto together = bake(ownPart(whole, owner), true, prepare);
  EXPECT_EQ(together->GetNumberOfParticles(), alone->GetNumberOfParticles());
  EXPECT_EQ(together->GetNumberOfTexels(), alone->GetNumberOfTexels());
  EXPECT_EQ(together->GetNumberOfParticlesDark(), alone->GetNumberOfParticlesDark());
  EXPECT_EQ(together->GetNumberOfParticlesLeftOut(), alone->GetNumberOfParticlesLeftOut());
  EXPECT_EQ(together->GetNumberOfDirections(), alone->GetNumberOfDirections());
  EXPECT_STREQ(together->GetMethodUsed(), alone->GetMethodUsed());
  EXPECT_GT(alone->GetNumberOfTextures(), 10);
  return difference(output(alone), output(together));
}

#endif
