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
  const double kibibytes = static_cast<double>(system.GetHostMemoryAvailable(nullptr)) -
    static_cast<double>(system.GetHostMemoryUsed());
  return 1024.0 * std::max(kibibytes, 0.0);
}

void requireMemory(double bytes, std::size_t particles)
{
  const double available = freeMemory();
  if (bytes > available)
  {
    throw std::runtime_error("Baking " + std::to_string(particles) + " particles needs up to " +
      inGigabytes(bytes) + " of memory, but " + inGigabytes(available) +
      " are free: lower TextureResolution, choose the Method Embree or the Encoding "
      "UInt8Gamma2, or bake fewer particles.");
  }
}
}
