// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouettePixels_h
#define po_SilhouettePixels_h

#include "SilhouetteFinder.h"

#include <array>

namespace po
{
struct SilhouetteStyle
{
  std::array<float, 3> color{ 0, 0, 0 }; ///< 0 to 1
  float opacity = 1;                     ///< 0 to 1
  /// Take the colour in front of the line, darkened, in place of `color`.
  bool darken = false;
};

/// What is left of a colour that is darkened.
constexpr float SilhouetteDarkness = 0.35F;

/// Lines as pixels to be blended over a picture.
struct SilhouettePixels
{
  std::vector<std::uint8_t> rgba; ///< alpha is what they cover of a pixel, times the opacity
  std::vector<float> depth;       ///< window depth of what is in front of the line, or NoLineDepth
  std::vector<std::uint16_t> tileRows; ///< as in SilhouetteImage
};

/// What lines are coloured and placed by, for each pixel; null: not known.
struct SilhouetteSurroundings
{
  const std::uint8_t* rgba = nullptr; ///< of the picture
  const float* windowDepth = nullptr;
  /// Of what is in front of the line in a pixel, in place of `windowDepth`.
  const float* lineDepth = nullptr;
};

/// Colours lines. Without a window depth lines lie in front of everything (0). Rows of tiles
/// without lines are written only where there were lines before. `lines.front` is needed for what
/// is known of the surroundings.
///
/// A line along a rim covers part of a pixel, and the sphere another part, though a picture of one
/// ray a pixel shows what is behind there. With `surroundings.rgba` that part takes the sphere's
/// colour: a bright background would shine through between sphere and line otherwise.
void colorSilhouettes(const SilhouetteImage& lines, const SilhouetteStyle& style,
  const SilhouetteSurroundings& surroundings, SilhouettePixels& pixels);
}

#endif
