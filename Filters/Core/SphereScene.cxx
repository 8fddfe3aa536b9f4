// SPDX-License-Identifier: BSD-3-Clause
#include "SphereScene.h"

#include "TriangleDistance.h"

#include <algorithm>
#include <cmath>
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
  const auto* spheres = static_cast<const Sphere*>(arguments->geometryUserPtr);
  const auto* context = reinterpret_cast<const OcclusionContext*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i)
  {
    if (arguments->valid[i] == 0)
    {
      continue;
    }
    const unsigned id = RTCHitN_primID(arguments->hit, arguments->N, i);
    const Vec3f origin{ RTCRayN_org_x(arguments->ray, arguments->N, i),
      RTCRayN_org_y(arguments->ray, arguments->N, i),
      RTCRayN_org_z(arguments->ray, arguments->N, i) };
    const Vec3f direction{ RTCRayN_dir_x(arguments->ray, arguments->N, i),
      RTCRayN_dir_y(arguments->ray, arguments->N, i),
      RTCRayN_dir_z(arguments->ray, arguments->N, i) };
    const bool ahead = dot(spheres[id].center() - origin, direction) > 0;
    const bool hidden = context->hidden && context->hidden[id] != 0;
    if (id == context->own || hidden || !ahead)
    {
      arguments->valid[i] = 0;
    }
  }
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
/// A distance beyond the rounding of a ray's start, and within a thousandth of the smallest radius;
/// 0 if there is none.
float startBeyondRounding(const std::vector<Sphere>& spheres)
{
  float extent = 0;
  float smallest = std::numeric_limits<float>::max();
  for (const Sphere& s : spheres)
  {
    extent = std::max(
      { extent, std::abs(s.x) + s.radius, std::abs(s.y) + s.radius, std::abs(s.z) + s.radius });
    smallest = std::min(smallest, s.radius);
  }
  const float start = 8 * std::numeric_limits<float>::epsilon() * extent;
  return start < 1e-3f * smallest ? start : 0.0f;
}
}

SphereScene::SphereScene(std::vector<Sphere> spheres, const OccluderMesh& mesh)
  : device_(makeDevice(spheres.size() + mesh.triangles.size()))
  , spheres_(std::move(spheres))
  , hasMesh_(!mesh.triangles.empty())
  , rayStart_(hasMesh_ ? 0.0f : startBeyondRounding(spheres_))
  , scene_(makeScene(device_.get()))
{
  rtcSetSceneFlags(scene_.get(), QueryFilterFlag);
  if (!spheres_.empty())
  {
    addSpheres();
  }
  if (hasMesh_)
  {
    addTriangles(mesh);
  }
  rtcCommitScene(scene_.get());
  throwOnError(device_.get(), "building the scene of spheres");
}

void SphereScene::addSpheres()
{
  const GeometryHandle geometry =
    makeGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT, "EMBREE_GEOMETRY_POINT");
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
    spheres_.data(), 0, sizeof(Sphere), spheres_.size());
  rtcSetGeometryUserData(geometry.get(), spheres_.data());
  rtcSetGeometryOccludedFilterFunction(geometry.get(), keepSpheresAhead);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene_.get(), geometry.get(), SphereGeometry);
}

void SphereScene::addTriangles(const OccluderMesh& mesh)
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
  rtcAttachGeometryByID(scene_.get(), geometry.get(), TriangleGeometry);
  // Of rays aimed at edges that triangles share, 5 % slip through without this, 0.1 % with it.
  rtcSetSceneFlags(
    scene_.get(), static_cast<RTCSceneFlags>(QueryFilterFlag | RTC_SCENE_FLAG_ROBUST));
}

bool SphereScene::occluded(
  Vec3f origin, Vec3f direction, float distance, unsigned own, const std::uint8_t* hidden) const
{
  OcclusionContext context;
  initRayQueryContext(context.embree, false);
  context.own = own;
  context.hidden = hidden;

  RTCRay ray;
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.tnear = own == None ? 0 : rayStart_;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.time = 0;
  ray.tfar = distance;
  ray.mask = 0xFFFFFFFFu;
  ray.id = 0;
  ray.flags = 0;
  occluded1(scene_.get(), context.embree, ray);
  return ray.tfar < 0; // Embree marks an occluded ray with -infinity
}

unsigned SphereScene::occludedFrom(
  const Vec3f* origins, unsigned count, Vec3f direction, float distance, unsigned own) const
{
  unsigned stopped = 0;
  if (count <= FewRays)
  {
    for (unsigned i = 0; i < count; ++i)
    {
      stopped |= unsigned(occluded(origins[i], direction, distance, own)) << i;
    }
    return stopped;
  }
  OcclusionContext context;
  initRayQueryContext(context.embree, true);
  context.own = own;
  context.hidden = nullptr;

  alignas(64) int valid[PacketSize];
  RTCRay16 rays;
  for (unsigned i = 0; i < PacketSize; ++i)
  {
    const Vec3f origin = origins[i < count ? i : 0];
    valid[i] = i < count ? -1 : 0;
    rays.org_x[i] = origin.x;
    rays.org_y[i] = origin.y;
    rays.org_z[i] = origin.z;
    rays.tnear[i] = own == None ? 0 : rayStart_;
    rays.dir_x[i] = direction.x;
    rays.dir_y[i] = direction.y;
    rays.dir_z[i] = direction.z;
    rays.time[i] = 0;
    rays.tfar[i] = distance;
    rays.mask[i] = 0xFFFFFFFFu;
    rays.id[i] = i;
    rays.flags[i] = 0;
  }
  occluded16(valid, scene_.get(), context.embree, rays);
  for (unsigned i = 0; i < count; ++i)
  {
    stopped |= unsigned(rays.tfar[i] < 0) << i;
  }
  return stopped;
}
bool SphereScene::isMeshWithin(Vec3f point, float reach) const
{
  if (!hasMesh_)
  {
    return false;
  }
  const RTCGeometry geometry = rtcGetGeometry(scene_.get(), TriangleGeometry);
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
  rtcPointQuery(scene_.get(), &query, &context, visitTriangle, &mesh);
  return mesh.found;
}
}
