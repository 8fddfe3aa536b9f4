// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryHash.h"

#include "Digest.h"
#include "SphereInput.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <vector>

namespace po
{
namespace
{
/// In pieces, so that no second copy of an array is held.
void addAsDoubles(Digest& digest, vtkDataArray& array)
{
  constexpr vtkIdType Piece = 1 << 16;
  const int components = array.GetNumberOfComponents();
  std::vector<double> numbers;
  for (vtkIdType first = 0; first < array.GetNumberOfTuples(); first += Piece)
  {
    const vtkIdType count = std::min(Piece, array.GetNumberOfTuples() - first);
    numbers.resize(static_cast<std::size_t>(count * components));
    for (vtkIdType i = 0; i < count; ++i)
    {
      array.GetTuple(first + i, numbers.data() + i * components);
    }
    digest.add(numbers);
  }
}
}

std::string hashGeometry(vtkPointSet& points, const std::string& radiusArray)
{
  Digest digest;
  if (vtkPoints* positions = points.GetPoints())
  {
    addAsDoubles(digest, *positions->GetData());
  }
  // A constant radius, so that none is estimated.
  const RadiusSettings radii = resolveRadii(points, { radiusArray, 1, 1 }, ProcessGroup::alone());
  if (vtkDataArray* array = points.GetPointData()->GetArray(radii.array.c_str()))
  {
    addAsDoubles(digest, *array);
  }
  return digest.text();
}
}
