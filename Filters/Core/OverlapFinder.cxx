// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapFinder.h"

#include "SphereBoxes.h"

#include <hwy/base.h>

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

void boxBounds(const RTCBoundsFunctionArguments* arguments)
{
  const auto& boxes = *static_cast<const SphereBoxes*>(arguments->geometryUserPtr);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  RTCBounds box{ infinity, infinity, infinity, 0, -infinity, -infinity, -infinity, 0 };
  for (std::size_t i = 0; i < boxes.spheresIn(arguments->primID); ++i)
  {
    const Sphere& s = boxes.sphere(arguments->primID, i);
    box.lower_x = std::min(box.lower_x, outward(s.x, -s.radius));
    box.lower_y = std::min(box.lower_y, outward(s.y, -s.radius));
    box.lower_z = std::min(box.lower_z, outward(s.z, -s.radius));
    box.upper_x = std::max(box.upper_x, outward(s.x, +s.radius));
    box.upper_y = std::max(box.upper_y, outward(s.y, +s.radius));
    box.upper_z = std::max(box.upper_z, outward(s.z, +s.radius));
  }
  *arguments->bounds_o = box;
}

/// What Embree calls back with: a box of a brick stands for some spheres of the set.
struct Query
{
  static constexpr unsigned NoId = std::numeric_limits<unsigned>::max();

  Query(const SphereSet& set, unsigned number)
    : Query(set, number, set.center(number), set.spheres()[number].radius)
  {
  }
  Query(const SphereSet& set, const Sphere& sphere)
    : Query(set, NoId, sphere.center().as<double>(), sphere.radius)
  {
  }

  const SphereSet* spheres;
  unsigned id; ///< in the set, if it is one of these
  Vec3d center;
  float radius;
  const SphereBoxes* boxes = nullptr; ///< that are being searched
  Vec3f place;                        ///< the centre relative to their brick
  float within = 0;                   ///< distance from there at which others begin

  /// Calls action(id) for the other spheres of a box that come within that distance, and maybe
  /// for some that just do not.
  template <typename Action>
  void forOthers(const RTCPointQueryFunctionArguments* arguments, Action action) const
  {
    const unsigned box = arguments->primID;
    for (unsigned near = boxes->near(box, place, within); near != 0; near &= near - 1)
    {
      const unsigned other = boxes->id(box, hwy::Num0BitsBelowLS1Bit_Nonzero32(near));
      if (other != id)
      {
        action(other);
      }
    }
  }
  [[nodiscard]] Vec3d offsetTo(unsigned other) const { return spheres->center(other) - center; }

private:
  Query(const SphereSet& set, unsigned number, Vec3d place, float size)
    : spheres(&set)
    , id(number)
    , center(place)
    , radius(size)
  {
  }
};

struct OverlapQuery : Query
{
  using Query::Query;
  Overlaps* result = nullptr;
  bool outOfMemory = false; ///< Embree would swallow the exception, and overlaps would be missing
};

/// A surface point c + r n of a sphere is inside one of radius R at d when |r n - d|^2 < R^2, that
/// is n . d > (|d|^2 + r^2 - R^2) / 2 r.
double cosineOfCap(double r, double distance, double radius)
{
  // r - R and r + R are taken first: a difference of squares would cancel.
  const double excess = (r - radius) * (r + radius);
  return (distance * distance + excess) / (2 * r * distance);
}

/// How a sphere of radius `radius`, at `d` from one of radius r, cuts the surface of that one.
void addOverlap(double r, Vec3d d, double radius, unsigned other, Overlaps& result)
{
  // Most are too far away: told without a root. Where rounding might matter it is told below.
  const double reach = r + radius;
  if (dot(d, d) > reach * reach * (1 + 1e-9))
  {
    return;
  }
  const double distance = length(d);
  if (distance == 0)
  {
    result.buried = result.buried || r < radius;
    return;
  }
  const double cosine = cosineOfCap(r, distance, radius);
  if (cosine <= -1)
  {
    result.buried = true;
  }
  else if (cosine < 1)
  {
    result.caps.push_back({ (1 / distance) * d, cosine, other });
  }
}

bool visitOverlaps(RTCPointQueryFunctionArguments* arguments)
{
  auto* query = static_cast<OverlapQuery*>(arguments->userPtr);
  const std::vector<Sphere>& spheres = query->spheres->spheres();
  try
  {
    query->forOthers(arguments,
      [&](unsigned other)
      {
        addOverlap(
          query->radius, query->offsetTo(other), spheres[other].radius, other, *query->result);
      });
  }
  catch (const std::bad_alloc&)
  {
    query->outOfMemory = true;
  }
  return false; // the radius of the query did not change
}

float gapTo(const Query& query, unsigned other)
{
  return length(query.offsetTo(other).as<float>()) - query.radius -
    query.spheres->spheres()[other].radius;
}

struct NearQuery : Query
{
  using Query::Query;
  float reach = 0;
  std::size_t limit = 0;
  std::vector<Neighbour>* nearest = nullptr; ///< a heap, the farthest on top
};

