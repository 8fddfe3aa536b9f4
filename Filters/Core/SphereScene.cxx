// SPDX-License-Identifier: BSD-3-Clause
#include "SphereScene.h"

#include "SingleRay.h"
#include "SurfaceRay.h"
#include "TriangleDistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <utility>

namespace po
{
namespace
{
struct OcclusionContext
{
  RayQueryContext embree; // first, so that the filter can cast back
  unsigned own;
  const std::uint8_t* hidden; // of each sphere, or null
};

/// So many rays are faster one by one than as a packet (measured).
constexpr unsigned FewRays = 3;

/// Rejects the ray's own sphere, hidden ones, and every sphere whose centre does not lie ahead.
void keepSpheresAhead(const RTCFilterFunctionNArguments* arguments)
{
  const auto* brick = static_cast<const Brick*>(arguments->geometryUserPtr);
  const auto* context = reinterpret_cast<const OcclusionContext*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i)
  {
    const bool onSphere =
      RTCHitN_geomID(arguments->hit, arguments->N, i) == SphereScene::SphereGeometry;
    if (arguments->valid[i] == 0 || !onSphere)
    {
      continue;
    }
    const unsigned place = RTCHitN_primID(arguments->hit, arguments->N, i);
    const Vec3f origin{ RTCRayN_org_x(arguments->ray, arguments->N, i),
      RTCRayN_org_y(arguments->ray, arguments->N, i),
      RTCRayN_org_z(arguments->ray, arguments->N, i) };
    const Vec3f direction{ RTCRayN_dir_x(arguments->ray, arguments->N, i),
      RTCRayN_dir_y(arguments->ray, arguments->N, i),
      RTCRayN_dir_z(arguments->ray, arguments->N, i) };
    const bool ahead = dot(brick->spheres[place].center() - origin, direction) > 0;
    const unsigned id = brick->id(place);
    const bool hidden = context->hidden && context->hidden[id] != 0;
    if (id == context->own || hidden || !ahead)
    {
      arguments->valid[i] = 0;
    }
  }
}

void addFlag(RTCScene scene, RTCSceneFlags flag)
{
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(rtcGetSceneFlags(scene) | flag));
}

struct MeshQuery
{
  const Vec3f* vertices;
  const std::array<unsigned, 3>* triangles;
  Vec3f point;
  float reach;
  bool found;
};

/// Embree tells of triangles whose box comes near; large ones that lie aslant need a closer look.
bool visitTriangle(RTCPointQueryFunctionArguments* arguments)
{
  auto* query = static_cast<MeshQuery*>(arguments->userPtr);
  if (arguments->geomID != SphereScene::TriangleGeometry || query->found)
  {
    return false;
  }
  const std::array<unsigned, 3>& corners = query->triangles[arguments->primID];
  query->found = triangleDistance(query->point, query->vertices[corners[0]],
                   query->vertices[corners[1]], query->vertices[corners[2]]) <= query->reach;
  if (!query->found)
  {
    return false;
  }
  arguments->query->radius = 0; // there is nothing more to look for
  return true;
}

template <typename Element>
void copyBuffer(
  RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<Element>& elements)
{
  void* buffer =
    rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size());
  if (!buffer)
  {
    throw std::bad_alloc();
  }
  std::copy(elements.begin(), elements.end(), static_cast<Element*>(buffer));
}
}

