// SPDX-License-Identifier: BSD-3-Clause
#include "Background.h"

#include "TexelMap.h"

namespace po
{
namespace
{
double luminanceOf(const UniformBackground&, Vec3d)
{
  return 1;
}

double luminanceOf(const GradientBackground& gradient, Vec3d direction)
{
  const double height = (1 + dot(normalized(gradient.up), direction)) / 2;
  return gradient.bottom + height * (gradient.top - gradient.bottom);
}

double luminanceOf(const ImageBackground& image, Vec3d direction)
{
  const BilinearTexels texels =
    bilinearTexels(image.width, image.height, textureCoordinate(direction));
  double value = 0;
  for (std::size_t k = 0; k < texels.index.size(); ++k)
  {
    value += static_cast<double>(texels.weight[k]) * image.luminance[texels.index[k]];
  }
  return value;
}
}

double luminance(const Background& background, Vec3d direction)
{
  return std::visit(
    [direction](const auto& kind) { return luminanceOf(kind, direction); }, background);
}
}
