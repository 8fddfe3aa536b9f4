// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Embree_h
#define po_Embree_h

// Embree 3 and 4 behind the calls of Embree 4: include this instead of rtcore.h.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>
#include <memory>
#include <type_traits>

namespace po
{
#if RTC_VERSION_MAJOR >= 4
using RayQueryContext = RTCRayQueryContext;

/// Scenes with this flag call the filters of single queries.
constexpr RTCSceneFlags QueryFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void initRayQueryContext(RayQueryContext& context, bool /*coherent*/)
{
  rtcInitRayQueryContext(&context);
}

/// Occlusion test of one ray; hits count that the filter, if there is one, does not reject.
inline void occluded1(
  RTCScene scene, RayQueryContext& context, RTCRay& ray, RTCFilterFunctionN filter = nullptr)
{
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  arguments.filter = filter;
  arguments.flags = filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : RTC_RAY_QUERY_FLAG_NONE;
  rtcOccluded1(scene, &ray, &arguments);
}

/// Nearest hit that the filter, if there is one, does not reject.
inline void intersect1(
  RTCScene scene, RayQueryContext& context, RTCRayHit& ray, RTCFilterFunctionN filter = nullptr)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.filter = filter;
  arguments.flags = filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : RTC_RAY_QUERY_FLAG_NONE;
  rtcIntersect1(scene, &ray, &arguments);
}

inline void intersect16(const int* valid, RTCScene scene, RayQueryContext& context,
  RTCRayHit16& rays, RTCFilterFunctionN filter = nullptr)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.filter = filter;
  arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_COHERENT |
    (filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : RTC_RAY_QUERY_FLAG_NONE));
  rtcIntersect16(valid, scene, &rays, &arguments);
}

inline void occluded16(const int* valid, RTCScene scene, RayQueryContext& context, RTCRay16& rays,
  RTCFilterFunctionN filter = nullptr)
{
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  arguments.filter = filter;
  arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_COHERENT |
    (filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : RTC_RAY_QUERY_FLAG_NONE));
  rtcOccluded16(valid, scene, &rays, &arguments);
}
#else
using RayQueryContext = RTCIntersectContext;

/// Scenes with this flag call the filters of single queries.
constexpr RTCSceneFlags QueryFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void initRayQueryContext(RayQueryContext& context, bool coherent)
{
  rtcInitIntersectContext(&context);
  context.flags =
    coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

/// Occlusion test of one ray; hits count that the filter, if there is one, does not reject.
inline void occluded1(
  RTCScene scene, RayQueryContext& context, RTCRay& ray, RTCFilterFunctionN filter = nullptr)
{
  context.filter = filter;
  rtcOccluded1(scene, &context, &ray);
}

/// Nearest hit that the filter, if there is one, does not reject.
inline void intersect1(
  RTCScene scene, RayQueryContext& context, RTCRayHit& ray, RTCFilterFunctionN filter = nullptr)
{
  context.filter = filter;
  rtcIntersect1(scene, &context, &ray);
}

inline void intersect16(const int* valid, RTCScene scene, RayQueryContext& context,
  RTCRayHit16& rays, RTCFilterFunctionN filter = nullptr)
{
  context.filter = filter;
  rtcIntersect16(valid, scene, &context, &rays);
}

inline void occluded16(const int* valid, RTCScene scene, RayQueryContext& context, RTCRay16& rays,
  RTCFilterFunctionN filter = nullptr)
{
  context.filter = filter;
  rtcOccluded16(valid, scene, &context, &rays);
}
#endif

struct ReleaseDevice
{
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene
{
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry
{
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

/// A new Embree device for scenes of together so many spheres and triangles; throws
/// std::runtime_error with Embree's reason, or std::bad_alloc if the memory for them is not there.
[[nodiscard]] DeviceHandle makeDevice(std::size_t primitives);

/// A new scene or geometry, never null: throws std::bad_alloc or std::runtime_error instead.
/// @param option of Embree's build without which it has no such geometry, for the message
[[nodiscard]] SceneHandle makeScene(RTCDevice device);
[[nodiscard]] GeometryHandle makeGeometry(
  RTCDevice device, RTCGeometryType type, const char* option);

/// Builds what queries go through. Throws std::bad_alloc or std::runtime_error if that fails, now
/// or at a call before that reported nothing; `action` says what was tried. Such a scene is given
/// up, memory and all.
void commitScene(RTCDevice device, SceneHandle& scene, const char* action);
}

#endif