namespace
{
/// Clips [enter, leave] of a ray to one slab.
void clipSlab(
  double origin, double direction, double low, double high, double& enter, double& leave)
{
  if (direction == 0)
  {
    leave = origin < low || origin > high ? -HUGE_VAL : leave;
    return;
  }
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

/// May a ray meet what a brick holds? Directions are floats: far away their rounding counts.
bool mayMeet(const Brick& brick, Vec3d origin, Vec3f direction, double distance)
{
  const Vec3d d = direction.as<double>();
  const double slack = 1e-6 * (length(brick.high - brick.low) + length(brick.low - origin));
  const Vec3d grow{ slack, slack, slack };
  const Vec3d low = brick.low - grow;
  const Vec3d high = brick.high + grow;
  double enter = 0;
  double leave = distance;
  clipSlab(origin.x, d.x, low.x, high.x, enter, leave);
  clipSlab(origin.y, d.y, low.y, high.y, enter, leave);
  clipSlab(origin.z, d.z, low.z, high.z, enter, leave);
  return enter <= leave;
}
}

SphereScene::SphereScene(std::shared_ptr<const SphereSet> set, const OccluderMesh& mesh)
  : device_(makeDevice(set->size() + mesh.triangles.size()))
  , set_(std::move(set))
  , hasMesh_(!mesh.triangles.empty())
{
  for (const Brick& brick : set_->bricks())
  {
    scenes_.push_back(makeScene(device_.get()));
    addFlag(scenes_.back().get(), QueryFilterFlag);
    if (brick.count > 0)
    {
      addSpheres(scenes_.back().get(), brick);
    }
  }
  if (hasMesh_ && scenes_.size() > 1)
  {
    mesh_ = makeScene(device_.get());
    addTriangles(mesh_.get(), mesh);
    commitScene(device_.get(), mesh_, "building the scene of triangles");
  }
  else if (hasMesh_)
  {
    addTriangles(scenes_.front().get(), mesh);
  }
  for (SceneHandle& scene : scenes_)
  {
    commitScene(device_.get(), scene, "building the scene of spheres");
  }
}

void SphereScene::addSpheres(RTCScene scene, const Brick& brick)
{
  const GeometryHandle geometry =
    makeGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT, "EMBREE_GEOMETRY_POINT");
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
    brick.spheres, 0, sizeof(Sphere), brick.count);
  rtcSetGeometryUserData(geometry.get(), const_cast<Brick*>(&brick));
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene, geometry.get(), SphereGeometry);
}

void SphereScene::addTriangles(RTCScene scene, const OccluderMesh& mesh)
{
  if (rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_BACKFACE_CULLING_ENABLED) != 0)
  {
    throw std::runtime_error("This build of Embree sees triangles from one side only: "
                             "it was configured with EMBREE_BACKFACE_CULLING.");
  }
  const GeometryHandle geometry =
    makeGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE, "EMBREE_GEOMETRY_TRIANGLE");
  // Buffers of Embree's own: it reads up to 16 bytes at the last vertex.
  copyBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
  copyBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene, geometry.get(), TriangleGeometry);
  // Of rays aimed at edges that triangles share, 5 % slip through without this, 0.1 % with it.
  addFlag(scene, RTC_SCENE_FLAG_ROBUST);
}

bool SphereScene::occluded(
  Vec3f origin, Vec3f direction, float distance, unsigned own, const std::uint8_t* hidden) const
{
  Rays rays{ &origin, 1, direction, distance, own, hidden, {}, nullptr };
  chooseStarts(rays);
  return traceAll(rays) != 0;
}

unsigned SphereScene::occludedFrom(
  const Vec3f* origins, unsigned count, Vec3f direction, float distance, unsigned own) const
{
  Rays rays{ origins, count, direction, distance, own, nullptr, {}, nullptr };
  chooseStarts(rays);
  return traceAll(rays);
}

/// Rays begin beyond their own sphere, or else the filter is needed for all of them.
void SphereScene::chooseStarts(Rays& rays) const
{
  bool filtered = rays.own == None || rays.hidden != nullptr || hasMesh_;
  if (!filtered)
  {
    const Sphere own = set_->inBrick(rays.own);
    for (unsigned i = 0; i < rays.count; ++i)
    {
      const std::optional<float> start = rayStart(own, rays.origins[i], rays.direction);
      rays.starts[i] = start.value_or(0.0f);
      filtered = filtered || !start;
    }
  }
  rays.filter = filtered ? keepSpheresAhead : nullptr;
}

unsigned SphereScene::traceAll(const Rays& rays) const
{
  return scenes_.size() == 1 ? trace(scenes_.front().get(), rays) : traceBricks(rays);
}

