// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Gamma2_h
#define po_Gamma2_h

#include <algorithm>
#include <cmath>
#include <cstdint>

// The encoding UInt8Gamma2: a byte is 255 times the square root of the share of a maximum.

namespace po
{
/// Below, maximum / 255^2 would leave the range of normal floats (1.2e-38) and not round-trip.
inline constexpr double SmallestGamma2Maximum = 1e-32;

/// round(255 sqrt(value / maximum)), 0 where the maximum is 0 or the value is NaN.
[[nodiscard]] inline std::uint8_t encodeGamma2(double value, double maximum)
{
  const double share = maximum > 0 ? std::min(1.0, std::max(0.0, value / maximum)) : 0.0;
  return static_cast<std::uint8_t>(std::lround(255 * std::sqrt(share)));
}

/// maximum (byte / 255)^2: the inverse of encodeGamma2 to half a step. Rounded to a float it
/// encodes to the same byte again, as long as maximum >= SmallestGamma2Maximum.
[[nodiscard]] inline double decodeGamma2(std::uint8_t byte, double maximum)
{
  const double displayed = byte / 255.0;
  return maximum * displayed * displayed;
}
}

#endif
