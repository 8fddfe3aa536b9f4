// SPDX-License-Identifier: BSD-3-Clause
#include "CropSettings.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// One component, or the magnitude, of an array that is cut into blocks.
class BlockValues
{
public:
  void add(vtkDataArray* array, int component)
  {
    const bool isScalar = array->GetNumberOfComponents() == 1;
    parts_.push_back({ array, isScalar ? 0 : component });
    count_ += array->GetNumberOfTuples();
    ends_.push_back(count_);
  }

  [[nodiscard]] double operator()(std::int64_t point) const
  {
    const auto end = std::upper_bound(ends_.begin(), ends_.end(), point);
    const auto block = static_cast<std::size_t>(end - ends_.begin());
    const auto& [array, component] = parts_[block];
    const vtkIdType tuple = point - (*end - array->GetNumberOfTuples());
    return component < 0 ? magnitude(array, tuple) : array->GetComponent(tuple, component);
  }

private:
  struct Part
  {
    vtkDataArray* array;
    int component;
  };

  std::vector<Part> parts_;
  std::vector<std::int64_t> ends_;
  std::int64_t count_ = 0;
};

/// Nothing, and a warning, if a block lacks the array.
std::optional<BlockValues> valuesOf(
  const std::vector<vtkPointSet*>& blocks, const CropRange& range, std::string& warning)
{
  BlockValues values;
  for (vtkPointSet* block : blocks)
  {
    if (block->GetNumberOfPoints() == 0)
    {
      continue;
    }
    vtkDataArray* array = block->GetPointData()->GetArray(range.array.c_str());
    if (!array || range.component < -1 || range.component >= array->GetNumberOfComponents())
    {
      warning = "Particles cannot be cropped by component " + std::to_string(range.component) +
        " of the point array \"" + range.array +
        "\": there is no such thing. Numeric arrays: " + arraysOf(*block->GetPointData()) + ".";
      return std::nullopt;
    }
    values.add(array, range.component);
  }
  return values;
}

/// Along the axes.
void addBox(const Vec3d& origin, const Vec3d& size, std::vector<CropPlane>& planes)
{
  const Vec3d axes[] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (const Vec3d& axis : axes)
  {
    planes.push_back({ origin, axis });
    planes.push_back({ origin + dot(axis, size) * axis, -axis });
  }
}
}

std::vector<CropRange> rangesOf(const CropSettings& settings)
{
  std::vector<CropRange> ranges;
  if (!settings.range.array.empty())
  {
    ranges.push_back(settings.range);
  }
  ranges.insert(ranges.end(), settings.moreRanges.begin(), settings.moreRanges.end());
  return ranges;
}

std::vector<CropPlane> planesOf(const CropSettings& settings)
{
  std::vector<CropPlane> planes;
  if (settings.plane)
  {
    planes.push_back({ settings.planeOrigin, settings.planeNormal });
  }
  if (settings.box)
  {
    addBox(settings.boxOrigin, settings.boxSize, planes);
  }
  return planes;
}

std::vector<ValueRange> valueRangesOf(const std::vector<vtkPointSet*>& blocks,
  const std::vector<CropRange>& ranges, std::string& warning)
{
  std::vector<ValueRange> result;
  for (const CropRange& range : ranges)
  {
    if (const auto values = valuesOf(blocks, range, warning))
    {
      result.push_back({ *values, range.low, range.high });
    }
  }
  return result;
}
}
