// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeFilterTestSupport_h
#define po_BakeFilterTestSupport_h

// Small inputs for vtkSphereAmbientOcclusion and short ways to look at what it did.

#include "VTKErrors.h"

#include "vtkSphereAmbientOcclusion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <string>

/// n x n x n spheres that touch, with a point array of radii.
inline vtkSmartPointer<vtkPolyData> lattice(
  int n, const char* arrayName = "radius", double shift = 0)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName(arrayName);
  for (int i = 0; i < n * n * n; ++i)
  {
    points->InsertNextPoint(shift + i % n, i / n % n, i / (n * n));
    radii->InsertNextValue(0.5);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

inline vtkDoubleArray* radiiOf(vtkPolyData* data)
{
  return vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray("radius"));
}

inline std::string parameter(vtkFieldData* field, const std::string& key)
{
  auto* strings =
    vtkStringArray::SafeDownCast(field->GetAbstractArray("AmbientOcclusionParameters"));
  for (vtkIdType i = 0; strings && i < strings->GetNumberOfValues(); ++i)
  {
    const std::string entry = strings->GetValue(i);
    if (entry.compare(0, key.size() + 1, key + "=") == 0)
    {
      return entry.substr(key.size() + 1);
    }
  }
  return "(missing)";
}

/// The one error of executing the filter, "" if there is none.
inline std::string errorOf(vtkSphereAmbientOcclusion* filter)
{
  ErrorCatcher errors(filter);
  filter->Update();
  EXPECT_LE(errors.count(), 1);
  return errors.text();
}

#endif
