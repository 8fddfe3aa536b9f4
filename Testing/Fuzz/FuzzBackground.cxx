// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as an OpenEXR image of the background.
#include "FuzzSupport.h"

#include "ExrBackground.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  prepareFuzzing();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const MemoryFile file(bytes, size);
  try
  {
    const po::LatLongImage image = po::readLatLongImage(file.name());
    FUZZ_REQUIRE(image.width > 0 && image.height > 0);
    FUZZ_REQUIRE(
      image.luminance.size() == std::size_t(image.width) * static_cast<std::size_t>(image.height));
    FUZZ_REQUIRE(std::all_of(image.luminance.begin(), image.luminance.end(),
      [](float value) { return std::isfinite(value) && value >= 0; }));
  }
  catch (const std::runtime_error& error)
  {
    FUZZ_REQUIRE(std::string(error.what()).find(file.name()) != std::string::npos);
  }
  return 0;
}
