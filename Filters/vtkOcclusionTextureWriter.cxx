// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOcclusionTextureWriter.h"

#include "BakedTextures.h"
#include "Gamma2.h"
#include "GeometryHash.h"
#include "OcclusionParameters.h"
#include "OcclusionTextureFile.h"

#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>

vtkStandardNewMacro(vtkOcclusionTextureWriter);

namespace
{
template <typename Array>
Array* requireArray(vtkFieldData* data, const char* name, const char* where, const char* type)
{
  vtkAbstractArray* found = data->GetAbstractArray(name);
  if (!found)
  {
    throw std::runtime_error(std::string("The input has no array \"") + name + "\" in its " +
      where + "; bake it with Sphere Ambient Occlusion first.");
  }
  auto* array = Array::SafeDownCast(found);
  if (!array)
  {
    throw std::runtime_error(std::string("The array \"") + name + "\" in the " + where +
      " is of type " + found->GetDataTypeAsString() + ", not " + type + "; bake the input again.");
  }
  return array;
}

void requireRows(vtkIntArray* rows, vtkIdType textures)
{
  for (vtkIdType i = 0; i < rows->GetNumberOfValues(); ++i)
  {
    const int row = rows->GetValue(i);
    if (row < -1 || row >= textures)
    {
      throw std::runtime_error("Particle " + std::to_string(i) + " refers to texture " +
        std::to_string(row) + ", but the array \"" + po::TextureTableArray + "\" has " +
        std::to_string(textures) + " tuples; bake the input again.");
    }
  }
}

void requireOneValueAPoint(vtkDataArray* array, vtkIdType points)
{
  if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != points)
  {
    throw std::runtime_error(std::string("The array \"") + array->GetName() +
      "\" does not have one value for each of the " + std::to_string(points) +
      " points; bake the input again.");
  }
}

int requireResolution(const po::OcclusionParameters& parameters, vtkDataArray* table)
{
  const long long side = parameters.getInteger("resolution");
  const long long components = table->GetNumberOfComponents();
  if (side < 1 || side > components || side * side != components)
  {
    throw std::runtime_error("The parameter \"resolution\" is " + std::to_string(side) +
      ", but the array \"" + po::TextureTableArray + "\" has " + std::to_string(components) +
      " components rather than its square; bake the input again.");
  }
  return static_cast<int>(side);
}

using TextureFunction = std::function<void(std::int64_t, float*)>;

TextureFunction copyTextures(vtkFieldData* fields)
{
  auto* table = requireArray<vtkFloatArray>(fields, po::TextureTableArray, "field data", "float");
  return [table](std::int64_t row, float* texels)
  {
    const float* first = table->GetPointer(row * table->GetNumberOfComponents());
    std::copy_n(first, table->GetNumberOfComponents(), texels);
  };
}

TextureFunction decodeTextures(vtkFieldData* fields, double maximum)
{
  auto* table = requireArray<vtkUnsignedCharArray>(
    fields, po::TextureTableArray, "field data", "unsigned char");
  if (!(maximum == 0.0 || (maximum >= po::SmallestGamma2Maximum && maximum <= VTK_FLOAT_MAX)))
  {
    throw std::runtime_error("The parameter \"maximum\" of the texture table is " +
      std::to_string(maximum) + "; 0 or a positive float is needed.");
  }
  return [table, maximum](std::int64_t row, float* texels)
  {
    const unsigned char* first = table->GetPointer(row * table->GetNumberOfComponents());
    std::transform(first, first + table->GetNumberOfComponents(), texels,
      [maximum](unsigned char byte)
      { return static_cast<float>(po::decodeGamma2(byte, maximum)); });
  };
}

TextureFunction linearTextures(vtkFieldData* fields, const po::OcclusionParameters& parameters)
{
  const std::string& encoding = parameters.get("encoding");
  if (encoding == po::UInt8Gamma2)
  {
    return decodeTextures(fields, parameters.getDouble("maximum"));
  }
  if (encoding == po::Float32Linear)
  {
    return copyTextures(fields);
  }
  throw std::runtime_error("The textures are encoded as \"" + encoding + "\"; only " +
    po::UInt8Gamma2 + " and " + po::Float32Linear + " can be written.");
}

/// The smallest maximum with which all bytes survive: below, halves are denormal where bytes are
/// small, and too coarse for them.
constexpr double SmallestMaximumOfHalves = 1.0 / 128;

