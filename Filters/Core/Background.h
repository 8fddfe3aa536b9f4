// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Background_h
#define po_Background_h

#include "Vec3.h"

#include <variant>
#include <vector>

namespace po
{
/// The same luminance from everywhere: 1.
struct UniformBackground
{
};

/// Luminance linear in the height of the direction: `bottom` against `up`, `top` along it.
struct GradientBackground
{
  Vec3d up{ 0, 0, 1 }; ///< any length but zero
  double bottom = 0;   ///< at least 0
  double top = 1;      ///< at least 0
};

/// A panorama in latitude and longitude, laid out like a texture of a sphere (see TexelMap.h):
/// the first row is at +z, the first column at +x, columns go towards +y.
struct ImageBackground
{
  int width = 0;
  int height = 0;
  std::vector<float> luminance; ///< row-major, width * height values, at least 0
};

/// The light that occlusion takes away.
using Background = std::variant<UniformBackground, GradientBackground, ImageBackground>;

/// Luminance seen in a direction (a unit vector). Images are interpolated bilinearly.
[[nodiscard]] double luminance(const Background& background, Vec3d direction);
}

#endif
