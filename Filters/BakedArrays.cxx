// SPDX-License-Identifier: BSD-3-Clause
#include "BakedArrays.h"

#include "OcclusionParameters.h"
#include "PackedArrays.h"

#include "vtkDataArrayRange.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace po
{
namespace
{
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
    refuseBakedArray(ParametersArray, "names a storage that is not known ('" + storage + "')");
  }
  try
  {
    return packedFormatOf(parameters, fields);
  }
  catch (const std::exception& error)
  {
    refuseBakedArray(
      ParametersArray, std::string("does not describe the textures: ") + error.what());
  }
}

TableFormat readFormat(vtkFieldData* fields)
{
  const OcclusionParameters parameters = OcclusionParameters::fromFieldData(fields);
  TableFormat format;
  const long long resolution = parameters.getInteger("resolution");
  if (resolution < 1 || resolution > 4096)
  {
    refuseBakedArray(
      ParametersArray, "has a resolution out of range (" + std::to_string(resolution) + ")");
  }
  format.resolution = static_cast<int>(resolution);
  const std::string& encoding = parameters.get("encoding");
  format.bytes = encoding == UInt8Gamma2;
  if (!format.bytes && encoding != Float32Linear)
  {
    refuseBakedArray(ParametersArray, "names an encoding that is not known ('" + encoding + "')");
  }
  if (format.bytes)
  {
    format.maximum = parameters.getDouble("maximum");
    if (!(format.maximum >= 0) || !std::isfinite(format.maximum))
    {
      refuseBakedArray(ParametersArray, "has a maximum that is negative or not finite");
    }
  }
  format.packed = readPacked(parameters, fields);
  format.hasLight = parameters.hasBakedLight();
  if (format.packed && !format.bytes)
  {
    refuseBakedArray(ParametersArray, "names an encoding in which textures have one length");
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
    refuseBakedArray(name, "is missing although there are textures, or is not numeric");
  }
  if (array->GetNumberOfComponents() != 1)
  {
    refuseBakedArray(
      name, "has " + std::to_string(array->GetNumberOfComponents()) + " components, not one");
  }
  if (array->GetNumberOfTuples() != points)
  {
    refuseBakedArray(name,
      "has " + std::to_string(array->GetNumberOfTuples()) + " values for " +
        std::to_string(points) + " points");
  }
}

void checkTable(vtkDataArray* table, const TableFormat& format)
{
  const bool typeFits = table->GetDataType() == (format.bytes ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
  if (!typeFits)
  {
    refuseBakedArray(TextureTableArray, "is not of the type that its encoding asks for");
  }
  if (format.packed)
  {
    if (table->GetNumberOfComponents() != PackedFormat::WordBytes)
    {
      refuseBakedArray(TextureTableArray,
        "has " + std::to_string(table->GetNumberOfComponents()) + " components, not 4");
    }
    return;
  }
  const int texels = format.resolution * format.resolution;
  if (table->GetNumberOfComponents() != texels)
  {
    refuseBakedArray(TextureTableArray,
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
    refuseBakedArray(TextureIndexArray,
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
      refuseBakedArray(
        TextureIndexArray, "refers to word " + std::to_string(row) + ", where no texture begins");
    }
  }
}
}

bool operator==(const TableFormat& a, const TableFormat& b)
{
  return a.resolution == b.resolution && a.bytes == b.bytes &&
    (!a.bytes || a.maximum == b.maximum) && a.packed == b.packed;
}

void refuseBakedArray(const std::string& array, const std::string& what)
{
  throw std::runtime_error("The array '" + array + "' " + what +
    "; spheres are drawn without ambient occlusion. Bake again with Sphere Ambient Occlusion.");
}

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
      refuseBakedArray(
        TextureTableArray, "is missing from the field data although particles refer to it");
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
}
