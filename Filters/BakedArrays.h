// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakedArrays_h
#define po_BakedArrays_h

// The arrays of a bake as they are found in a data set, checked.

#include "BakedTextures.h"
#include "PackedFormat.h"

#include <optional>
#include <string>

namespace po
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

/// Are textures of one format read alike?
[[nodiscard]] bool operator==(const TableFormat& a, const TableFormat& b);

/// The arrays without the lookup; throws std::runtime_error with the message.
[[nodiscard]] BakedTextures readArrays(vtkPointSet& points, TableFormat& format);

/// Throws std::runtime_error that says what is wrong with an array, what comes of it, and what to
/// do.
[[noreturn]] void refuseBakedArray(const std::string& array, const std::string& what);
}

#endif
