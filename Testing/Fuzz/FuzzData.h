// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FuzzData_h
#define po_FuzzData_h

// Data sets out of bytes: any arrays, any values, any blocks.

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <limits>
#include <string>

using Provider = FuzzedDataProvider;

/// A number, now and then one that is hard.
inline double anyNumber(Provider& bytes)
{
  using Limits = std::numeric_limits<double>;
  const std::array<double, 16> hard = { 0.0, -0.0, 1.0, -1.0, 0.5, Limits::quiet_NaN(),
    Limits::infinity(), -Limits::infinity(), Limits::max(), -Limits::max(), Limits::min(),
    Limits::denorm_min(), 1e30, 1e-30, 1e18, 4294967296.0 };
  const auto kind = bytes.ConsumeIntegral<std::uint8_t>();
  if (kind < 2 * hard.size())
  {
    return hard[kind % hard.size()];
  }
  return kind < 64 ? bytes.ConsumeFloatingPoint<double>()
                   : bytes.ConsumeFloatingPointInRange<double>(-4, 4);
}

inline vtkSmartPointer<vtkAbstractArray> anyArrayType(Provider& bytes)
{
  const std::array<int, 12> types = { VTK_DOUBLE, VTK_FLOAT, VTK_INT, VTK_UNSIGNED_CHAR,
    VTK_LONG_LONG, VTK_ID_TYPE, VTK_SHORT, VTK_UNSIGNED_INT, VTK_BIT, VTK_STRING, VTK_VARIANT,
    VTK_SIGNED_CHAR };
  if (bytes.ConsumeIntegral<std::uint8_t>() == 7)
  {
    return vtkSmartPointer<vtkSOADataArrayTemplate<float>>::New();
  }
  return vtk::TakeSmartPointer(
    vtkAbstractArray::CreateArray(types[bytes.ConsumeIntegralInRange<std::size_t>(0, 11)]));
}

inline void fill(Provider& bytes, vtkAbstractArray* array)
{
  constexpr vtkIdType Most = 64; // the rest repeats
  auto* numbers = vtkDataArray::SafeDownCast(array);
  auto* strings = vtkStringArray::SafeDownCast(array);
  std::array<double, Most> values{};
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    auto& value = values[static_cast<std::size_t>(i % Most)];
    value = i < Most ? anyNumber(bytes) : value;
    if (numbers)
    {
      const int components = numbers->GetNumberOfComponents();
      // Doubles that an integer cannot hold are no fault of the product to convert.
      const bool real = numbers->GetDataType() == VTK_FLOAT || numbers->GetDataType() == VTK_DOUBLE;
      const bool fits = value > -128 && value < 128;
      numbers->SetComponent(i / components, static_cast<int>(i % components),
        real || fits ? value : static_cast<double>(i));
    }
    else if (strings)
    {
      strings->SetValue(i, bytes.ConsumeRandomLengthString(8));
    }
  }
}

/// An array of any type, number of components and length; often as it should be.
inline vtkSmartPointer<vtkAbstractArray> anyArray(Provider& bytes, vtkIdType points)
{
  auto array = anyArrayType(bytes);
  const bool usual = bytes.ConsumeProbability<float>() < 0.6f;
  array->SetNumberOfComponents(usual ? 1 : bytes.ConsumeIntegralInRange<int>(1, 5));
  array->SetNumberOfTuples(usual ? points : bytes.ConsumeIntegralInRange<vtkIdType>(0, 40));
  fill(bytes, array);
  const std::array<const char*, 12> names = { "radius", "Radius", "rad", "r", "diameter",
    "AmbientOcclusion", "AmbientOcclusionTexture", "AmbientOcclusionTextures",
    "AmbientOcclusionParameters", "", "value", nullptr };
  array->SetName(names[bytes.ConsumeIntegralInRange<std::size_t>(0, names.size() - 1)]);
  return array;
}

inline void addArrays(Provider& bytes, vtkDataSet* data)
{
  for (int i = bytes.ConsumeIntegralInRange<int>(0, 3); i > 0; --i)
  {
    data->GetPointData()->AddArray(anyArray(bytes, data->GetNumberOfPoints()));
  }
  if (bytes.ConsumeBool())
  {
    data->GetFieldData()->AddArray(anyArray(bytes, 1));
  }
}

inline vtkSmartPointer<vtkPoints> anyPoints(Provider& bytes)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(bytes.ConsumeBool() ? VTK_FLOAT : VTK_DOUBLE);
  const int count = bytes.ConsumeIntegralInRange<int>(0, 12);
  for (int i = 0; i < count; ++i)
  {
    const double x = anyNumber(bytes), y = anyNumber(bytes), z = anyNumber(bytes);
    points->InsertNextPoint(x, y, z);
  }
  return points;
}

/// Cells with ids that exist: VTK itself crashes with others.
inline void addCells(Provider& bytes, vtkPolyData* data)
{
  const vtkIdType points = data->GetNumberOfPoints();
  if (points == 0)
  {
    return;
  }
  data->AllocateEstimate(4, 4);
  for (int i = bytes.ConsumeIntegralInRange<int>(0, 4); i > 0; --i)
  {
    std::array<vtkIdType, 6> ids{};
    for (vtkIdType& id : ids)
    {
      id = bytes.ConsumeIntegralInRange<vtkIdType>(0, points - 1);
    }
    const std::array<int, 6> types = { VTK_VERTEX, VTK_LINE, VTK_TRIANGLE, VTK_QUAD, VTK_POLYGON,
      VTK_TRIANGLE_STRIP };
    const std::array<int, 6> sizes = { 1, 2, 3, 4, 6, 5 };
    const auto type = bytes.ConsumeIntegralInRange<std::size_t>(0, types.size() - 1);
    data->InsertNextCell(types[type], sizes[type], ids.data());
  }
}

inline vtkSmartPointer<vtkPolyData> anyParticles(Provider& bytes)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  if (bytes.ConsumeProbability<float>() < 0.95f) // else without points at all
  {
    data->SetPoints(anyPoints(bytes));
    addArrays(bytes, data);
    addCells(bytes, data);
  }
  return data;
}

/// A block of any kind, null too.
inline vtkSmartPointer<vtkDataObject> anyBlock(Provider& bytes)
{
  switch (bytes.ConsumeIntegralInRange<int>(0, 9))
  {
    case 0:
      return nullptr;
    case 1:
    {
      auto image = vtkSmartPointer<vtkImageData>::New();
      image->SetDimensions(2, 2, 1);
      addArrays(bytes, image);
      return image;
    }
    case 2:
    {
      auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
      grid->SetPoints(anyPoints(bytes));
      addArrays(bytes, grid);
      return grid;
    }
    default:
      return anyParticles(bytes);
  }
}

/// One data set, or a tree of blocks.
inline vtkSmartPointer<vtkDataObject> anyData(Provider& bytes, int depth = 0)
{
  if (depth > 2 || bytes.ConsumeProbability<float>() < 0.5f)
  {
    return depth == 0 ? vtkSmartPointer<vtkDataObject>(anyParticles(bytes)) : anyBlock(bytes);
  }
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const auto count = bytes.ConsumeIntegralInRange<unsigned>(0, 4);
  blocks->SetNumberOfBlocks(count);
  for (unsigned i = 0; i < count; ++i)
  {
    blocks->SetBlock(i, anyData(bytes, depth + 1));
  }
  return blocks;
}

#endif
