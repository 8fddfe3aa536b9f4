// SPDX-License-Identifier: BSD-3-Clause
// Vectors over the texels of a group, for the sources that Highway compiles once for each
// instruction set: included by each of them anew, hence no plain include guard.
#if defined(po_TexelLanes_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef po_TexelLanes_inl_h
#undef po_TexelLanes_inl_h
#else
#define po_TexelLanes_inl_h
#endif

#include "SweepTexels.h"

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, GroupSize>;

/// The lanes that are set, as the lowest bits of a number.
inline unsigned bitsOf(Floats d, hn::Mask<Floats> lanes)
{
  HWY_ALIGN std::uint8_t bytes[8] = {}; // least significant first
  hn::StoreMaskBits(d, lanes, bytes);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  std::uint16_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
#else
  return bytes[0] | unsigned(bytes[1]) << 8;
#endif
}

inline hn::Mask<Floats> noLanes(Floats d)
{
  return hn::FirstN(d, 0);
}

/// The opposite of bitsOf().
inline hn::Mask<Floats> lanesOf(Floats d, unsigned bits)
{
  HWY_ALIGN const std::uint8_t bytes[8] = { static_cast<std::uint8_t>(bits),
    static_cast<std::uint8_t>(bits >> 8) };
  return hn::LoadMaskBits(d, bytes);
}

}
HWY_AFTER_NAMESPACE();

#endif
