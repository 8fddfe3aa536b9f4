// SPDX-License-Identifier: BSD-3-Clause
#include "ProcessCost.h"

#include <cstdlib>
#include <fstream>
#include <limits>

namespace po
{
Seconds Stopwatch::elapsed() const
{
  return { static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC,
    std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count() };
}

double statusMegabytes(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.compare(0, name.size() + 1, name + ":") == 0)
    {
      return std::strtod(line.c_str() + name.size() + 1, nullptr) * 1024 / 1e6;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}
}
