// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRenderedLayersWriter.h"

#include "ExrLayers.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

vtkStandardNewMacro(vtkRenderedLayersWriter);

namespace
{
struct ImageSize
{
  int width;
  int height;
  [[nodiscard]] std::size_t pixels() const { return std::size_t(width) * height; }
};

ImageSize requireImage(vtkImageData* image)
{
  std::array<int, 3> size;
  image->GetDimensions(size.data());
  if (size[0] < 1 || size[1] < 1 || size[2] != 1)
  {
    throw std::runtime_error("The image has " + std::to_string(size[0]) + " x " +
      std::to_string(size[1]) + " x " + std::to_string(size[2]) +
      " pixels; an image of one layer in z, with pixels, is needed.");
  }
  return { size[0], size[1] };
}

/// Calls store(pixel in the file, tuple of the array): row 0 of the file is the top one of the
/// image.
template <typename Store>
void forEachPixel(const ImageSize& size, const Store& store)
{
  for (int row = 0; row < size.height; ++row)
  {
    const vtkIdType tuple = vtkIdType{ size.height - 1 - row } * size.width;
    for (int column = 0; column < size.width; ++column)
    {
      store(std::size_t(row) * size.width + column, tuple + column);
    }
  }
}

/// IEC 61966-2-1, the inverse of sRGB's transfer function.
std::array<float, 256> linearFromSrgb()
{
  std::array<float, 256> linear;
  for (int byte = 0; byte < 256; ++byte)
  {
    const double value = byte / 255.0;
    linear[byte] =
      static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  return linear;
}

void addColor(const ImageSize& size, vtkDataArray* array, std::vector<po::ExrChannel>& channels)
{
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(array);
  if (!bytes || bytes->GetNumberOfComponents() != 4)
  {
    throw std::runtime_error("The array \"RGBA\" must be of unsigned char with 4 components.");
  }
  static const std::array<float, 256> linear = linearFromSrgb();
  std::array<std::vector<half>, 4> planes;
  planes.fill(std::vector<half>(size.pixels()));
  forEachPixel(size,
    [&](std::size_t pixel, vtkIdType tuple)
    {
      const unsigned char* rgba = bytes->GetPointer(4 * tuple);
      const float alpha = rgba[3] / 255.0f;
      for (int color = 0; color < 3; ++color)
      {
        planes[color][pixel] = alpha * linear[rgba[color]];
      }
      planes[3][pixel] = alpha;
    });
  const std::array<const char*, 4> names = { "R", "G", "B", "A" };
  for (int plane = 0; plane < 4; ++plane)
  {
    channels.push_back({ names[plane], std::move(planes[plane]) });
  }
}

void addIds(const ImageSize& size, vtkDataArray* array, std::vector<po::ExrChannel>& channels)
{
  if (array->GetNumberOfComponents() != 1)
  {
    throw std::runtime_error("The array \"id\" must have one component.");
  }
  // Doubles hold every id up to 2^53; what a UINT can hold is far below.
  constexpr double Largest = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> ids(size.pixels());
  forEachPixel(size,
    [&](std::size_t pixel, vtkIdType tuple)
    {
      const double id = array->GetComponent(tuple, 0);
      if (!(id >= -1.0 && id <= Largest))
      {
        throw std::runtime_error("The array \"id\" holds " + std::to_string(id) +
          "; OpenEXR can hold 0 to 4294967294, and -1 for background.");
      }
      ids[pixel] =
        id < 0.0 ? std::numeric_limits<std::uint32_t>::max() : static_cast<std::uint32_t>(id);
    });
  channels.push_back({ "id", std::move(ids) });
}

void requireComponents(vtkDataArray* array)
{
  const std::string name = array->GetName();
  const int components = array->GetNumberOfComponents();
  const int expected = name == "Z" || name == "AO" ? 1 : name == "N" ? 3 : components;
  if (components != expected || components > 4)
  {
    throw std::runtime_error("The array \"" + name + "\" has " + std::to_string(components) +
      " components; " + (components == expected ? "1 to 4" : std::to_string(expected)) +
      " can be written.");
  }
}

void addFloats(const ImageSize& size, vtkDataArray* array, std::vector<po::ExrChannel>& channels)
{
  requireComponents(array);
  const std::array<const char*, 4> suffixes = { ".X", ".Y", ".Z", ".W" };
  const int components = array->GetNumberOfComponents();
  for (int component = 0; component < components; ++component)
  {
    std::vector<float> values(size.pixels());
    forEachPixel(size,
      [&](std::size_t pixel, vtkIdType tuple)
      { values[pixel] = static_cast<float>(array->GetComponent(tuple, component)); });
    const std::string suffix = components > 1 ? suffixes[component] : "";
    channels.push_back({ array->GetName() + suffix, std::move(values) });
  }
}

bool isReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

/// Returns false for what has no place in the file.
bool addArray(const ImageSize& size, vtkDataArray* array, std::vector<po::ExrChannel>& channels)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  if (name == "RGBA")
  {
    addColor(size, array, channels);
  }
  else if (name == "id" && !isReal(array))
  {
    addIds(size, array, channels);
  }
  else if (!name.empty() && name != "id" && isReal(array))
  {
    addFloats(size, array, channels);
  }
  else
  {
    return false;
  }
  return true;
}

/// Returns the names of the arrays that are left out.
std::string writeImage(const std::string& fileName, vtkImageData* image)
{
  const ImageSize size = requireImage(image);
  std::vector<po::ExrChannel> channels;
  std::string leftOut;
  vtkPointData* arrays = image->GetPointData();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    if (!array || !addArray(size, array, channels))
    {
      const char* name = arrays->GetArrayName(i);
      leftOut += std::string(leftOut.empty() ? "" : ", ") + (name ? name : "(unnamed)");
    }
  }
  if (channels.empty())
  {
    throw std::runtime_error("The image has no point array that can be written as a layer "
                             "(RGBA, Z, AO, N, id or any array of floats); it has: " +
      (leftOut.empty() ? "none" : leftOut) + ".");
  }
  po::writeExrLayers(fileName, size.width, size.height, channels);
  return leftOut;
}
}

vtkRenderedLayersWriter::~vtkRenderedLayersWriter()
{
  this->SetFileName(nullptr);
}

int vtkRenderedLayersWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkRenderedLayersWriter::Write()
{
  const int executed = this->Superclass::Write();
  return executed && this->GetErrorCode() == vtkErrorCode::NoError;
}

void vtkRenderedLayersWriter::WriteData()
{
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("No file name; set FileName.");
    return;
  }
  try
  {
    const std::string leftOut =
      writeImage(this->FileName, vtkImageData::SafeDownCast(this->GetInput()));
    if (!leftOut.empty())
    {
      vtkWarningMacro(
        "Left out, since they are neither floats nor \"id\" nor \"RGBA\": " << leftOut);
    }
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("Not enough memory to write the layers to \""
      << this->FileName << "\"; close other data. Nothing was changed on disk.");
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< error.what());
  }
}

void vtkRenderedLayersWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
}
