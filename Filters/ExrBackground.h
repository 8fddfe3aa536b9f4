// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ExrBackground_h
#define po_ExrBackground_h

#include "ParticleOcclusionFiltersModule.h"

#include <string>
#include <vector>

namespace po
{
/// Luminance of a background that surrounds the particles, by direction.
///
/// Luminance[row * Width + column], linear, finite, at least 0. Row j covers polar angles
/// [j pi / Height, (j+1) pi / Height] from +z; column i azimuths [2 pi i / Width, 2 pi (i+1) /
/// Width] from +x towards +y: the convention of the textures.
struct LatLongImage
{
  int width = 0;
  int height = 0;
  std::vector<float> luminance;
};

/// Reads a latitude/longitude background from an OpenEXR file, scan-line or tiled, of any
/// compression and pixel type.
///
/// Channels, the first that is there: R, G, B (luminance by the chromaticities in the header, else
/// by Rec. 709: 0.2126 R + 0.7152 G + 0.0722 B); Y; the only channel besides alpha, whatever its
/// name. Of a multi-part file the first part with such channels is read. Alpha is ignored.
///
/// Throws a std::runtime_error that names the file, the fault and the cure: not an OpenEXR file;
/// damaged or truncated; deep, cube-map or cropped image; no usable channels; more than 2^27
/// pixels; pixels that are NaN, infinite or negative (with their number).
PARTICLEOCCLUSIONFILTERS_EXPORT LatLongImage readLatLongImage(const std::string& fileName);
}

#endif