/// Keeps a sphere if it is among the nearest.
void keepNear(const NearQuery& query, unsigned other)
{
  const Neighbour found{ other, gapTo(query, other) };
  std::vector<Neighbour>& nearest = *query.nearest;
  const bool full = nearest.size() == query.limit;
  if (found.gap > query.reach || (full && !(found < nearest.front())))
  {
    return;
  }
  if (full)
  {
    std::pop_heap(nearest.begin(), nearest.end());
    nearest.pop_back();
  }
  nearest.push_back(found);
  std::push_heap(nearest.begin(), nearest.end());
}

bool visitNear(RTCPointQueryFunctionArguments* arguments)
{
  const auto* query = static_cast<const NearQuery*>(arguments->userPtr);
  query->forOthers(arguments, [query](unsigned other) { keepNear(*query, other); });
  return false;
}

struct AnyQuery : Query
{
  using Query::Query;
  float reach = 0;
  bool isFound = false;
};

bool visitAny(RTCPointQueryFunctionArguments* arguments)
{
  auto* query = static_cast<AnyQuery*>(arguments->userPtr);
  if (query->isFound)
  {
    return false;
  }
  query->forOthers(arguments,
    [query](unsigned other)
    { query->isFound = query->isFound || gapTo(*query, other) <= query->reach; });
  if (query->isFound)
  {
    arguments->query->radius = 0; // there is nothing more to look for
  }
  return query->isFound;
}

/// Is the point within `reach` of what the brick holds? Rounding may make it so, never prevent it.
bool isWithin(const Brick& brick, Vec3d point, double reach)
{
  const double wide = reach * (1 + 1e-6) + 1e-12 * length(brick.high - brick.low);
  return point.x >= brick.low.x - wide && point.x <= brick.high.x + wide &&
    point.y >= brick.low.y - wide && point.y <= brick.high.y + wide &&
    point.z >= brick.low.z - wide && point.z <= brick.high.z + wide;
}
}

BuriedCap capBetween(const SphereSet& spheres, unsigned id, unsigned other)
{
  const Vec3d d = spheres.center(other) - spheres.center(id);
  const double distance = length(d);
  return { (1 / distance) * d,
    cosineOfCap(spheres.spheres()[id].radius, distance, spheres.spheres()[other].radius), other };
}

OverlapFinder::OverlapFinder(const SphereSet& spheres)
  : spheres_(&spheres)
  , device_(makeDevice(spheres.size()))
{
  for (const Brick& brick : spheres.bricks())
  {
    addBoxes(brick);
  }
}

OverlapFinder::~OverlapFinder() = default;

void OverlapFinder::addBoxes(const Brick& brick)
{
  boxes_.push_back(std::make_unique<const SphereBoxes>(brick));
  const SphereBoxes& boxes = *boxes_.back();
  scenes_.push_back(makeScene(device_.get()));
  const GeometryHandle geometry =
    makeGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER, "EMBREE_GEOMETRY_USER");
  rtcSetGeometryUserPrimitiveCount(geometry.get(), boxes.count());
  rtcSetGeometryUserData(geometry.get(), const_cast<SphereBoxes*>(&boxes));
  rtcSetGeometryBoundsFunction(
    geometry.get(), [](const RTCBoundsFunctionArguments* a) { boxBounds(a); }, nullptr);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scenes_.back().get(), geometry.get());
  commitScene(device_.get(), scenes_.back(), "building the search structure for overlaps");
}

/// Calls visit for all spheres whose box comes within `reach` of the surface of the query's sphere.
template <typename Specific>
void OverlapFinder::search(Specific& query, float reach, RTCPointQueryFunction visit) const
{
  const float radius = query.radius + reach;
  for (std::size_t i = 0; i < scenes_.size(); ++i)
  {
    const Brick& brick = spheres_->bricks()[i];
    query.boxes = boxes_[i].get();
    if (scenes_.size() > 1 && !isWithin(brick, query.center, radius))
    {
      continue;
    }
    const Vec3f place = (query.center - brick.origin).template as<float>();
    // Rounding must not lose a box or a sphere that just comes within the radius.
    const float size = radius + std::abs(place.x) + std::abs(place.y) + std::abs(place.z);
    query.place = place;
    query.within = radius + 4 * std::numeric_limits<float>::epsilon() * size;
    RTCPointQuery point;
    point.x = place.x;
    point.y = place.y;
    point.z = place.z;
    point.time = 0;
    point.radius = query.within;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scenes_[i].get(), &point, &context, visit, &query);
  }
}

void OverlapFinder::find(unsigned id, Overlaps& result) const
{
  result.buried = false;
  result.caps.clear();
  OverlapQuery query(*spheres_, id);
  query.result = &result;
  search(query, 0, visitOverlaps);
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
  NearQuery query(*spheres_, id);
  query.reach = reach;
  query.limit = limit;
  query.nearest = &result;
  search(query, reach, visitNear);
  std::sort_heap(result.begin(), result.end());
}

bool OverlapFinder::hasNear(unsigned id, float reach) const
{
  AnyQuery query(*spheres_, id);
  query.reach = reach;
  search(query, reach, visitAny);
  return query.isFound;
}

bool OverlapFinder::hasNear(const Sphere& sphere, float reach) const
{
  AnyQuery query(*spheres_, sphere);
  query.reach = reach;
  search(query, reach, visitAny);
  return query.isFound;
}
}
