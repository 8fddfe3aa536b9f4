// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRenderedLayersReader.h"

#include "ExrLayers.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkRenderedLayersReader);

namespace
{
/// Z, or as Blender calls it in a file of several layers: ViewLayer.Depth.Z.
bool isDepth(const std::string& name)
{
  const std::string inLayer = ".Depth.Z";
  return name == "Z" ||
    (name.size() > inLayer.size() &&
      name.compare(name.size() - inLayer.size(), inLayer.size(), inLayer) == 0);
}

/// Row 0 of the file is the top one of the image.
template <typename Array, typename T>
vtkSmartPointer<vtkDataArray> upright(const std::vector<T>& pixels, int width, int height)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfTuples(static_cast<vtkIdType>(pixels.size()));
  for (int row = 0; row < height; ++row)
  {
    const T* from = pixels.data() + static_cast<std::ptrdiff_t>(row) * width;
    std::copy(from, from + width, array->GetPointer(vtkIdType{ height - 1 - row } * width));
  }
  return array;
}

vtkSmartPointer<vtkDataArray> arrayOf(const po::ExrChannel& channel, int width, int height)
{
  if (const auto* integers = std::get_if<std::vector<std::uint32_t>>(&channel.pixels))
  {
    return upright<vtkUnsignedIntArray>(*integers, width, height);
  }
  return upright<vtkFloatArray>(std::get<std::vector<float>>(channel.pixels), width, height);
}

void openBackground(vtkDataArray* depth, double from)
{
  auto* values = vtkFloatArray::SafeDownCast(depth);
  if (values && from > 0)
  {
    float* begin = values->GetPointer(0);
    std::replace_if(
      begin, begin + values->GetNumberOfTuples(), [from](float z) { return z >= from; },
      std::numeric_limits<float>::infinity());
  }
}
}

vtkRenderedLayersReader::vtkRenderedLayersReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkRenderedLayersReader::~vtkRenderedLayersReader()
{
  this->SetFileName(nullptr);
}

int vtkRenderedLayersReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("No file name; set FileName.");
    return 0;
  }
  try
  {
    const po::ExrImage image = po::readExrSize(this->FileName);
    vtkInformation* info = outputVector->GetInformationObject(0);
    const int extent[6] = { 0, image.width - 1, 0, image.height - 1, 0, 0 };
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

int vtkRenderedLayersReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector);
  try
  {
    const po::ExrImage image = po::readExrLayers(this->FileName);
    output->SetDimensions(image.width, image.height, 1);
    for (const po::ExrChannel& channel : image.channels)
    {
      const auto array = arrayOf(channel, image.width, image.height);
      array->SetName(channel.name.c_str());
      output->GetPointData()->AddArray(array);
      if (isDepth(channel.name))
      {
        openBackground(array, this->BackgroundFrom);
        output->GetPointData()->SetActiveScalars(channel.name.c_str());
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    vtkErrorMacro("Not enough memory to read \"" << this->FileName << "\"; close other data.");
    return 0;
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkRenderedLayersReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
  os << indent << "BackgroundFrom: " << this->BackgroundFrom << '\n';
}
