// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ExrLayers_h
#define po_ExrLayers_h

#include <half.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

// Internal to the module: includes Imath.
namespace po
{
/// One channel of an image, row by row from the top; its type in memory is its type in the file.
struct ExrChannel
{
  std::string name;
  std::variant<std::vector<half>, std::vector<float>, std::vector<std::uint32_t>> pixels;
};

/// Writes a scan-line image of width * height pixels a channel beside and renames it. Throws a
/// std::runtime_error that names the file.
void writeExrLayers(
  const std::string& fileName, int width, int height, const std::vector<ExrChannel>& channels);
}

#endif
