// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryHash.h"

#include "Digest.h"
#include "Random.h"
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

/// A constant radius, so that none is estimated.
vtkDataArray* radiiOf(vtkPointSet& points, const std::string& radiusArray)
{
  const RadiusSettings radii = resolveRadii(points, { radiusArray, 1, 1 }, ProcessGroup::alone());
  return points.GetPointData()->GetArray(radii.array.c_str());
}
}

std::string hashGeometry(vtkPointSet& points, const std::string& radiusArray)
{
  Digest digest;
  if (vtkPoints* positions = points.GetPoints())
  {
    addAsDoubles(digest, *positions->GetData());
  }
  if (vtkDataArray* radii = radiiOf(points, radiusArray))
  {
    addAsDoubles(digest, *radii);
  }
  return digest.text();
}

std::vector<PlaceHash> placeHashes(vtkPointSet& points, const std::string& radiusArray)
{
  vtkDataArray* radii = radiiOf(points, radiusArray);
  std::vector<PlaceHash> hashes(static_cast<std::size_t>(points.GetNumberOfPoints()));
  for (std::size_t i = 0; i < hashes.size(); ++i)
  {
    const auto point = static_cast<vtkIdType>(i);
    std::array<double, 4> numbers{};
    points.GetPoint(point, numbers.data());
    numbers[3] = radii ? radii->GetComponent(point, 0) : 0;
    std::uint64_t hash = 0;
    for (const double number : numbers)
    {
      hash = mixBits(hash + 0x9E3779B97F4A7C15ull + wordOf(number + 0.0)); // one zero, not two
    }
    hashes[i] = { static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(hash >> 32) };
  }
  return hashes;
}
}
