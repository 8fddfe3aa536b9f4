// SPDX-License-Identifier: BSD-3-Clause
#include "FaultInjection.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <malloc.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <new>
#include <string_view>

// Definitions in the program take the place of those in the libraries only where they are exported.
#define INTERPOSED __attribute__((visibility("default")))

namespace
{
constexpr std::size_t Never = ~std::size_t{ 0 };
std::atomic<std::size_t> failingAllocation{ Never };
std::atomic<std::size_t> allocations{ 0 };

std::atomic<bool> embreeFails{ false };
std::atomic<EmbreeCall> failingCall{ EmbreeCall::NewDevice };
std::atomic<int> callsUntilFailure{ 0 };
std::atomic<RTCError> failureToReport{ RTC_ERROR_NONE };
std::atomic<RTCError> pendingError{ RTC_ERROR_NONE };

std::atomic<bool> memoryIsLimited{ false };
std::atomic<std::ptrdiff_t> embreeBytes{ 0 };
std::atomic<std::ptrdiff_t> largestEmbreeBytes{ 0 };

std::atomic<bool> memoryIsCounted{ false };
std::atomic<std::ptrdiff_t> usedBytes{ 0 };
std::atomic<std::ptrdiff_t> mostBytes{ 0 };

std::atomic<bool> threadsFail{ false };

struct AddressRange
{
  std::uintptr_t begin, end;
};

/// Where the code of some libraries lies.
class Code
{
public:
  void find(std::initializer_list<const char*> libraries)
  {
    count_ = 0;
    libraries_ = libraries;
    dl_iterate_phdr(Code::addIfNamed, this);
  }

  [[nodiscard]] bool has(const void* pointer) const
  {
    const auto address = reinterpret_cast<std::uintptr_t>(pointer);
    return std::any_of(ranges_.begin(), ranges_.begin() + count_,
      [=](const AddressRange& range) { return address >= range.begin && address < range.end; });
  }

private:
  static int addIfNamed(dl_phdr_info* library, std::size_t, void* self)
  {
    auto& code = *static_cast<Code*>(self);
    const std::string_view name(library->dlpi_name);
    const bool named = std::any_of(code.libraries_.begin(), code.libraries_.end(),
      [&](const char* part) { return name.find(part) != std::string_view::npos; });
    for (int i = 0; named && i < library->dlpi_phnum && code.count_ < code.ranges_.size(); ++i)
    {
      const std::uintptr_t begin = library->dlpi_addr + library->dlpi_phdr[i].p_vaddr;
      code.ranges_[code.count_++] = { begin, begin + library->dlpi_phdr[i].p_memsz };
    }
    return 0;
  }

