// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FaultInjection_h
#define po_FaultInjection_h

// Faults of memory and of Embree, made to happen. The program that links FaultInjection.cxx has its
// operator new, and its calls of Embree in place of the library's own, in shared libraries too: the
// product needs no seam for this.

#include "Embree.h"

#include <cstddef>

/// While alive, the n-th allocation by operator new of any thread fails, counted from 1; all before
/// and after it succeed. Of n = 0 none fails, but all are counted.
///
/// Counted are allocations of the product's own code. VTK's constructors do not survive an
/// exception, and Embree frees what it never had after one: their faults are those below, and the
/// system's.
class FailingAllocation
{
public:
  explicit FailingAllocation(std::size_t n);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;

  /// Allocations since this object was made.
  [[nodiscard]] static std::size_t count();
};

/// Counts the bytes that operator new has given out and operator delete has not taken back, of all
/// threads: those since this object was made, and the most of them at a time. One object at a time.
class CountedMemory
{
public:
  CountedMemory();
  ~CountedMemory();
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

  [[nodiscard]] static std::ptrdiff_t most();
};

/// Calls of Embree that can be made to fail.
enum class EmbreeCall
{
  NewDevice,
  NewScene,
  NewGeometry,
  NewBuffer,
  CommitScene
};

/// While alive, the n-th such call fails, counted from 1: it returns null (if it returns anything),
/// does nothing, and the next question for the device's error is answered by `error`.
class FailingEmbree
{
public:
  FailingEmbree(EmbreeCall call, int n, RTCError error);
  ~FailingEmbree();
  FailingEmbree(const FailingEmbree&) = delete;
  FailingEmbree& operator=(const FailingEmbree&) = delete;

  /// Has the call come that was to fail?
  [[nodiscard]] static bool hit();
};

/// While alive, devices that are made refuse allocations of Embree's that would make more than
/// `bytes` of all of them together.
class EmbreeMemoryLimit
{
public:
  explicit EmbreeMemoryLimit(std::ptrdiff_t bytes);
  ~EmbreeMemoryLimit();
  EmbreeMemoryLimit(const EmbreeMemoryLimit&) = delete;
  EmbreeMemoryLimit& operator=(const EmbreeMemoryLimit&) = delete;
};

#ifndef PARTICLEOCCLUSION_SANITIZED // the sanitizers start threads of their own, their own way
/// While alive, no thread can be started, as where a container allows no more of them.
class NoNewThreads
{
public:
  NoNewThreads();
  ~NoNewThreads();
  NoNewThreads(const NoNewThreads&) = delete;
  NoNewThreads& operator=(const NoNewThreads&) = delete;
};
#endif

#endif
