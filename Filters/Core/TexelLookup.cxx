// SPDX-License-Identifier: BSD-3-Clause
#include "TexelLookup.h"

#include "Constants.h"

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "TexelLookup.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, TexelLookup::Size>;
using Integers = hn::RebindToSigned<Floats>;
using Vector = hn::Vec<Floats>;

/// Angle from the x axis in (-pi, pi], to 3e-7 and one rounding; 0 at the origin.
inline Vector angle(Vector y, Vector x)
{
  // Odd polynomial for the arctangent on [0, 1] with the least maximum error, 3.8e-8, found by
  // Lawson's iteration; the other octants follow by reflection.
  constexpr float A[] = { 0.9999993443f, -0.3332985938f, 0.1994656473f, -0.1390862763f,
    0.0964219347f, -0.0559122711f, 0.0218629166f, -0.0040545552f };
  const Floats d;
  const Vector zero = hn::Zero(d), halfTurn = hn::Set(d, static_cast<float>(Pi)),
               quarterTurn = hn::Set(d, static_cast<float>(Pi / 2));
  const Vector absX = hn::Abs(x), absY = hn::Abs(y);
  const Vector larger = hn::Max(absX, absY), smaller = hn::Min(absX, absY);
  const Vector q = hn::IfThenElseZero(hn::Gt(larger, zero), hn::Div(smaller, larger));
  const Vector q2 = hn::Mul(q, q);
  Vector sum = hn::Set(d, A[7]);
  for (int k = 6; k >= 0; --k)
  {
    sum = hn::MulAdd(sum, q2, hn::Set(d, A[k]));
  }
  Vector result = hn::Mul(sum, q);
  result = hn::IfThenElse(hn::Gt(absY, absX), hn::Sub(quarterTurn, result), result);
  result = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(halfTurn, result), result);
  return hn::IfThenElse(hn::Lt(y, zero), hn::Neg(result), result);
}

/// Splits a position in texels, at least -1/2, into the texel at or before it and the rest.
inline hn::Vec<Integers> splitPosition(Vector position, float* weight)
{
  const Floats d;
  const Vector one = hn::Set(d, 1.0f);
  // Cutting off after adding 1 is a floor.
  const auto whole = hn::ConvertTo(Integers(), hn::Add(position, one));
  hn::Store(hn::Sub(hn::Add(position, one), hn::ConvertTo(d, whole)), d, weight);
  return hn::Sub(whole, hn::Set(Integers(), 1));
}

void findTexels(int resolution, TexelLookup& lookup)
{
  const Floats d;
  const Integers di;
  const Vector size = hn::Set(d, static_cast<float>(resolution)), half = hn::Set(d, 0.5f),
               perTurn = hn::Set(d, static_cast<float>(1 / (2 * Pi)));
  const auto width = hn::Set(di, resolution), last = hn::Set(di, resolution - 1),
             first = hn::Zero(di), one = hn::Set(di, 1);
  for (std::size_t lane = 0; lane < TexelLookup::Size; lane += hn::Lanes(d))
  {
    const Vector x = hn::Load(d, lookup.x + lane), y = hn::Load(d, lookup.y + lane),
                 z = hn::Load(d, lookup.z + lane);
    Vector u = hn::Mul(perTurn, angle(y, x));
    u = hn::IfThenElse(hn::Lt(u, hn::Zero(d)), hn::Add(u, hn::Set(d, 1.0f)), u);
    const Vector axisDistance = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
    const Vector v = hn::Mul(hn::Add(perTurn, perTurn), angle(axisDistance, z));
    hn::Store(u, d, lookup.u + lane);
    hn::Store(v, d, lookup.v + lane);
    const auto i = splitPosition(hn::MulSub(u, size, half), lookup.columnWeight + lane);
    const auto j = splitPosition(hn::MulSub(v, size, half), lookup.rowWeight + lane);
    const auto next = hn::Add(i, one);
    // Rounding may take u to 1 and v beyond: the first column, the last row.
    const auto column0 = hn::IfThenElse(hn::Lt(i, first), last, hn::Min(i, last));
    const auto column1 = hn::IfThenElse(hn::Gt(next, last), first, next);
    const auto row0 = hn::Mul(width, hn::Min(hn::Max(j, first), last));
    const auto row1 = hn::Mul(width, hn::Min(hn::Add(j, one), last));
    hn::Store(hn::Add(row0, column0), di, lookup.texel[0] + lane);
    hn::Store(hn::Add(row0, column1), di, lookup.texel[1] + lane);
    hn::Store(hn::Add(row1, column0), di, lookup.texel[2] + lane);
    hn::Store(hn::Add(row1, column1), di, lookup.texel[3] + lane);
  }
}

void interpolateTexels(const TexelCorners& corners, const TexelLookup& lookup, float* values)
{
  const Floats d;
  for (std::size_t lane = 0; lane < TexelLookup::Size; lane += hn::Lanes(d))
  {
    const auto mix = [&](Vector weight, Vector a, Vector b)
    { return hn::MulAdd(weight, hn::Sub(b, a), a); };
    const auto corner = [&](std::size_t k) { return hn::Load(d, corners.value[k] + lane); };
    const Vector across = hn::Load(d, lookup.columnWeight + lane),
                 down = hn::Load(d, lookup.rowWeight + lane);
    const Vector row0 = mix(across, corner(0), corner(1)), row1 = mix(across, corner(2), corner(3));
    hn::StoreU(mix(down, row0, row1), d, values + lane);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(findTexels);
HWY_EXPORT(interpolateTexels);

void findTexels(int resolution, TexelLookup& lookup)
{
  HWY_DYNAMIC_DISPATCH(findTexels)(resolution, lookup);
}

void interpolateTexels(const TexelCorners& corners, const TexelLookup& lookup, float* values)
{
  HWY_DYNAMIC_DISPATCH(interpolateTexels)(corners, lookup, values);
}
}
#endif
