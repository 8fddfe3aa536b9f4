// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MemoryGrowth_h
#define po_MemoryGrowth_h

#include <unistd.h>

#include <cstdio>
#include <functional>

/// Memory of this process that is in use, in megabytes; 0 where /proc is not there.
inline double residentMegabytes()
{
  long pages = 0, resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r"))
  {
    if (std::fscanf(file, "%ld %ld", &pages, &resident) != 2)
    {
      resident = 0;
    }
    std::fclose(file);
  }
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Growth of memory, in megabytes, over `count` calls after `warmUp` others, in which pools fill.
inline double growthOver(int count, int warmUp, const std::function<void(int)>& call)
{
  for (int i = 0; i < warmUp; ++i)
  {
    call(i);
  }
  const double before = residentMegabytes();
  for (int i = 0; i < count; ++i)
  {
    call(i);
  }
  const double growth = residentMegabytes() - before;
  std::printf("from %.1f MB by %.2f MB in %d\n", before, growth, count);
  return growth;
}

#endif
