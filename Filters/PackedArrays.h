// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PackedArrays_h
#define po_PackedArrays_h

// The format of packed textures as field data and parameters.
//
// Beside the table, an array of uint8 whose tuples are words of 4 bytes, a compressed one has the
// field array "AmbientOcclusionBasis", int16, one tuple of T * T numbers for the mean and for each
// component, and the parameters "basisScale" and "componentBits" (see PackedFormat).

#include "OcclusionParameters.h"
#include "PackedFormat.h"

#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkFieldData;

namespace po
{
/// The basis as an array, or null if there is none.
[[nodiscard]] vtkSmartPointer<vtkDataArray> basisArrayOf(const PackedFormat& format);

void describeFormat(const PackedFormat& format, OcclusionParameters& parameters);

/// The inverse of both. Throws std::runtime_error, or std::invalid_argument of PackedFormat::check.
[[nodiscard]] PackedFormat packedFormatOf(
  const OcclusionParameters& parameters, vtkFieldData* fields);
}

#endif
