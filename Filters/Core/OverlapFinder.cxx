// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapFinder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace po
{
namespace
{
/// A box edge moved outward by two units in the last place of the largest term, so that rounding
/// can not lose a neighbour.
float outward(float center, float reach)
{
  const float slack =
    2 * std::numeric_limits<float>::epsilon() * (std::abs(center) + std::abs(reach));
  return center + reach + std::copysign(slack, reach);
}

void sphereBounds(const RTCBoundsFunctionArguments* arguments)
{
  const Sphere& s = static_cast<const Sphere*>(arguments->geometryUserPtr)[arguments->primID];
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = outward(s.x, -s.radius);
  box.lower_y = outward(s.y, -s.radius);
  box.lower_z = outward(s.z, -s.radius);
  box.upper_x = outward(s.x, +s.radius);
  box.upper_y = outward(s.y, +s.radius);
  box.upper_z = outward(s.z, +s.radius);
}

struct Query
{
  const Sphere* spheres;
  unsigned id;
  Overlaps* result;
  bool outOfMemory; ///< Embree would swallow the exception, and overlaps would be missing
};

/// How sphere `other` cuts the surface of `self`. With d from self to other, a surface point c + r
/// n is inside when |r n - d|^2 < R^2, that is n . d > (|d|^2 + r^2 - R^2) / 2 r.
void addOverlap(const Sphere& self, const Sphere& other, Overlaps& result)
{
  const Vec3d d = other.center().as<double>() - self.center().as<double>();
  const double r = self.radius;
  const double radius = other.radius;
  const double distance = length(d);
  // r - R and r + R are taken first: a difference of squares would cancel.
  const double excess = (r - radius) * (r + radius);
  if (distance == 0)
  {
    result.buried = result.buried || excess < 0;
    return;
  }
  const double cosine = (distance * distance + excess) / (2 * r * distance);
  if (cosine <= -1)
  {
    result.buried = true;
  }
  else if (cosine < 1)
  {
    result.caps.push_back({ (1 / distance) * d, cosine });
  }
}

bool visitNeighbour(RTCPointQueryFunctionArguments* arguments)
{
  auto* query = static_cast<Query*>(arguments->userPtr);
  if (arguments->primID != query->id)
  {
    try
    {
      addOverlap(query->spheres[query->id], query->spheres[arguments->primID], *query->result);
    }
    catch (const std::bad_alloc&)
    {
      query->outOfMemory = true;
    }
  }
  return false; // the radius of the query did not change
}

float gapBetween(const Sphere& a, const Sphere& b)
{
  return length(b.center() - a.center()) - a.radius - b.radius;
}

/// Rounding must not lose a box that just comes within the radius.
RTCPointQuery queryAround(const Sphere& sphere, float radius)
{
  RTCPointQuery point;
  point.x = sphere.x;
  point.y = sphere.y;
  point.z = sphere.z;
  point.time = 0;
  point.radius = radius * (1 + 4 * std::numeric_limits<float>::epsilon());
  return point;
}

struct NearQuery
{
  const Sphere* spheres;
  unsigned id;
  float reach;
  std::size_t limit;
  std::vector<Neighbour>* nearest; ///< a heap, the farthest on top
};

/// Keeps the nearest. Boxes reach farther than their spheres: the gap decides.
bool visitNear(RTCPointQueryFunctionArguments* arguments)
{
  const auto* query = static_cast<const NearQuery*>(arguments->userPtr);
  const Sphere& self = query->spheres[query->id];
  const Sphere& other = query->spheres[arguments->primID];
  const Neighbour found{ arguments->primID, gapBetween(self, other) };
  std::vector<Neighbour>& nearest = *query->nearest;
  const bool full = nearest.size() == query->limit;
  if (found.id == query->id || found.gap > query->reach || (full && !(found < nearest.front())))
  {
    return false;
  }
  if (full)
  {
    std::pop_heap(nearest.begin(), nearest.end());
    nearest.pop_back();
  }
  nearest.push_back(found);
  std::push_heap(nearest.begin(), nearest.end());
  return false;
}

struct AnyQuery
{
  const Sphere* spheres;
  unsigned id;
  float reach;
  bool found;
};

bool visitAny(RTCPointQueryFunctionArguments* arguments)
{
  auto* query = static_cast<AnyQuery*>(arguments->userPtr);
  if (query->found || arguments->primID == query->id ||
    gapBetween(query->spheres[query->id], query->spheres[arguments->primID]) > query->reach)
  {
    return false;
  }
  query->found = true;
  arguments->query->radius = 0; // there is nothing more to look for
  return true;
}
}

OverlapFinder::OverlapFinder(const std::vector<Sphere>& spheres)
  : spheres_(&spheres)
  , device_(makeDevice(spheres.size()))
  , scene_(makeScene(device_.get()))
{
  const GeometryHandle geometry =
    makeGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER, "EMBREE_GEOMETRY_USER");
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(spheres.size()));
  rtcSetGeometryUserData(geometry.get(), const_cast<Sphere*>(spheres.data()));
  rtcSetGeometryBoundsFunction(
    geometry.get(), [](const RTCBoundsFunctionArguments* a) { sphereBounds(a); }, nullptr);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
  rtcCommitScene(scene_.get());
  throwOnError(device_.get(), "building the search structure for overlaps");
}

void OverlapFinder::find(unsigned id, Overlaps& result) const
{
  result.buried = false;
  result.caps.clear();
  const Sphere& self = (*spheres_)[id];
  Query query{ spheres_->data(), id, &result, false };
  RTCPointQuery point = queryAround(self, self.radius);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &point, &context, visitNeighbour, &query);
  if (query.outOfMemory)
  {
    throw std::bad_alloc();
  }
}

void OverlapFinder::findNear(
  unsigned id, float reach, std::size_t limit, std::vector<Neighbour>& result) const
{
  result.clear();
  result.reserve(std::min(limit, spheres_->size())); // so that visitNear allocates nothing
  const Sphere& self = (*spheres_)[id];
  NearQuery query{ spheres_->data(), id, reach, limit, &result };
  RTCPointQuery point = queryAround(self, self.radius + reach);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &point, &context, visitNear, &query);
  std::sort_heap(result.begin(), result.end());
}

bool OverlapFinder::hasNear(unsigned id, float reach) const
{
  const Sphere& self = (*spheres_)[id];
  AnyQuery query{ spheres_->data(), id, reach, false };
  RTCPointQuery point = queryAround(self, self.radius + reach);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &point, &context, visitAny, &query);
  return query.found;
}
}
