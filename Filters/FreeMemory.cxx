// SPDX-License-Identifier: BSD-3-Clause
#include "FreeMemory.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace po
{
namespace
{
/// Kibibytes that this process may use, for where the system does not say it, as in batch jobs.
constexpr const char* MemoryLimitVariable = "PARTICLEOCCLUSION_MEMORY_LIMIT";

std::string inGigabytes(double bytes)
{
  std::ostringstream text;
  text.precision(3);
  text << bytes / (1024.0 * 1024.0 * 1024.0) << " GiB";
  return text.str();
}
}

double freeMemory()
{
  vtksys::SystemInformation system;
  const double ofHost = static_cast<double>(system.GetHostMemoryAvailable(nullptr)) -
    static_cast<double>(system.GetHostMemoryUsed());
  const double ofProcess =
    static_cast<double>(system.GetProcMemoryAvailable(nullptr, MemoryLimitVariable)) -
    static_cast<double>(system.GetProcMemoryUsed());
  constexpr double BytesPerKibibyte = 1024;
  return BytesPerKibibyte * std::max(std::min(ofHost, ofProcess), 0.0);
}

void requireMemory(double bytes, std::size_t particles)
{
  const double available = freeMemory();
  if (bytes > available)
  {
    throw std::runtime_error("Baking " + std::to_string(particles) + " particles needs up to " +
      inGigabytes(bytes) + " of memory, but " + inGigabytes(available) +
      " are free: lower TextureResolution, choose the Method Embree or the Encoding "
      "UInt8Gamma2, turn ReuseUnchanged off, or bake fewer particles.");
  }
}
}