po::TexelPrecision requirePrecision(int precision, const po::OcclusionParameters& parameters)
{
  if (precision == vtkOcclusionTextureWriter::Float)
  {
    return po::TexelPrecision::Float;
  }
  const double maximum =
    parameters.get("encoding") == po::UInt8Gamma2 ? parameters.getDouble("maximum") : 0;
  if (maximum > 0 && maximum < SmallestMaximumOfHalves)
  {
    throw std::runtime_error("The largest value of the textures is " + std::to_string(maximum) +
      ", too small for half-precision floats to keep all steps; choose the Precision Float.");
  }
  return po::TexelPrecision::Half;
}

std::string radiusArrayOf(const po::OcclusionParameters& parameters)
{
  return parameters.has("radiusArray") ? parameters.get("radiusArray") : std::string();
}

bool isPacked(const po::OcclusionParameters& parameters)
{
  const std::string storage =
    parameters.has("storage") ? parameters.get("storage") : po::FullStorage;
  return storage != po::FullStorage && storage != po::OneValueStorage;
}

/// Textures of different lengths are written at T x T texels.
void expandTextures(vtkPolyData* input, po::OcclusionTextureSource& source)
{
  struct Expanded
  {
    po::BakedTextures baked;
    po::ExpandedRows rows;
  };
  auto expanded = std::make_shared<Expanded>();
  std::string fault;
  expanded->baked = po::readBakedTextures(*input, fault);
  if (!fault.empty())
  {
    throw std::runtime_error(fault);
  }
  expanded->rows = po::expandRows(expanded->baked);
  source.resolution = static_cast<int>(source.parameters.getInteger("resolution"));
  source.textureCount = static_cast<std::int64_t>(expanded->rows.firsts.size());
  source.rows = expanded->rows.rows.data();
  source.texture = [expanded](std::int64_t row, float* texels)
  { expanded->baked.packed->decode(expanded->rows.firsts[static_cast<std::size_t>(row)], texels); };
  source.parameters.set("storage", po::FullStorage);
}

po::OcclusionTextureSource describeInput(vtkPolyData* input, int precision)
{
  const vtkIdType points = input->GetNumberOfPoints();
  auto* means =
    requireArray<vtkFloatArray>(input->GetPointData(), po::OcclusionArray, "point data", "float");
  auto* rows =
    requireArray<vtkIntArray>(input->GetPointData(), po::TextureIndexArray, "point data", "int");
  auto* table = requireArray<vtkDataArray>(
    input->GetFieldData(), po::TextureTableArray, "field data", "numbers");
  requireOneValueAPoint(means, points);
  requireOneValueAPoint(rows, points);
  requireRows(rows, table->GetNumberOfTuples());

  po::OcclusionTextureSource source;
  source.parameters = po::OcclusionParameters::fromFieldData(input->GetFieldData());
  source.geometry = po::hashGeometry(*input, radiusArrayOf(source.parameters));
  source.precision = requirePrecision(precision, source.parameters);
  source.particleCount = points;
  source.means = means->GetPointer(0);
  if (isPacked(source.parameters))
  {
    expandTextures(input, source);
    return source;
  }
  source.resolution = requireResolution(source.parameters, table);
  source.textureCount = table->GetNumberOfTuples();
  source.texture = linearTextures(input->GetFieldData(), source.parameters);
  source.rows = rows->GetPointer(0);
  return source;
}
}

vtkOcclusionTextureWriter::~vtkOcclusionTextureWriter()
{
  this->SetFileName(nullptr);
}

int vtkOcclusionTextureWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkOcclusionTextureWriter::Write()
{
  const int executed = this->Superclass::Write();
  return executed && this->GetErrorCode() == vtkErrorCode::NoError;
}

void vtkOcclusionTextureWriter::WriteData()
{
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("No file name; set FileName.");
    return;
  }
  try
  {
    auto* input = vtkPolyData::SafeDownCast(this->GetInput());
    po::OcclusionTextureSource source = describeInput(input, this->Precision);
    const std::vector<po::PlaceHash> places =
      po::placeHashes(*input, radiusArrayOf(source.parameters));
    source.places = places.data();
    const TextureFunction texture = source.texture;
    const double count = static_cast<double>(source.textureCount);
    source.texture = [&](std::int64_t row, float* texels)
    {
      if (row % 1024 == 0)
      {
        this->UpdateProgress(row / count);
      }
      texture(row, texels);
    };
    po::writeOcclusionTextures(this->FileName, source);
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("Not enough memory to write the textures to \""
      << this->FileName << "\"; close other data. Nothing was changed on disk.");
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< error.what());
  }
}

void vtkOcclusionTextureWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n'
     << indent << "Precision: " << this->Precision << '\n';
}
