// SPDX-License-Identifier: BSD-3-Clause
#include "DepthLaplacian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace po
{
namespace
{
template <typename T>
double depthAt(const DepthImage<T>& image, int i, int j, double background)
{
  const int column = std::clamp(i, 0, image.width - 1);
  const int row = std::clamp(j, 0, image.height - 1);
  const double depth = image.depth[static_cast<std::size_t>(row) * image.width + column];
  return std::isfinite(depth) ? depth : background;
}

bool isLength(double value)
{
  return value >= 0.0 && std::isfinite(value);
}
}

std::string faultOf(const SilhouetteParameters& parameters)
{
  std::ostringstream fault;
  if (!isLength(parameters.threshold))
  {
    fault << "Threshold is " << parameters.threshold
          << "; it must be a length >= 0 in world units (0: automatic).";
  }
  else if (!isLength(parameters.backgroundDepth))
  {
    fault << "BackgroundDepth is " << parameters.backgroundDepth
          << "; it must be a depth >= 0 in world units (0: automatic).";
  }
  return fault.str();
}

template <typename T>
std::optional<double> farthestDepth(const DepthImage<T>& image)
{
  std::optional<double> farthest;
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    const double depth = image.depth[pixel];
    if (std::isfinite(depth) && (!farthest || depth > *farthest))
    {
      farthest = depth;
    }
  }
  return farthest;
}

EdgeRule resolveEdgeRule(const SilhouetteParameters& parameters, std::optional<double> farthest)
{
  const double depth = farthest.value_or(0.0);
  const double automatic = AutomaticThresholdShare * std::abs(depth);
  const double threshold = parameters.threshold > 0.0 ? parameters.threshold : automatic;
  const double behind = depth + BackgroundMargin * std::max(threshold, automatic);
  return { threshold, parameters.backgroundDepth > 0.0 ? parameters.backgroundDepth : behind };
}

template <typename T>
double depthLaplacian(const DepthImage<T>& image, int i, int j, double background)
{
  // A sum of differences, because 8 t - (sum of neighbours) would cancel: neighbouring depths are
  // close, and their differences are exact.
  const double center = depthAt(image, i, j, background);
  double sum = 0.0;
  for (int dj = -1; dj <= 1; ++dj)
  {
    for (int di = -1; di <= 1; ++di)
    {
      sum += center - depthAt(image, i + di, j + dj, background);
    }
  }
  return sum;
}

template <typename T>
void markSilhouettes(
  const DepthImage<T>& image, const EdgeRule& rule, const PixelBlock& block, float* strength)
{
  for (int j = block.rowBegin; j < block.rowEnd; ++j)
  {
    float* row = strength + static_cast<std::size_t>(j) * image.width;
    for (int i = block.columnBegin; i < block.columnEnd; ++i)
    {
      row[i] = depthLaplacian(image, i, j, rule.background) > rule.threshold ? 1.0F : 0.0F;
    }
  }
}

template std::optional<double> farthestDepth(const DepthImage<float>&);
template std::optional<double> farthestDepth(const DepthImage<double>&);
template double depthLaplacian(const DepthImage<float>&, int, int, double);
template double depthLaplacian(const DepthImage<double>&, int, int, double);
template void markSilhouettes(const DepthImage<float>&, const EdgeRule&, const PixelBlock&, float*);
template void markSilhouettes(
  const DepthImage<double>&, const EdgeRule&, const PixelBlock&, float*);
}
