// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_HarmonicBasis_h
#define po_HarmonicBasis_h

#include "TextureBasis.h"

#include <vector>

namespace po
{
/// Real spherical harmonics of the first bands, each times the deviation of its coefficient.
/// @param sample textures of resolution * resolution texels, which the deviations are those of
[[nodiscard]] TextureBasis sphericalHarmonics(
  int resolution, const std::vector<float>& sample, int bands);
}

#endif