/// Brick by brick, each relative to its own origin.
unsigned SphereScene::traceBricks(const Rays& rays) const
{
  const std::vector<Brick>& bricks = set_->bricks();
  const Vec3d home = rays.own == None ? Vec3d() : bricks[set_->brickOf(rays.own)].origin;
  std::array<Vec3f, PacketSize> origins;
  Rays moved = rays;
  moved.origins = origins.data();
  unsigned stopped = 0;
  const auto traceFrom = [&](RTCScene scene, Vec3d origin)
  {
    for (unsigned i = 0; i < rays.count; ++i)
    {
      origins[i] = (rays.origins[i].as<double>() + (home - origin)).as<float>();
    }
    stopped |= trace(scene, moved);
  };
  const unsigned all = (1u << rays.count) - 1;
  for (std::size_t i = 0; i < bricks.size() && stopped != all; ++i)
  {
    const auto meets = [&](Vec3f origin)
    { return mayMeet(bricks[i], home + origin.as<double>(), rays.direction, rays.distance); };
    if (std::any_of(rays.origins, rays.origins + rays.count, meets))
    {
      traceFrom(scenes_[i].get(), bricks[i].origin);
    }
  }
  if (mesh_ && stopped != all)
  {
    moved.filter = nullptr; // of spheres
    traceFrom(mesh_.get(), {});
  }
  return stopped;
}

unsigned SphereScene::trace(RTCScene scene, const Rays& rays) const
{
  return rays.count <= FewRays ? traceSingly(scene, rays) : tracePacket(scene, rays);
}

unsigned SphereScene::traceSingly(RTCScene scene, const Rays& rays) const
{
  OcclusionContext context;
  initRayQueryContext(context.embree, false);
  context.own = rays.own;
  context.hidden = rays.hidden;
  unsigned stopped = 0;
  for (unsigned i = 0; i < rays.count; ++i)
  {
    const bool hit = isStopped(scene, context.embree, rays.origins[i], rays.starts[i],
      rays.direction, rays.distance, rays.filter);
    stopped |= unsigned(hit) << i;
  }
  return stopped;
}

unsigned SphereScene::tracePacket(RTCScene scene, const Rays& rays) const
{
  OcclusionContext context;
  initRayQueryContext(context.embree, true);
  context.own = rays.own;
  context.hidden = rays.hidden;
  alignas(64) int valid[PacketSize];
  RTCRay16 packet;
  for (unsigned i = 0; i < PacketSize; ++i)
  {
    const unsigned source = i < rays.count ? i : 0;
    const Vec3f origin = rays.origins[source];
    valid[i] = i < rays.count ? -1 : 0;
    packet.org_x[i] = origin.x;
    packet.org_y[i] = origin.y;
    packet.org_z[i] = origin.z;
    packet.tnear[i] = rays.starts[source];
    packet.dir_x[i] = rays.direction.x;
    packet.dir_y[i] = rays.direction.y;
    packet.dir_z[i] = rays.direction.z;
    packet.time[i] = 0;
    packet.tfar[i] = rays.distance;
    packet.mask[i] = 0xFFFFFFFFu;
    packet.id[i] = i;
    packet.flags[i] = 0;
  }
  occluded16(valid, scene, context.embree, packet, rays.filter);
  unsigned stopped = 0;
  for (unsigned i = 0; i < rays.count; ++i)
  {
    stopped |= unsigned(packet.tfar[i] < 0) << i;
  }
  return stopped;
}

bool SphereScene::isMeshWithin(Vec3f point, float reach) const
{
  if (!hasMesh_)
  {
    return false;
  }
  const RTCScene scene = mesh_ ? mesh_.get() : scenes_.front().get();
  const RTCGeometry geometry = rtcGetGeometry(scene, TriangleGeometry);
  MeshQuery mesh{ static_cast<const Vec3f*>(
                    rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)),
    static_cast<const std::array<unsigned, 3>*>(
      rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0)),
    point, reach, false };
  RTCPointQuery query;
  query.x = point.x;
  query.y = point.y;
  query.z = point.z;
  query.time = 0;
  query.radius = reach;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene, &query, &context, visitTriangle, &mesh);
  return mesh.found;
}
}
