// SPDX-License-Identifier: BSD-3-Clause
#include "FrontFinder.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
RTCRayHit makeQuery(const PrimaryRay& ray, double start)
{
  const Vec3f origin = (ray.origin + start * ray.direction).as<float>();
  RTCRayHit query;
  query.ray.org_x = origin.x;
  query.ray.org_y = origin.y;
  query.ray.org_z = origin.z;
  query.ray.tnear = 0;
  query.ray.dir_x = static_cast<float>(ray.direction.x);
  query.ray.dir_y = static_cast<float>(ray.direction.y);
  query.ray.dir_z = static_cast<float>(ray.direction.z);
  query.ray.time = 0;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xFFFFFFFFu;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

Front findFrom(const SphereScene& scene, std::size_t brick, const std::uint8_t* hidden,
  const PrimaryRay& ray, double start, std::size_t& rays)
{
  ++rays;
  FrontQuery query;
  initRayQueryContext(query.embree, false);
  query.hidden = hidden;
  query.brick = &scene.set().bricks()[brick];
  query.ray = &ray;
  RTCRayHit hit = makeQuery(ray, start);
  intersect1(scene.handle(brick), query.embree, hit, passSpheres);
  Front front;
  if (hit.hit.geomID != RTC_INVALID_GEOMETRY_ID)
  {
    // The filter has let it pass, so this succeeds.
    const unsigned place = hit.hit.primID;
    (void)intersectExactly(ray, query.brick->spheres[place], query.brick->id(place), front);
  }
  return front;
}
}

void passSpheres(const RTCFilterFunctionNArguments* arguments)
{
  const auto* query = reinterpret_cast<const FrontQuery*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i)
  {
    if (arguments->valid[i] == 0)
    {
      continue;
    }
    const unsigned place = RTCHitN_primID(arguments->hit, arguments->N, i);
    const unsigned id = query->brick->id(place);
    Front front;
    const bool hidden = query->hidden && query->hidden[id] != 0;
    if (hidden ||
      (query->ray && !intersectExactly(*query->ray, query->brick->spheres[place], id, front)))
    {
      arguments->valid[i] = 0;
    }
  }
}

bool intersectExactly(const PrimaryRay& ray, const Sphere& sphere, std::uint32_t id, Front& front)
{
  const Vec3d fromCenter = ray.origin - sphere.center().as<double>();
  const double toNearest = -dot(fromCenter, ray.direction);
  const Vec3d nearest = fromCenter + toNearest * ray.direction;
  const double radius = sphere.radius;
  const double squared = radius * radius - dot(nearest, nearest);
  if (!(squared >= 0))
  {
    return false;
  }
  const double half = std::sqrt(squared);
  const double s = toNearest - half;
  if (s < ray.nearest || s > ray.farthest)
  {
    return false;
  }
  front = { s, id, (1 / radius) * (nearest - half * ray.direction) };
  return true;
}

Front findFront(const SphereScene& scene, std::size_t brick, const std::uint8_t* hidden,
  const PrimaryRay& ray, double start, std::size_t& rays)
{
  const Front front = findFrom(scene, brick, hidden, ray, start, rays);
  if (front.sphere == SphereScene::None)
  {
    return front;
  }
  const double radius = scene.spheres()[front.sphere].radius;
  const double way = front.s - start;
  if (way <= ReliableRadii * radius)
  {
    return front;
  }
  // Once more from close by, where floats can tell neighbours apart.
  const double closeBy = std::max(start, front.s - std::max(4 * radius, 1e-5 * way));
  const Front closer = findFrom(scene, brick, hidden, ray, closeBy, rays);
  return closer.sphere == SphereScene::None ? front : closer;
}
}
