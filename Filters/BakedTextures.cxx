// SPDX-License-Identifier: BSD-3-Clause
#include "BakedTextures.h"

#include "BakedArrays.h"

#include "vtkDataArrayRange.h"
#include "vtkIntArray.h"
#include "vtkPointSet.h"

#include <stdexcept>
#include <unordered_map>

namespace po
{
namespace
{
OcclusionTextures makeTextures(const BakedTextures& baked, const TableFormat& format)
{
  const auto* means =
    static_cast<const float*>(baked.means ? baked.means->GetVoidPointer(0) : nullptr);
  if (!baked.table)
  {
    return OcclusionTextures(means);
  }
  const auto* rows = static_cast<const std::int32_t*>(baked.rows->GetVoidPointer(0));
  if (baked.packed)
  {
    return OcclusionTextures(baked.packed, format.resolution, rows, means);
  }
  const void* texels = baked.table->GetVoidPointer(0);
  return format.bytes
    ? OcclusionTextures(
        format.resolution, static_cast<const std::uint8_t*>(texels), format.maximum, rows, means)
    : OcclusionTextures(format.resolution, static_cast<const float*>(texels), rows, means);
}
}

ExpandedRows expandRows(const BakedTextures& baked)
{
  ExpandedRows expanded;
  std::unordered_map<int, std::int32_t> rowOfWord;
  for (const int word : vtk::DataArrayValueRange<1>(vtkIntArray::SafeDownCast(baked.rows)))
  {
    std::int32_t row = -1;
    if (word >= 0)
    {
      const auto next = static_cast<std::int32_t>(expanded.firsts.size());
      const auto [entry, isNew] = rowOfWord.emplace(word, next);
      row = entry->second;
      if (isNew)
      {
        expanded.firsts.push_back(static_cast<std::size_t>(word));
      }
    }
    expanded.rows.push_back(row);
  }
  return expanded;
}

BakedTextures readBakedTextures(vtkPointSet& points, std::string& warning)
{
  warning.clear();
  try
  {
    TableFormat format;
    BakedTextures baked = readArrays(points, format);
    baked.textures = makeTextures(baked, format);
    return baked;
  }
  catch (const std::runtime_error& error)
  {
    warning = error.what();
    return {};
  }
}
}
