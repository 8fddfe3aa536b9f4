// SPDX-License-Identifier: BSD-3-Clause
#include "DepthLaplacian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace po
{
namespace
{

template <typename T>
double DepthAt(const DepthImage<T>& image, int i, int j, double background)
{
  const int column = std::clamp(i, 0, image.Width - 1);
  const int row = std::clamp(j, 0, image.Height - 1);
  const double depth = image.Depth[static_cast<std::size_t>(row) * image.Width + column];
  return std::isfinite(depth) ? depth : background;
}

} // namespace

template <typename T>
std::optional<double> FarthestDepth(const DepthImage<T>& image)
{
  std::optional<double> farthest;
  const std::size_t count = static_cast<std::size_t>(image.Width) * image.Height;
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    const double depth = image.Depth[pixel];
    if (std::isfinite(depth) && (!farthest || depth > *farthest))
    {
      farthest = depth;
    }
  }
  return farthest;
}

EdgeRule ResolveEdgeRule(const SilhouetteParameters& parameters, std::optional<double> farthest)
{
  const double depth = farthest.value_or(0.0);
  const double automatic = AutomaticThresholdShare * std::abs(depth);
  const double threshold = parameters.Threshold > 0.0 ? parameters.Threshold : automatic;
  const double behind = depth + BackgroundMargin * std::max(threshold, automatic);
  return { threshold, parameters.BackgroundDepth > 0.0 ? parameters.BackgroundDepth : behind };
}

template <typename T>
double DepthLaplacian(const DepthImage<T>& image, int i, int j, double background)
{
  // A sum of differences, because 8 t - (sum of neighbours) would cancel: neighbouring depths are
  // close, and their differences are exact.
  const double center = DepthAt(image, i, j, background);
  double sum = 0.0;
  for (int dj = -1; dj <= 1; ++dj)
  {
    for (int di = -1; di <= 1; ++di)
    {
      sum += center - DepthAt(image, i + di, j + dj, background);
    }
  }
  return sum;
}

template <typename T>
void MarkSilhouettes(
  const DepthImage<T>& image, const EdgeRule& rule, const PixelBlock& block, float* strength)
{
  for (int j = block.RowBegin; j < block.RowEnd; ++j)
  {
    float* row = strength + static_cast<std::size_t>(j) * image.Width;
    for (int i = block.ColumnBegin; i < block.ColumnEnd; ++i)
    {
      row[i] = DepthLaplacian(image, i, j, rule.Background) > rule.Threshold ? 1.0F : 0.0F;
    }
  }
}

template std::optional<double> FarthestDepth(const DepthImage<float>&);
template std::optional<double> FarthestDepth(const DepthImage<double>&);
template double DepthLaplacian(const DepthImage<float>&, int, int, double);
template double DepthLaplacian(const DepthImage<double>&, int, int, double);
template void MarkSilhouettes(const DepthImage<float>&, const EdgeRule&, const PixelBlock&, float*);
template void MarkSilhouettes(
  const DepthImage<double>&, const EdgeRule&, const PixelBlock&, float*);

} // namespace po
