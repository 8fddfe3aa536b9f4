// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FreeMemory_h
#define po_FreeMemory_h

#include "ParticleOcclusionFiltersModule.h"

#include <cstddef>

namespace po
{
/// Bytes that this machine can still give, or that this process may still use where that is less:
/// by its resource limits, and by the environment variable PARTICLEOCCLUSION_MEMORY_LIMIT (KiB).
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT double freeMemory();

/// Says beforehand what would otherwise end in swapping or in a killed process: throws
/// std::runtime_error, with what to do, if a bake of so many particles needs more than is free.
void requireMemory(double bytes, std::size_t particles);
}

#endif
