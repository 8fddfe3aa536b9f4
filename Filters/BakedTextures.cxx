// SPDX-License-Identifier: BSD-3-Clause
#include "BakedTextures.h"

#include "Blocks.h"
#include "Gamma2.h"
#include "OcclusionParameters.h"
#include "PackedArrays.h"

#include "vtkAppendPolyData.h"
#include "vtkDataArrayRange.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <unordered_map>

namespace po
{
namespace
{
/// What the parameters say about a table.
struct TableFormat
{
  int resolution = 0;
  bool bytes = false;
  double maximum = 1;
  std::optional<PackedFormat> packed; ///< of textures of different lengths
  bool hasLight = false;
};

bool operator==(const TableFormat& a, const TableFormat& b)
{
  return a.resolution == b.resolution && a.bytes == b.bytes &&
    (!a.bytes || a.maximum == b.maximum) && a.packed == b.packed;
}

[[noreturn]] void fail(const std::string& array, const std::string& what)
{
  throw std::runtime_error("The array '" + array + "' " + what +
    "; spheres are drawn without ambient occlusion. Bake again with Sphere Ambient Occlusion.");
}

/// The format of textures of different lengths, or nothing.
std::optional<PackedFormat> readPacked(const OcclusionParameters& parameters, vtkFieldData* fields)
{
  const std::string storage = parameters.has("storage") ? parameters.get("storage") : FullStorage;
  if (storage == FullStorage || storage == OneValueStorage)
  {
    return {};
  }
  if (storage != VariableSizeStorage && storage != CompressedStorage)
  {
    fail(ParametersArray, "names a storage that is not known ('" + storage + "')");
  }
  try
  {
    return packedFormatOf(parameters, fields);
  }
  catch (const std::exception& error)
  {
    fail(ParametersArray, std::string("does not describe the textures: ") + error.what());
  }
}

TableFormat readFormat(vtkFieldData* fields)
{
  const OcclusionParameters parameters = OcclusionParameters::fromFieldData(fields);
  TableFormat format;
  const long long resolution = parameters.getInteger("resolution");
  if (resolution < 1 || resolution > 4096)
  {
    fail(ParametersArray, "has a resolution out of range (" + std::to_string(resolution) + ")");
  }
  format.resolution = static_cast<int>(resolution);
  const std::string& encoding = parameters.get("encoding");
  format.bytes = encoding == UInt8Gamma2;
  if (!format.bytes && encoding != Float32Linear)
  {
    fail(ParametersArray, "names an encoding that is not known ('" + encoding + "')");
  }
  if (format.bytes)
  {
    format.maximum = parameters.getDouble("maximum");
    if (!(format.maximum >= 0) || !std::isfinite(format.maximum))
    {
      fail(ParametersArray, "has a maximum that is negative or not finite");
    }
  }
  format.packed = readPacked(parameters, fields);
  format.hasLight = parameters.hasBakedLight();
  if (format.packed && !format.bytes)
  {
    fail(ParametersArray, "names an encoding in which textures have one length");
  }
  return format;
}

/// The array as the type that the contract names; a copy if it has another.
template <typename Array>
vtkSmartPointer<vtkDataArray> as(vtkDataArray* array)
{
  if (Array::SafeDownCast(array))
  {
    return array;
  }
  auto copy = vtkSmartPointer<Array>::New();
  copy->DeepCopy(array);
  return copy;
}

void checkPerPoint(vtkDataArray* array, const std::string& name, vtkIdType points)
{
  if (!array)
  {
    fail(name, "is missing although there are textures, or is not numeric");
  }
  if (array->GetNumberOfComponents() != 1)
  {
    fail(name, "has " + std::to_string(array->GetNumberOfComponents()) + " components, not one");
  }
  if (array->GetNumberOfTuples() != points)
  {
    fail(name,
      "has " + std::to_string(array->GetNumberOfTuples()) + " values for " +
        std::to_string(points) + " points");
  }
}

void checkTable(vtkDataArray* table, const TableFormat& format)
{
  const bool typeFits = table->GetDataType() == (format.bytes ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
  if (!typeFits)
  {
    fail(TextureTableArray, "is not of the type that its encoding asks for");
  }
  if (format.packed)
  {
    if (table->GetNumberOfComponents() != PackedFormat::WordBytes)
    {
      fail(TextureTableArray,
        "has " + std::to_string(table->GetNumberOfComponents()) + " components, not 4");
    }
    return;
  }
  const int texels = format.resolution * format.resolution;
  if (table->GetNumberOfComponents() != texels)
  {
    fail(TextureTableArray,
      "has " + std::to_string(table->GetNumberOfComponents()) +
        " components, not resolution * resolution = " + std::to_string(texels));
  }
}

void checkRows(vtkDataArray* rows, vtkIdType textures)
{
  const auto range = vtk::DataArrayValueRange<1>(vtkIntArray::SafeDownCast(rows));
  const auto largest = std::max_element(range.begin(), range.end());
  if (largest != range.end() && *largest >= textures)
  {
    fail(TextureIndexArray,
      "refers to texture " + std::to_string(*largest) + " of a table with " +
        std::to_string(textures) + " textures");
  }
}

void checkBeginnings(vtkDataArray* rows, const PackedTextures& packed)
{
  for (const int row : vtk::DataArrayValueRange<1>(vtkIntArray::SafeDownCast(rows)))
  {
    if (row >= 0 && packed.lengthAt(static_cast<std::size_t>(row)) == 0)
    {
      fail(
        TextureIndexArray, "refers to word " + std::to_string(row) + ", where no texture begins");
    }
  }
}

/// The arrays without the lookup; throws std::runtime_error with the message.
BakedTextures readArrays(vtkPointSet& points, TableFormat& format)
{
  BakedTextures baked;
  vtkPointData* data = points.GetPointData();
  const vtkIdType count = points.GetNumberOfPoints();
  if (vtkDataArray* means = data->GetArray(OcclusionArray))
  {
    checkPerPoint(means, OcclusionArray, count);
    baked.means = as<vtkFloatArray>(means);
  }
  vtkDataArray* table = points.GetFieldData()->GetArray(TextureTableArray);
  if (!table)
  {
    if (data->HasArray(TextureIndexArray))
    {
      fail(TextureTableArray, "is missing from the field data although particles refer to it");
    }
    return baked;
  }
  format = readFormat(points.GetFieldData());
  checkTable(table, format);
  vtkDataArray* rows = data->GetArray(TextureIndexArray);
  checkPerPoint(rows, TextureIndexArray, count);
  baked.rows = as<vtkIntArray>(rows);
  checkRows(baked.rows, table->GetNumberOfTuples());
  baked.table = table;
  baked.hasLight = format.hasLight;
  if (format.packed)
  {
    baked.packed = std::make_shared<PackedTextures>(*format.packed,
      static_cast<const std::uint8_t*>(table->GetVoidPointer(0)),
      static_cast<std::size_t>(table->GetNumberOfTuples()));
    checkBeginnings(baked.rows, *baked.packed);
  }
  return baked;
}

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

/// Puts the tables of all parts one after the other; throws std::runtime_error if they do not fit.
void attachMergedTable(std::vector<Part>& parts, vtkFieldData* parameters, vtkPolyData* merged)
{
  const auto first = std::find_if(
    parts.begin(), parts.end(), [](const Part& part) { return part.baked.table != nullptr; });
  if (first == parts.end())
  {
    return;
  }
  const bool copyAsIs = sameFormat(parts, first->format);
  if (!copyAsIs)
  {
    std::for_each(parts.begin(), parts.end(), decode);
  }
  vtkSmartPointer<vtkDataArray> table = copyAsIs && first->format.bytes
    ? vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkUnsignedCharArray>::New())
    : vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkFloatArray>::New());
  table->SetName(TextureTableArray);
  table->SetNumberOfComponents(first->baked.table->GetNumberOfComponents());
  vtkNew<vtkIntArray> rows;
  rows->SetName(TextureIndexArray);
  rows->Allocate(merged->GetNumberOfPoints());
  for (const Part& part : parts)
  {
    const vtkIdType offset = table->GetNumberOfTuples();
    if (part.baked.table)
    {
      if (part.format.resolution != first->format.resolution)
      {
        fail(TextureTableArray, "has another resolution in some blocks");
      }
      const vtkSmartPointer<vtkDataArray>& source = part.baked.table;
      if (offset + source->GetNumberOfTuples() > std::numeric_limits<std::int32_t>::max())
      {
        fail(TextureTableArray, "has more rows than 32-bit indices reach when blocks are merged");
      }
      table->InsertTuples(offset, source->GetNumberOfTuples(), 0, source);
    }
    appendRows(part, static_cast<std::int32_t>(offset), rows);
  }
  OcclusionParameters description = OcclusionParameters::fromFieldData(parameters);
  if (std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.baked.hasLight; }))
  {
    description.set(BakedLightParameter, true);
  }
  if (!copyAsIs)
  {
    description.set("encoding", Float32Linear);
    description.set("storage", FullStorage);
  }
  else if (vtkDataArray* basis = parameters->GetArray(TextureBasisArray))
  {
    merged->GetFieldData()->AddArray(basis);
  }
  description.toFieldData(merged->GetFieldData());
  merged->GetFieldData()->AddArray(table);
  merged->GetPointData()->AddArray(rows);
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
