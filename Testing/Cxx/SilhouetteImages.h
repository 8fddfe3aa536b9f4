// SPDX-License-Identifier: BSD-3-Clause
#ifndef SilhouetteImages_h
#define SilhouetteImages_h

#include "ImageDepth.h"
#include "SilhouetteFinder.h"

#include <functional>
#include <limits>
#include <vector>

/// Depth images of functions, and their lines.
namespace silhouette_images
{
constexpr int Width = 41;
constexpr int Height = 37;
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

using DepthFunction = std::function<double(double, double)>;

/// Depths at the centres of samples x samples parts of each pixel; pixel i reaches from i to i + 1.
inline std::vector<double> makeDepth(
  const DepthFunction& depth, int width = Width, int height = Height, int samples = 1)
{
  std::vector<double> image;
  for (int j = 0; j < height * samples; ++j)
  {
    for (int i = 0; i < width * samples; ++i)
    {
      image.push_back(depth((i + 0.5) / samples, (j + 0.5) / samples));
    }
  }
  return image;
}

inline po::SilhouetteParameters jagged(double threshold = 0)
{
  po::SilhouetteParameters parameters;
  parameters.threshold = threshold;
  parameters.samples = 1;
  return parameters;
}

inline po::LinePixels<float> lines(const std::vector<double>& depth,
  const po::SilhouetteParameters& parameters, int width = Width, int height = Height,
  const po::SilhouetteOptions& options = {})
{
  const int samples = parameters.samples;
  const po::ImageDepth<double> source(
    po::DepthImage<double>{ depth.data(), width * samples, height * samples }, samples);
  po::SilhouetteImage image;
  const po::SilhouetteScale scale{ 0, po::depthSpread(source) };
  po::findSilhouettes(source, po::resolve(parameters, scale), image, options);
  return image.strength;
}
}

#endif