  std::initializer_list<const char*> libraries_;
  std::array<AddressRange, 1024> ranges_{};
  std::size_t count_ = 0;
};

Code product;
Code systemLibraries;

/// Allocations of the product. Those of VTK and Embree are not, be they through a template of std::
/// that the product has too: then a system library is the caller of the caller.
bool isCounted(const void* caller)
{
  if (!product.has(caller))
  {
    return false;
  }
  std::array<void*, 8> frames;
  const int depth = backtrace(frames.data(), static_cast<int>(frames.size()));
  const auto end = frames.begin() + depth;
  const auto first = std::find(frames.begin(), end, caller);
  return first != end && first + 1 != end && !systemLibraries.has(*(first + 1));
}

/// @param change of the bytes that are in use
void count(std::ptrdiff_t change)
{
  const std::ptrdiff_t now = usedBytes += change;
  for (std::ptrdiff_t most = mostBytes; now > most && !mostBytes.compare_exchange_weak(most, now);)
  {
  }
}

void giveBack(void* memory)
{
  if (memoryIsCounted && memory)
  {
    count(-static_cast<std::ptrdiff_t>(malloc_usable_size(memory)));
  }
  std::free(memory);
}

void* allocate(std::size_t size, std::size_t alignment, const void* caller)
{
  if (failingAllocation != Never && isCounted(caller) && ++allocations == failingAllocation)
  {
    throw std::bad_alloc();
  }
  size = size > 0 ? size : 1;
  void* memory = alignment > 0
    ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
    : std::malloc(size);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  if (memoryIsCounted)
  {
    count(static_cast<std::ptrdiff_t>(malloc_usable_size(memory)));
  }
  return memory;
}

template <typename Function>
Function* real(Function*, const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool mustFail(EmbreeCall call)
{
  if (!embreeFails || call != failingCall || --callsUntilFailure != 0)
  {
    return false;
  }
  pendingError = failureToReport.load();
  return true;
}

bool refuseMemory(void*, ssize_t bytes, bool /*after*/)
{
  const std::ptrdiff_t all = embreeBytes += bytes;
  // What is given back must always be accepted.
  return bytes <= 0 || !memoryIsLimited || all <= largestEmbreeBytes;
}
}

INTERPOSED void* operator new(std::size_t size)
{
  return allocate(size, 0, __builtin_return_address(0));
}
INTERPOSED void* operator new[](std::size_t size)
{
  return allocate(size, 0, __builtin_return_address(0));
}
INTERPOSED void* operator new(std::size_t size, std::align_val_t alignment)
{
  return allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
INTERPOSED void* operator new[](std::size_t size, std::align_val_t alignment)
{
  return allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
INTERPOSED void operator delete(void* memory) noexcept
{
  giveBack(memory);
}
INTERPOSED void operator delete[](void* memory) noexcept
{
  giveBack(memory);
}
INTERPOSED void operator delete(void* memory, std::size_t) noexcept
{
  giveBack(memory);
}
INTERPOSED void operator delete[](void* memory, std::size_t) noexcept
{
  giveBack(memory);
}
INTERPOSED void operator delete(void* memory, std::align_val_t) noexcept
{
  giveBack(memory);
}
INTERPOSED void operator delete[](void* memory, std::align_val_t) noexcept
{
  giveBack(memory);
}
INTERPOSED void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  giveBack(memory);
}
INTERPOSED void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept
{
  giveBack(memory);
}

extern "C"
{
  INTERPOSED RTCDevice rtcNewDevice(const char* config)
  {
    static auto* const next = real(&rtcNewDevice, "rtcNewDevice");
    if (mustFail(EmbreeCall::NewDevice))
    {
      return nullptr;
    }
    RTCDevice device = next(config);
    if (device)
    {
      rtcSetDeviceMemoryMonitorFunction(device, refuseMemory, nullptr);
    }
    return device;
  }

  INTERPOSED RTCError rtcGetDeviceError(RTCDevice device)
  {
    static auto* const next = real(&rtcGetDeviceError, "rtcGetDeviceError");
    const RTCError injected = pendingError.exchange(RTC_ERROR_NONE);
    return injected != RTC_ERROR_NONE ? injected : next(device);
  }

  INTERPOSED RTCScene rtcNewScene(RTCDevice device)
  {
    static auto* const next = real(&rtcNewScene, "rtcNewScene");
    return mustFail(EmbreeCall::NewScene) ? nullptr : next(device);
  }

  INTERPOSED RTCGeometry rtcNewGeometry(RTCDevice device, RTCGeometryType type)
  {
    static auto* const next = real(&rtcNewGeometry, "rtcNewGeometry");
    return mustFail(EmbreeCall::NewGeometry) ? nullptr : next(device, type);
  }

  INTERPOSED void* rtcSetNewGeometryBuffer(RTCGeometry geometry, RTCBufferType type, unsigned slot,
    RTCFormat format, size_t byteStride, size_t itemCount)
  {
    static auto* const next = real(&rtcSetNewGeometryBuffer, "rtcSetNewGeometryBuffer");
    return mustFail(EmbreeCall::NewBuffer)
      ? nullptr
      : next(geometry, type, slot, format, byteStride, itemCount);
  }

  INTERPOSED void rtcCommitScene(RTCScene scene)
  {
    static auto* const next = real(&rtcCommitScene, "rtcCommitScene");
    if (!mustFail(EmbreeCall::CommitScene))
    {
      next(scene);
    }
  }

#ifndef PARTICLEOCCLUSION_SANITIZED
  INTERPOSED int pthread_create(
    pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument)
  {
    static auto* const next = real(&pthread_create, "pthread_create");
    return threadsFail ? EAGAIN : next(thread, attributes, run, argument);
  }
#endif
}

FailingAllocation::FailingAllocation(std::size_t n)
{
  product.find({ "libParticleOcclusion" });
  systemLibraries.find({ "libvtk", "libembree" });
  void* frame = nullptr;
  backtrace(&frame, 1); // its first call allocates
  allocations = 0;
  failingAllocation = n;
}

FailingAllocation::~FailingAllocation()
{
  failingAllocation = Never;
}

std::size_t FailingAllocation::count()
{
  return allocations;
}

CountedMemory::CountedMemory()
{
  usedBytes = 0;
  mostBytes = 0;
  memoryIsCounted = true;
}

CountedMemory::~CountedMemory()
{
  memoryIsCounted = false;
}

std::ptrdiff_t CountedMemory::most()
{
  return mostBytes;
}

FailingEmbree::FailingEmbree(EmbreeCall call, int n, RTCError error)
{
  failingCall = call;
  callsUntilFailure = n;
  failureToReport = error;
  pendingError = RTC_ERROR_NONE;
  embreeFails = true;
}

FailingEmbree::~FailingEmbree()
{
  embreeFails = false;
  pendingError = RTC_ERROR_NONE;
}

bool FailingEmbree::hit()
{
  return callsUntilFailure <= 0;
}

EmbreeMemoryLimit::EmbreeMemoryLimit(std::ptrdiff_t bytes)
{
  embreeBytes = 0;
  largestEmbreeBytes = bytes;
  memoryIsLimited = true;
}

EmbreeMemoryLimit::~EmbreeMemoryLimit()
{
  memoryIsLimited = false;
}

#ifndef PARTICLEOCCLUSION_SANITIZED
NoNewThreads::NoNewThreads()
{
  threadsFail = true;
}

NoNewThreads::~NoNewThreads()
{
  threadsFail = false;
}
#endif
