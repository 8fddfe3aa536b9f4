// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TracedLayers_h
#define po_TracedLayers_h

#include "SilhouettePixels.h"
#include "TracedDepth.h"

#include <optional>
#include <vector>

class vtkActor;
class vtkProp;
class vtkRenderer;

namespace po
{
class SphereRenderer;

/// A mapper of ray-traced spheres that has a frame, with its actor.
struct TracedActor
{
  vtkActor* actor;
  const SphereRenderer* renderer;
};

/// The prop as an actor of ray-traced spheres whose last frame is of this size; null pointers if it
/// is none.
[[nodiscard]] TracedActor tracedActorOf(vtkProp* prop, int width, int height);

[[nodiscard]] std::vector<TracedLayer> layersOf(const std::vector<TracedActor>& actors);
[[nodiscard]] TracedDepth depthOf(const std::vector<TracedActor>& actors);

/// Mean radius over all particles, those of other processes included (see
/// vtkRayTracedSphereMapper::SetWholeSet), the largest diagonal of an actor's bounds, and the least
/// free length of an actor's spheres, in world units. Nothing if there are no particles.
[[nodiscard]] std::optional<SilhouetteScale> scaleOf(const std::vector<vtkActor*>& actors);

[[nodiscard]] std::vector<vtkActor*> actorsOf(const std::vector<TracedActor>& traced);

/// Window depth of each pixel, the nearest of all actors. `merged` is where depths are put
/// together, if there is more than one actor.
[[nodiscard]] const float* windowDepthOf(
  const std::vector<TracedActor>& actors, std::vector<float>& merged);

/// RGBA bytes of each pixel, of the nearest of all actors. `merged` is where they are put together,
/// if there is more than one actor.
[[nodiscard]] const std::uint8_t* colorsOf(
  const std::vector<TracedActor>& actors, std::vector<std::uint8_t>& merged);

/// Does the window show one tile of a larger picture?
[[nodiscard]] bool isTile(vtkRenderer* renderer);

/// Pixels around a tile that its lines depend on: their width, and some for the jump, the slopes
/// and rounding.
[[nodiscard]] int tileMarginOf(const SilhouetteParameters& parameters);

/// Style of an object with vtkSilhouetteStyleMacro.
template <typename Object>
[[nodiscard]] SilhouetteStyle silhouetteStyleOf(Object& object)
{
  const double* color = object.GetColor();
  return { { static_cast<float>(color[0]), static_cast<float>(color[1]),
             static_cast<float>(color[2]) },
    static_cast<float>(object.GetOpacity()), object.GetDarken() };
}
}

#endif
