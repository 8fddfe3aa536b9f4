// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOcclusionTextureReader.h"

#include "EncodedTextureFile.h"
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

#include <cstdint>
#include <functional>
#include <new>

vtkStandardNewMacro(vtkOcclusionTextureReader);

namespace
{
using Progress = std::function<void(double)>;

vtkSmartPointer<vtkDataArray> newTable(const po::EncodedTextureFile& textures)
{
  const po::TexelFormat& format = textures.format();
  vtkSmartPointer<vtkDataArray> table;
  table.TakeReference(vtkDataArray::CreateDataArray(format.bytes ? VTK_UNSIGNED_CHAR : VTK_FLOAT));
  table->SetName(po::TextureTableArray);
  table->SetNumberOfComponents(format.resolution * format.resolution);
  table->SetNumberOfTuples(textures.file().textureCount());
  return table;
}

/// Reads texture by texture: no second copy of the table is held.
vtkSmartPointer<vtkDataArray> readTable(
  const po::EncodedTextureFile& textures, const Progress& progress)
{
  vtkSmartPointer<vtkDataArray> table = newTable(textures);
  const vtkIdType rows = table->GetNumberOfTuples();
  for (vtkIdType row = 0; row < rows; ++row)
  {
    if (row % 1024 == 0)
    {
      progress(static_cast<double>(row) / static_cast<double>(rows));
    }
    textures.read(
      static_cast<std::int32_t>(row), table->GetVoidPointer(row * table->GetNumberOfComponents()));
  }
  return table;
}

void addParticleArrays(const po::OcclusionTextureFile& file, vtkPointData* pointData)
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

/// Everything is read into `result` first, so that a failure leaves nothing half-read in the
/// output.
/// Returns a warning or nothing.
std::string readOnto(
  const std::string& fileName, vtkPolyData* input, vtkPolyData* output, const Progress& progress)
{
  std::string warning;
  const po::EncodedTextureFile textures(fileName);
  vtkNew<vtkPolyData> result;
  if (input)
  {
    warning = textures.checkParticles(*input);
    result->ShallowCopy(input);
    addParticleArrays(textures.file(), result->GetPointData());
  }
  result->GetFieldData()->AddArray(readTable(textures, progress));
  textures.file().parameters().toFieldData(result->GetFieldData());
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
