// SPDX-License-Identifier: BSD-3-Clause
#ifndef TracedSilhouetteTestScene_h
#define TracedSilhouetteTestScene_h

#include "ImageDepth.h"
#include "SilhouetteRims.h"
#include "SphereRenderer.h"
#include "TestViews.h"
#include "TracedDepth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

/// Traced spheres and their lines.
namespace traced_silhouettes
{
using namespace po;

inline SphereCloud cloudOf(const std::vector<std::array<double, 4>>& spheres)
{
  return makeSphereCloud(
    spheres.size(),
    [&](std::size_t i) {
      return Vec3d{ spheres[i][0], spheres[i][1], spheres[i][2] };
    },
    [&](std::size_t i) { return spheres[i][3]; });
}

/// Spheres of radii 0.5 to 1.5 in a box of 20, fixed seed.
inline std::vector<std::array<double, 4>> heap()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 10), radius(0.5, 1.5);
  std::vector<std::array<double, 4>> spheres(400);
  for (auto& sphere : spheres)
  {
    sphere = { place(random), place(random), place(random), radius(random) };
  }
  return spheres;
}

struct Traced
{
  SphereRenderer renderer;

  Traced(const std::vector<std::array<double, 4>>& spheres, const Camera& camera)
  {
    renderer.setCloud(cloudOf(spheres));
    EXPECT_TRUE(renderer.trace(camera, Identity));
  }

  [[nodiscard]] TracedLayer layer() const
  {
    return { renderer.frame(), renderer.rays(), renderer.cloud().spheres };
  }

  SilhouetteImage lines(
    const SilhouetteParameters& parameters, const SilhouetteOptions& options = {}) const
  {
    SilhouetteImage image;
    find(parameters, options, image);
    return image;
  }

  void find(const SilhouetteParameters& parameters, const SilhouetteOptions& options,
    SilhouetteImage& image) const
  {
    findTracedSilhouettes(TracedDepth({ layer() }),
      resolve(parameters, { renderer.cloud().scale, 20 }), image, options);
  }
};

inline SilhouetteParameters threshold(double value, int samples)
{
  SilhouetteParameters parameters;
  parameters.threshold = value;
  parameters.samples = samples;
  return parameters;
}

/// What the image filter makes of samples x samples rays a pixel.
inline LinePixels<float> filtered(const std::vector<std::array<double, 4>>& spheres, Camera camera,
  const SilhouetteParameters& parameters)
{
  camera.width *= parameters.samples;
  camera.height *= parameters.samples;
  const Traced fine(spheres, camera);
  const TracedFrame& frame = fine.renderer.frame();
  const ImageDepth<double> source(
    DepthImage<double>{ frame.t.data(), frame.width, frame.height }, parameters.samples);
  SilhouetteImage image;
  findSilhouettes(source, resolve(parameters, { fine.renderer.cloud().scale, 20 }), image);
  return image.strength;
}

inline std::size_t count(const LinePixels<float>& strength)
{
  return static_cast<std::size_t>(
    std::count_if(strength.begin(), strength.end(), [](float s) { return s > 0; }));
}
}

#endif
