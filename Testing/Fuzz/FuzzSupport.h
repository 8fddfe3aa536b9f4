// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FuzzSupport_h
#define po_FuzzSupport_h

// What the fuzz targets share.

#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"

#include <sys/mman.h>
#include <unistd.h>

#include <tbb/global_control.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/// Ends the run, so that libFuzzer keeps the input: `what` must always hold.
#define FUZZ_REQUIRE(what)                                                                         \
  do                                                                                               \
  {                                                                                                \
    if (!(what))                                                                                   \
    {                                                                                              \
      std::fprintf(stderr, "%s:%d: this does not hold: %s\n", __FILE__, __LINE__, #what);          \
      std::abort();                                                                                \
    }                                                                                              \
  } while (false)

/// A file in memory that lives as long as the object.
class MemoryFile
{
public:
  MemoryFile(const std::uint8_t* bytes, std::size_t size)
    : descriptor_(memfd_create("fuzz", 0))
  {
    FUZZ_REQUIRE(descriptor_ >= 0);
    FUZZ_REQUIRE(::write(descriptor_, bytes, size) == static_cast<ssize_t>(size));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
  int descriptor_;
};

/// VTK's messages of objects that nobody observes go nowhere: millions of them would be printed.
class SilentOutputWindow : public vtkOutputWindow
{
public:
  static SilentOutputWindow* New();
  vtkTypeMacro(SilentOutputWindow, vtkOutputWindow);
  void DisplayText(const char*) override {}
};
vtkStandardNewMacro(SilentOutputWindow);

/// Call it once, from LLVMFuzzerInitialize. One thread, so that the same input takes the same path.
inline void prepareFuzzing()
{
  static tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  SilentOutputWindow* window = SilentOutputWindow::New();
  vtkOutputWindow::SetInstance(window);
  window->Delete();
}

#endif
