// SPDX-License-Identifier: BSD-3-Clause
#include "TracedLayers.h"

#include "SphereRenderer.h"
#include "vtkRayTracedSphereMapper.h"

#include "vtkActor.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace po
{
namespace
{
/// World length of a unit length of an actor's coordinates, in the mean over all directions.
double scaleOf(vtkActor* actor)
{
  return std::cbrt(std::abs(actor->GetMatrix()->Determinant()));
}
}

TracedActor tracedActorOf(vtkProp* prop, int width, int height)
{
  auto* actor = vtkActor::SafeDownCast(prop);
  auto* mapper = actor ? vtkRayTracedSphereMapper::SafeDownCast(actor->GetMapper()) : nullptr;
  if (!mapper)
  {
    return { nullptr, nullptr };
  }
  const SphereRenderer& renderer = mapper->GetSphereRenderer();
  const TracedFrame& frame = renderer.frame();
  const bool isCurrent = renderer.isShaded() && frame.width == width && frame.height == height;
  return isCurrent ? TracedActor{ actor, &renderer } : TracedActor{ nullptr, nullptr };
}

std::vector<TracedLayer> layersOf(const std::vector<TracedActor>& actors)
{
  std::vector<TracedLayer> layers;
  for (const TracedActor& one : actors)
  {
    layers.push_back(
      { one.renderer->frame(), one.renderer->rays(), one.renderer->cloud().spheres });
  }
  return layers;
}

TracedDepth depthOf(const std::vector<TracedActor>& actors)
{
  return TracedDepth(layersOf(actors));
}

std::optional<SilhouetteScale> scaleOf(const std::vector<vtkActor*>& actors)
{
  double radii = 0, count = 0, largest = 0;
  double freeLength = std::numeric_limits<double>::infinity();
  for (vtkActor* actor : actors)
  {
    auto* mapper = vtkRayTracedSphereMapper::SafeDownCast(actor->GetMapper());
    if (!mapper)
    {
      continue;
    }
    const double* whole = mapper->GetWholeSet();
    const SphereRenderer& renderer = mapper->GetSphereRenderer();
    const SphereCloud& cloud = renderer.cloud();
    const double scale = scaleOf(actor);
    const bool isShared = whole[0] > 0;
    const double particles = isShared ? whole[0] : static_cast<double>(cloud.spheres.size());
    radii += particles * scale * (isShared ? whole[1] : cloud.scale);
    count += particles;
    largest = std::max(largest, isShared ? scale * whole[2] : actor->GetLength());
    freeLength = std::min(freeLength, scale * (isShared ? whole[3] : renderer.freeLength()));
  }
  return count > 0 ? std::optional(SilhouetteScale{ radii / count, largest, freeLength })
                   : std::nullopt;
}

std::vector<vtkActor*> actorsOf(const std::vector<TracedActor>& traced)
{
  std::vector<vtkActor*> actors;
  std::transform(traced.begin(), traced.end(), std::back_inserter(actors),
    [](const TracedActor& one) { return one.actor; });
  return actors;
}

const float* windowDepthOf(const std::vector<TracedActor>& actors, std::vector<float>& merged)
{
  if (actors.size() == 1)
  {
    return actors.front().renderer->frame().windowDepth.data();
  }
  merged = actors.front().renderer->frame().windowDepth;
  for (std::size_t i = 1; i < actors.size(); ++i)
  {
    const std::vector<float>& other = actors[i].renderer->frame().windowDepth;
    std::transform(other.begin(), other.end(), merged.begin(), merged.begin(),
      [](float a, float b) { return std::min(a, b); });
  }
  return merged.data();
}

const std::uint8_t* colorsOf(
  const std::vector<TracedActor>& actors, std::vector<std::uint8_t>& merged)
{
  if (actors.size() == 1)
  {
    return actors.front().renderer->rgba().data();
  }
  merged = actors.front().renderer->rgba();
  std::vector<double> nearest = actors.front().renderer->frame().t;
  for (std::size_t i = 1; i < actors.size(); ++i)
  {
    const std::vector<double>& t = actors[i].renderer->frame().t;
    const std::vector<std::uint8_t>& other = actors[i].renderer->rgba();
    for (std::size_t pixel = 0; pixel < t.size(); ++pixel)
    {
      if (t[pixel] < nearest[pixel])
      {
        nearest[pixel] = t[pixel];
        std::copy_n(other.begin() + static_cast<std::ptrdiff_t>(4 * pixel), 4,
          merged.begin() + static_cast<std::ptrdiff_t>(4 * pixel));
      }
    }
  }
  return merged.data();
}

bool isTile(vtkRenderer* renderer)
{
  const int* scale = renderer->GetRenderWindow()->GetTileScale();
  return scale[0] > 1 || scale[1] > 1;
}

int tileMarginOf(const SilhouetteParameters& parameters)
{
  return static_cast<int>(std::max(parameters.width, parameters.maximumWidth)) + 4;
}
}
