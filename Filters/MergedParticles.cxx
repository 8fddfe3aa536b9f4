// SPDX-License-Identifier: BSD-3-Clause
#include "MergedParticles.h"

#include "BakedArrays.h"
#include "Blocks.h"
#include "Gamma2.h"
#include "OcclusionParameters.h"
#include "TableViews.h"

#include "vtkAppendPolyData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace po
{
namespace
{
/// One block's part of a merged table.
struct Part
{
  BakedTextures baked;
  TableFormat format;
  vtkIdType points = 0;
};

void appendRows(const Part& part, std::int32_t offset, vtkIntArray* merged)
{
  for (vtkIdType i = 0; i < part.points; ++i)
  {
    const int row = part.baked.rows ? static_cast<int>(part.baked.rows->GetComponent(i, 0)) : -1;
    merged->InsertNextValue(row < 0 ? -1 : row + offset);
  }
}

vtkSmartPointer<vtkDataArray> decodedTable(const Part& part)
{
  if (!part.format.bytes)
  {
    return part.baked.table;
  }
  auto decoded = vtkSmartPointer<vtkFloatArray>::New();
  decoded->SetNumberOfComponents(part.baked.table->GetNumberOfComponents());
  decoded->SetNumberOfTuples(part.baked.table->GetNumberOfTuples());
  const auto* bytes = static_cast<const std::uint8_t*>(part.baked.table->GetVoidPointer(0));
  std::transform(bytes, bytes + decoded->GetNumberOfValues(), decoded->GetPointer(0),
    [&](std::uint8_t byte) { return static_cast<float>(decodeGamma2(byte, part.format.maximum)); });
  return decoded;
}

/// Textures of different lengths at T x T texels; the part's rows follow.
vtkSmartPointer<vtkDataArray> expandedTable(Part& part)
{
  const ExpandedRows expanded = expandRows(part.baked);
  auto table = vtkSmartPointer<vtkFloatArray>::New();
  const int texels = part.format.resolution * part.format.resolution;
  table->SetNumberOfComponents(texels);
  table->SetNumberOfTuples(static_cast<vtkIdType>(expanded.firsts.size()));
  for (std::size_t row = 0; row < expanded.firsts.size(); ++row)
  {
    part.baked.packed->decode(
      expanded.firsts[row], table->GetPointer(static_cast<vtkIdType>(row) * texels));
  }
  vtkNew<vtkIntArray> rows;
  rows->SetNumberOfTuples(part.points);
  std::copy(expanded.rows.begin(), expanded.rows.end(), rows->GetPointer(0));
  part.baked.rows = rows;
  return table;
}

/// The same particles with a table of floats.
void decode(Part& part)
{
  if (!part.baked.table)
  {
    return;
  }
  part.baked.table = part.baked.packed ? expandedTable(part) : decodedTable(part);
  part.baked.packed.reset();
}

bool sameFormat(const std::vector<Part>& parts, const TableFormat& format)
{
  return std::all_of(parts.begin(), parts.end(),
    [&](const Part& part) { return !part.baked.table || part.format == format; });
}

std::vector<vtkDataArray*> tablesOf(const std::vector<Part>& parts)
{
  std::vector<vtkDataArray*> tables;
  for (const Part& part : parts)
  {
    if (part.baked.table)
    {
      tables.push_back(part.baked.table);
    }
  }
  return tables;
}

/// Throws std::runtime_error if the tables do not fit each other.
void requireOneTable(const std::vector<Part>& parts, int resolution)
{
  vtkIdType rows = 0;
  for (const Part& part : parts)
  {
    if (part.baked.table && part.format.resolution != resolution)
    {
      refuseBakedArray(TextureTableArray, "has another resolution in some blocks");
    }
    rows += part.baked.table ? part.baked.table->GetNumberOfTuples() : 0;
  }
  if (rows > std::numeric_limits<std::int32_t>::max())
  {
    refuseBakedArray(
      TextureTableArray, "has more rows than 32-bit indices reach when blocks are merged");
  }
}

/// Tables of one type, one after the other; at least one.
vtkSmartPointer<vtkDataArray> joinTables(const std::vector<vtkDataArray*>& tables)
{
  if (auto joined = joinViews(tables))
  {
    return joined;
  }
  auto copy = vtkSmartPointer<vtkDataArray>::Take(tables.front()->NewInstance());
  copy->SetName(TextureTableArray);
  copy->SetNumberOfComponents(tables.front()->GetNumberOfComponents());
  for (vtkDataArray* table : tables)
  {
    copy->InsertTuples(copy->GetNumberOfTuples(), table->GetNumberOfTuples(), 0, table);
  }
  return copy;
}

/// The rows of all points in the joined table.
vtkSmartPointer<vtkIntArray> joinRows(const std::vector<Part>& parts, vtkIdType points)
{
  auto rows = vtkSmartPointer<vtkIntArray>::New();
  rows->SetName(TextureIndexArray);
  rows->Allocate(points);
  vtkIdType offset = 0;
  for (const Part& part : parts)
  {
    appendRows(part, static_cast<std::int32_t>(offset), rows);
    offset += part.baked.table ? part.baked.table->GetNumberOfTuples() : 0;
  }
  return rows;
}

/// Puts the tables of all parts one after the other; throws std::runtime_error if they do not fit.
void attachMergedTable(std::vector<Part>& parts, vtkFieldData* parameters, vtkPolyData* merged)
{
  const auto first = std::find_if(
    parts.begin(), parts.end(), [](const Part& part) { return part.baked.table != nullptr; });
  if (first == parts.end())
  {
    return;
  }
  requireOneTable(parts, first->format.resolution);
  const bool asTheyAre = sameFormat(parts, first->format);
  if (!asTheyAre)
  {
    std::for_each(parts.begin(), parts.end(), decode);
  }
  OcclusionParameters description = OcclusionParameters::fromFieldData(parameters);
  if (std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.baked.hasLight; }))
  {
    description.set(BakedLightParameter, true);
  }
  if (!asTheyAre)
  {
    description.set("encoding", Float32Linear);
    description.set("storage", FullStorage);
  }
  else if (vtkDataArray* basis = parameters->GetArray(TextureBasisArray))
  {
    merged->GetFieldData()->AddArray(basis);
  }
  description.toFieldData(merged->GetFieldData());
  merged->GetFieldData()->AddArray(joinTables(tablesOf(parts)));
  merged->GetPointData()->AddArray(joinRows(parts, merged->GetNumberOfPoints()));
}

