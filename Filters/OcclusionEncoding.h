// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionEncoding_h
#define po_OcclusionEncoding_h

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace po
{
/// UInt8Gamma2: byte = round(255 sqrt(value / maximum)), so value = maximum (byte / 255)^2.
/// The steps of a decoded float are far coarser than its precision: encoding it with the same
/// maximum gives the same byte, as long as maximum >= SmallestGamma2Maximum.
inline float decodeGamma2(std::uint8_t byte, double maximum)
{
  const double root = byte / 255.0;
  return static_cast<float>(maximum * root * root);
}

inline std::uint8_t encodeGamma2(float value, double maximum)
{
  const double share = maximum > 0.0 ? std::max(0.0, value / maximum) : 0.0;
  return static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, std::sqrt(share))));
}

/// Below, maximum / 255^2 would leave the range of normal floats (1.2e-38).
inline constexpr double SmallestGamma2Maximum = 1e-32;
}

#endif
