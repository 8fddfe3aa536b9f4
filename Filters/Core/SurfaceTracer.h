// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SurfaceTracer_h
#define po_SurfaceTracer_h

#include "SingleRay.h"
#include "SphereScene.h"
#include "SurfaceRay.h"

namespace po
{
/// Occlusion tests of many single rays from the surface of one sphere: SphereScene::occluded() with
/// all that they have in common done once.
class SurfaceTracer
{
public:
  /// @param scene must outlive this
  /// @param own the sphere
  /// @param distance local length of the rays, infinity for unbounded ones
  SurfaceTracer(const SphereScene& scene, unsigned own, float distance)
    : scene_(scene)
    , own_(own)
    , distance_(distance)
    , direct_(scene.isPlain() ? scene.handle() : nullptr)
  {
  }

  [[nodiscard]] bool occluded(const SurfaceRay& ray) const
  {
    if (direct_ && ray.start)
    {
      RayQueryContext context;
      initRayQueryContext(context, false);
      return isStopped(direct_, context, ray.origin, *ray.start, ray.direction, distance_);
    }
    return scene_.occluded(ray.origin, ray.direction, distance_, own_);
  }

private:
  const SphereScene& scene_;
  unsigned own_;
  float distance_;
  RTCScene direct_; ///< that rays can be traced in as they are; null if there is none
};
}

#endif