vtkSmartPointer<vtkPolyData> appendPoints(const std::vector<vtkPointSet*>& blocks)
{
  vtkNew<vtkAppendPolyData> append;
  for (vtkPointSet* block : blocks)
  {
    append->AddInputData(withoutCells(*block));
  }
  append->Update();
  return append->GetOutput();
}

void removeTextures(vtkPolyData& data)
{
  data.GetPointData()->RemoveArray(TextureIndexArray);
  data.GetFieldData()->RemoveArray(TextureTableArray);
  data.GetFieldData()->RemoveArray(TextureBasisArray);
  data.GetFieldData()->RemoveArray(ParametersArray);
}
}

vtkSmartPointer<vtkPolyData> mergeParticles(
  const std::vector<vtkPointSet*>& blocks, std::string& warning)
{
  warning.clear();
  if (blocks.size() == 1)
  {
    auto single = withoutCells(*blocks.front());
    single->GetFieldData()->ShallowCopy(blocks.front()->GetFieldData());
    return single;
  }
  auto merged = blocks.empty() ? vtkSmartPointer<vtkPolyData>::New() : appendPoints(blocks);
  merged->GetPointData()->RemoveArray(TextureIndexArray);
  try
  {
    std::vector<Part> parts;
    vtkFieldData* parameters = nullptr;
    for (vtkPointSet* block : blocks)
    {
      Part part;
      part.baked = readArrays(*block, part.format);
      part.points = block->GetNumberOfPoints();
      parameters = part.baked.table ? block->GetFieldData() : parameters;
      parts.push_back(part);
    }
    attachMergedTable(parts, parameters, merged);
  }
  catch (const std::runtime_error& error)
  {
    warning = error.what();
    removeTextures(*merged);
  }
  return merged;
}
}
