// SPDX-License-Identifier: BSD-3-Clause
#include "Embree.h"

#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

namespace po
{
namespace
{
const char* describe(RTCError error)
{
  switch (error)
  {
    case RTC_ERROR_NONE:
      return "no error";
    case RTC_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
      return "invalid operation";
    case RTC_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
      return "this processor is not supported (SSE2 is needed)";
    case RTC_ERROR_CANCELLED:
      return "cancelled";
    default:
      return "unknown error";
  }
}

[[noreturn]] void throwError(RTCError error, const char* action)
{
  if (error == RTC_ERROR_OUT_OF_MEMORY)
  {
    throw std::bad_alloc();
  }
  throw std::runtime_error(std::string("Embree failed while ") + action + ": " + describe(error));
}

/// Memory that is plainly missing is told before Embree takes the first of it. This is no proof:
/// others may take it in between.
void requireMemoryForScene(std::size_t primitives)
{
  // As much as bakeMemory() counts; the rest is for blocks that each thread takes at once.
  constexpr std::size_t BytesPerPrimitive = 300;
  constexpr std::size_t BytesOfThreads = std::size_t{ 32 } << 20;
  // Not new, which a compiler may leave out with its delete. Pages that are not touched cost
  // nothing.
  void* volatile rehearsal = std::malloc(BytesOfThreads + BytesPerPrimitive * primitives);
  if (!rehearsal)
  {
    throw std::bad_alloc();
  }
  std::free(rehearsal);
}
}

DeviceHandle makeDevice(std::size_t primitives)
{
  requireMemoryForScene(primitives);
  DeviceHandle device(rtcNewDevice(nullptr));
  if (!device)
  {
    throw std::runtime_error(
      std::string("Embree could not start: ") + describe(rtcGetDeviceError(nullptr)));
  }
  return device;
}

SceneHandle makeScene(RTCDevice device)
{
  SceneHandle scene(rtcNewScene(device));
  if (!scene)
  {
    throwError(rtcGetDeviceError(device), "making a scene");
  }
  return scene;
}

GeometryHandle makeGeometry(RTCDevice device, RTCGeometryType type, const char* option)
{
  GeometryHandle geometry(rtcNewGeometry(device, type));
  if (!geometry)
  {
    if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY)
    {
      throw std::bad_alloc();
    }
    throw std::runtime_error(
      std::string("This build of Embree was configured without ") + option + ".");
  }
  return geometry;
}

void commitScene(RTCDevice device, SceneHandle& scene, const char* action)
{
  rtcCommitScene(scene.get());
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
  {
    // Embree 3.13 would end the process, instead of releasing the scene, where the build failed in
    // a parallel task or since no thread could be started.
    static_cast<void>(scene.release());
    throwError(error, action);
  }
}
}
