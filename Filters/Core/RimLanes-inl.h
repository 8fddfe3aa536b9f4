// SPDX-License-Identifier: BSD-3-Clause
// Vectors over pixels beside the rim of a sphere, for sources that Highway compiles once for each
// instruction set: included by each of them anew, hence no plain include guard.
#if defined(po_RimLanes_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef po_RimLanes_inl_h
#undef po_RimLanes_inl_h
#else
#define po_RimLanes_inl_h
#endif

#include "RimGeometry.h"
#include "SilhouetteRule.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// The pixels of one rim in a tile are few: longer vectors would be mostly empty.
using Tag = hn::CappedTag<float, 16>;
using IntegerTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Integers = hn::Vec<IntegerTag>;
using Lanes = hn::Mask<Tag>;

inline Floats number(float value)
{
  return hn::Set(Tag(), value);
}

inline Integers number(std::int32_t value)
{
  return hn::Set(IntegerTag(), value);
}

/// Iota from a constant: its lanes from a variable would be written one by one.
inline Integers countFrom(std::int32_t first)
{
  return hn::Add(hn::Iota(IntegerTag(), 0), number(first));
}

inline Integers gather(const std::uint32_t* from, Integers at)
{
  return hn::GatherIndex(IntegerTag(), reinterpret_cast<const std::int32_t*>(from), at);
}

/// A quadratic at some places, and half its gradient.
struct Evaluated
{
  Floats value, halfX, halfY;

  Evaluated(const Quadratic& f, Floats x, Floats y)
  {
    const Floats mixed = number(0.5F * f.xy), fx = number(0.5F * f.x), fy = number(0.5F * f.y);
    const Floats bentX = hn::Add(hn::Mul(x, number(f.xx)), hn::Mul(y, mixed));
    const Floats bentY = hn::Add(hn::Mul(y, number(f.yy)), hn::Mul(x, mixed));
    halfX = hn::Add(fx, bentX);
    halfY = hn::Add(fy, bentY);
    const Floats rise = hn::Add(hn::Mul(x, hn::Add(fx, halfX)), hn::Mul(y, hn::Add(fy, halfY)));
    value = hn::Add(number(f.c), rise);
  }
};

/// Where pixels lie beside a rim.
struct Place
{
  Floats distance;     ///< beyond the rim, in pixels
  Floats nx, ny;       ///< unit normal, away from the sphere
  Floats wide, narrow; ///< its larger and smaller component, without sign
  Floats perWide, perArea;
};

/// The distance from the rim is (h - r) / |grad h|, with lengths in radii.
inline Place placeOf(const Quadratic& squaredMoment, const RayPatch& patch, Floats x, Floats y)
{
  const Floats tiny = number(1e-30F), one = number(1.0F);
  const Evaluated moment(squaredMoment, x, y), length(patch.squaredLength, x, y);
  const Floats value = hn::Max(moment.value, tiny);
  const Floats square = hn::Div(value, length.value);
  // grad h times h |d|^2
  const Floats gx = hn::Sub(moment.halfX, hn::Mul(square, length.halfX));
  const Floats gy = hn::Sub(moment.halfY, hn::Mul(square, length.halfY));
  const Floats gradient = hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy));
  const Floats perLength = hn::Div(one, hn::Sqrt(hn::Max(gradient, tiny)));
  // (h - 1) h |d|^2
  const Floats beyond = hn::Sub(value, hn::Sqrt(hn::Mul(value, length.value)));
  const Floats nx = hn::Mul(gx, perLength), ny = hn::Mul(gy, perLength);
  const Floats wide = hn::Max(hn::Abs(nx), hn::Abs(ny));
  const Floats narrow = hn::Min(hn::Abs(nx), hn::Abs(ny));
  const Floats area = hn::Max(hn::Mul(number(2.0F), hn::Mul(wide, narrow)), number(1e-9F));
  const Floats both = hn::Div(one, hn::Mul(wide, area));
  return { hn::Mul(beyond, perLength), nx, ny, wide, narrow, hn::Mul(both, area),
    hn::Mul(both, wide) };
}

/// Share of a pixel that lies beyond a straight line at a distance from its centre: the
/// distribution function of the trapezoid that a square shows in the direction of the normal.
inline Floats shareBeyond(Floats distance, const Place& place)
{
  const Floats half = number(0.5F), one = number(1.0F), zero = number(0.0F);
  const Floats x = hn::Abs(distance);
  const Floats flat = hn::Mul(half, hn::Sub(place.wide, place.narrow));
  const Floats end = hn::Mul(half, hn::Add(place.wide, place.narrow));
  const Floats left = hn::Max(hn::Sub(end, x), zero);
  const Floats bent = hn::Sub(one, hn::Mul(hn::Mul(left, left), place.perArea));
  const Floats straight = hn::Add(half, hn::Mul(x, place.perWide));
  const Floats share = hn::IfThenElse(hn::Le(x, flat), straight, bent);
  return hn::IfThenElse(hn::Lt(distance, zero), hn::Sub(one, share), share);
}

/// JumpRamp::at().
inline Floats rampAt(const JumpRamp& ramp, Floats jump)
{
  const Floats from = number(ramp.from), to = number(ramp.to);
  const Floats rise = hn::Div(hn::Sub(jump, from), hn::Sub(to, from));
  return hn::IfThenElse(
    hn::Ge(jump, to), number(1.0F), hn::IfThenElseZero(hn::Gt(jump, from), rise));
}
}
HWY_AFTER_NAMESPACE();

#endif
