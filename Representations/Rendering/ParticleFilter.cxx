// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleFilter.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>

namespace po
{
namespace
{
double magnitude(vtkDataArray* array, vtkIdType tuple)
{
  double sum = 0;
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double value = array->GetComponent(tuple, c);
    sum += value * value;
  }
  return std::sqrt(sum);
}

std::string arraysOf(vtkPointData& data)
{
  std::string names;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
  {
    const char* name = data.GetArray(i) ? data.GetArrayName(i) : nullptr;
    names += name ? (names.empty() ? "" : ", ") + std::string(name) : "";
  }
  return names.empty() ? "none" : names;
}
}

std::vector<HalfSpace> clippingPlanesOf(vtkMapper& mapper, vtkActor& actor)
{
  vtkNew<vtkMatrix4x4> matrix;
  actor.GetModelToWorldMatrix(matrix);
  const int count = mapper.GetClippingPlanes() ? mapper.GetClippingPlanes()->GetNumberOfItems() : 0;
  std::vector<HalfSpace> halfSpaces;
  for (int i = 0; i < count; ++i)
  {
    double plane[4];
    mapper.GetClippingPlaneInDataCoords(matrix, i, plane);
    halfSpaces.push_back({ { plane[0], plane[1], plane[2] }, plane[3] });
  }
  return halfSpaces;
}

std::vector<ValueRange> valueRangesOf(
  vtkPolyData& points, const std::vector<CropRange>& ranges, std::string& warning)
{
  std::vector<ValueRange> result;
  for (const CropRange& range : ranges)
  {
    vtkDataArray* array = points.GetPointData()->GetArray(range.array.c_str());
    if (!array || range.component < -1 || range.component >= array->GetNumberOfComponents())
    {
      warning = "Particles cannot be cropped by component " + std::to_string(range.component) +
        " of the point array \"" + range.array +
        "\": there is no such thing. Numeric arrays: " + arraysOf(*points.GetPointData()) + ".";
      continue;
    }
    const int component = array->GetNumberOfComponents() == 1 ? 0 : range.component;
    result.push_back({ [array, component](std::int64_t point)
      { return component < 0 ? magnitude(array, point) : array->GetComponent(point, component); },
      range.low, range.high });
  }
  return result;
}
}
