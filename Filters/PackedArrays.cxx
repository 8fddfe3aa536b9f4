// SPDX-License-Identifier: BSD-3-Clause
#include "PackedArrays.h"

#include "vtkFieldData.h"
#include "vtkShortArray.h"

#include <algorithm>
#include <stdexcept>

namespace po
{
namespace
{
TextureBasis readBasis(const OcclusionParameters& parameters, vtkFieldData* fields, int resolution)
{
  auto* array = vtkShortArray::SafeDownCast(fields->GetAbstractArray(TextureBasisArray));
  if (!array || array->GetNumberOfComponents() != resolution * resolution)
  {
    throw std::runtime_error(std::string("The compressed textures need the field array '") +
      TextureBasisArray + "' of 16-bit integers with resolution * resolution components");
  }
  TextureBasis basis;
  basis.resolution = resolution;
  basis.scale = parameters.getDouble("basisScale");
  const short* numbers = array->GetPointer(0);
  basis.numbers.assign(numbers, numbers + array->GetNumberOfValues());
  return basis;
}
}

vtkSmartPointer<vtkDataArray> basisArrayOf(const PackedFormat& format)
{
  if (format.classBits.empty())
  {
    return nullptr;
  }
  auto array = vtkSmartPointer<vtkShortArray>::New();
  array->SetName(TextureBasisArray);
  array->SetNumberOfComponents(static_cast<int>(format.basis.texels()));
  array->SetNumberOfTuples(static_cast<vtkIdType>(1 + format.basis.components()));
  std::copy(format.basis.numbers.begin(), format.basis.numbers.end(), array->GetPointer(0));
  return array;
}

void describeFormat(const PackedFormat& format, OcclusionParameters& parameters)
{
  if (!format.classBits.empty())
  {
    parameters.set("basisScale", format.basis.scale);
    parameters.set("componentBits", textOfClassBits(format.classBits));
  }
}

PackedFormat packedFormatOf(const OcclusionParameters& parameters, vtkFieldData* fields)
{
  PackedFormat format;
  const long long resolution = parameters.getInteger("resolution");
  format.resolution = static_cast<int>(std::clamp(resolution, 0ll, 1ll << 20));
  format.maximum = parameters.getDouble("maximum");
  PackedFormat sizesOnly = format;
  sizesOnly.check(); // before the resolution is squared
  if (parameters.has("componentBits"))
  {
    format.classBits = classBitsOf(parameters.get("componentBits"));
    format.basis = readBasis(parameters, fields, format.resolution);
  }
  format.check();
  return format;
}
}
