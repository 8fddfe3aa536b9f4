// SPDX-License-Identifier: BSD-3-Clause
#include "Embree.h"

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
}

DeviceHandle makeDevice()
{
  DeviceHandle device(rtcNewDevice(nullptr));
  if (!device)
  {
    throw std::runtime_error(
      std::string("Embree could not start: ") + describe(rtcGetDeviceError(nullptr)));
  }
  return device;
}

void throwOnError(RTCDevice device, const char* action)
{
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
  {
    throw std::bad_alloc();
  }
  if (error != RTC_ERROR_NONE)
  {
    throw std::runtime_error(std::string("Embree failed while ") + action + ": " + describe(error));
  }
}
}
