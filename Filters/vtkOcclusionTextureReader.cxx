// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOcclusionTextureReader.h"

#include "Gamma2.h"
#include "GeometryHash.h"
#include "OcclusionParameters.h"
#include "OcclusionTextureFile.h"

#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <functional>
#include <new>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkOcclusionTextureReader);

namespace
{
using Progress = std::function<void(double)>;

template <typename Array>
vtkSmartPointer<Array> newTable(const po::OcclusionTextureFile& file)
{
  auto table = vtkSmartPointer<Array>::New();
  table->SetName(po::TextureTableArray);
  table->SetNumberOfComponents(file.resolution() * file.resolution());
  table->SetNumberOfTuples(file.textureCount());
  return table;
}

/// Reads texture by texture: no second copy of the table is held.
void readEachTexture(po::OcclusionTextureFile& file, const Progress& progress,
  const std::function<void(vtkIdType row)>& read)
{
  for (vtkIdType row = 0; row < file.textureCount(); ++row)
  {
    if (row % 1024 == 0)
    {
      progress(static_cast<double>(row) / static_cast<double>(file.textureCount()));
    }
    read(row);
  }
}

vtkSmartPointer<vtkDataArray> readFloats(po::OcclusionTextureFile& file, const Progress& progress)
{
  auto table = newTable<vtkFloatArray>(file);
  const vtkIdType size = table->GetNumberOfComponents();
  readEachTexture(
    file, progress, [&](vtkIdType row) { file.readTexture(row, table->GetPointer(row * size)); });
  return table;
}

vtkSmartPointer<vtkDataArray> readBytes(
  po::OcclusionTextureFile& file, double maximum, const Progress& progress)
{
  auto table = newTable<vtkUnsignedCharArray>(file);
  const vtkIdType size = table->GetNumberOfComponents();
  std::vector<float> texels(size);
  readEachTexture(file, progress,
    [&](vtkIdType row)
    {
      file.readTexture(row, texels.data());
      std::transform(texels.begin(), texels.end(), table->GetPointer(row * size),
        [maximum](float value) { return po::encodeGamma2(value, maximum); });
    });
  return table;
}

vtkSmartPointer<vtkDataArray> readTable(po::OcclusionTextureFile& file, const Progress& progress)
{
  const std::string& encoding = file.parameters().get("encoding");
  if (encoding == po::UInt8Gamma2)
  {
    return readBytes(file, file.parameters().getDouble("maximum"), progress);
  }
  if (encoding == po::Float32Linear)
  {
    return readFloats(file, progress);
  }
  throw std::runtime_error("the textures are encoded as \"" + encoding +
    "\", which this version does not know; use a newer version.");
}

void addParticleArrays(po::OcclusionTextureFile& file, vtkPointData* pointData)
{
  vtkNew<vtkFloatArray> means;
  means->SetName(po::OcclusionArray);
  means->SetNumberOfTuples(file.particleCount());
  vtkNew<vtkIntArray> rows;
  rows->SetName(po::TextureIndexArray);
  rows->SetNumberOfTuples(file.particleCount());
  file.readParticles(rows->GetPointer(0), means->GetPointer(0));
  pointData->AddArray(means);
  pointData->AddArray(rows);
}

void requireSameParticles(
  const std::string& fileName, const po::OcclusionTextureFile& file, vtkPolyData* input)
{
  if (input->GetNumberOfPoints() != file.particleCount())
  {
    throw std::runtime_error("\"" + fileName + "\" is for " + std::to_string(file.particleCount()) +
      " particles, but the input has " + std::to_string(input->GetNumberOfPoints()) +
      " points; choose the data set that was baked, before any filter that removes points.");
  }
}

/// What is wrong with the particles that textures are loaded onto, or nothing.
std::string differenceOf(
  const std::string& fileName, const po::OcclusionTextureFile& file, vtkPolyData* input)
{
  const po::OcclusionParameters& parameters = file.parameters();
  const std::string radii = parameters.has("radiusArray") ? parameters.get("radiusArray") : "";
  if (file.geometry().empty() || file.geometry() == po::hashGeometry(*input, radii))
  {
    return {};
  }
  return "The textures of \"" + fileName +
    "\" were saved for particles of other positions, radii or order: the occlusion shown may be "
    "wrong. Choose the data set and time step that was baked, or bake again.";
}

/// Everything is read into `result` first, so that a failure leaves nothing half-read in the
/// output.
/// Returns a warning or nothing.
std::string readOnto(
  const std::string& fileName, vtkPolyData* input, vtkPolyData* output, const Progress& progress)
{
  std::string warning;
  po::OcclusionTextureFile file(fileName);
  vtkNew<vtkPolyData> result;
  if (input)
  {
    requireSameParticles(fileName, file, input);
    warning = differenceOf(fileName, file, input);
    result->ShallowCopy(input);
    addParticleArrays(file, result->GetPointData());
  }
  result->GetFieldData()->AddArray(readTable(file, progress));
  file.parameters().toFieldData(result->GetFieldData());
  output->ShallowCopy(result);
  return warning;
}
}

vtkOcclusionTextureReader::~vtkOcclusionTextureReader()
{
  this->SetFileName(nullptr);
}

int vtkOcclusionTextureReader::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkOcclusionTextureReader::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("No file name; set FileName.");
    return 0;
  }
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const std::string warning = readOnto(this->FileName, vtkPolyData::GetData(inputVector[0]),
      vtkPolyData::GetData(outputVector), [this](double done) { this->UpdateProgress(done); });
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("Not enough memory for the textures of \"" << this->FileName << "\".");
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro(<< error.what());
  }
  return 0;
}

vtkSmartPointer<vtkFloatArray> vtkOcclusionTextureReader::ReadTexture(vtkIdType row)
{
  try
  {
    po::OcclusionTextureFile file(this->FileName ? this->FileName : "");
    auto texture = vtkSmartPointer<vtkFloatArray>::New();
    texture->SetNumberOfComponents(file.resolution() * file.resolution());
    texture->SetNumberOfTuples(1);
    file.readTexture(row, texture->GetPointer(0));
    return texture;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return nullptr;
  }
}

void vtkOcclusionTextureReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
}
