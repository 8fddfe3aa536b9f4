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

/// Channels of an image, and its size in pixels.
struct ExrImage
{
  int width = 0;
  int height = 0;
  std::vector<ExrChannel> channels; ///< of floats (HALF and FLOAT) and of integers (UINT)
};

/// The size of what readExrLayers() reads, without channels. Throws as that does.
ExrImage readExrSize(const std::string& fileName);

/// Reads all channels of the data window of the first part that is not deep, scan-line or tiled, of
/// any compression. Channels at a lower resolution (of colours) are left out.
///
/// Throws a std::runtime_error that names the file, the fault and the cure: not an OpenEXR file;
/// damaged or truncated; deep; more than 2^28 pixels; no channel at full resolution.
ExrImage readExrLayers(const std::string& fileName);

/// Writes a scan-line image of width * height pixels a channel beside and renames it. Throws a
/// std::runtime_error that names the file.
void writeExrLayers(
  const std::string& fileName, int width, int height, const std::vector<ExrChannel>& channels);
}

#endif
