// SPDX-License-Identifier: BSD-3-Clause
// Vectors over edges and the rims in front of them, for sources that Highway compiles once for each
// instruction set: included by each of them anew, hence no plain include guard.
#if defined(po_RimLanes_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef po_RimLanes_inl_h
#undef po_RimLanes_inl_h
#else
#define po_RimLanes_inl_h
#endif

#include "RimEdges.h"
#include "SilhouetteRule.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, EdgeGroup::Size>;
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

inline Floats load(const std::vector<float>& from, std::size_t at)
{
  return hn::LoadU(Tag(), from.data() + at);
}

inline Integers load(const std::vector<std::int32_t>& from, std::size_t at)
{
  return hn::LoadU(IntegerTag(), from.data() + at);
}

/// A quadratic at some places with half its derivatives.
struct Evaluated
{
  Floats value, x, y, xx, xy, yy;
};

inline Evaluated evaluate(const Quadratic& f, Floats x, Floats y)
{
  const Floats xx = number(f.xx), xy = number(0.5F * f.xy), yy = number(f.yy);
  const Floats fx = number(0.5F * f.x), fy = number(0.5F * f.y);
  const Floats halfX = hn::Add(fx, hn::Add(hn::Mul(x, xx), hn::Mul(y, xy)));
  const Floats halfY = hn::Add(fy, hn::Add(hn::Mul(y, yy), hn::Mul(x, xy)));
  const Floats rise = hn::Add(hn::Mul(x, hn::Add(fx, halfX)), hn::Mul(y, hn::Add(fy, halfY)));
  return { hn::Add(number(f.c), rise), halfX, halfY, xx, xy, yy };
}

/// |m|^2 over the squared radius of spheres, see RayPatch.
inline Evaluated squaredMoments(
  const RayPatch& patch, const RimEdges& edges, std::size_t at, Floats x, Floats y)
{
  const Floats w = load(edges.w, at), u = load(edges.u, at), v = load(edges.v, at);
  const auto p = [&patch](std::size_t k) { return number(patch.products[k]); };
  const auto sum3 = [](Floats a, Floats b, Floats c) { return hn::Add(hn::Add(a, b), c); };
  // Products of the vectors with dm/dX = (w, 0, -v) and dm/dY = (0, w, u).
  const Floats x1 = hn::Sub(hn::Mul(w, p(0)), hn::Mul(v, p(3)));
  const Floats x2 = hn::Sub(hn::Mul(w, p(1)), hn::Mul(v, p(4)));
  const Floats x3 = hn::Sub(hn::Mul(w, p(3)), hn::Mul(v, p(5)));
  const Floats y2 = hn::Add(hn::Mul(w, p(2)), hn::Mul(u, p(4)));
  const Floats y3 = hn::Add(hn::Mul(w, p(4)), hn::Mul(u, p(5)));
  const Floats m1 = hn::Sub(hn::Mul(w, x), u), m2 = hn::Sub(hn::Mul(w, y), v),
               m3 = hn::Sub(hn::Mul(u, y), hn::Mul(v, x));
  const Floats n1 = sum3(hn::Mul(m1, p(0)), hn::Mul(m2, p(1)), hn::Mul(m3, p(3)));
  const Floats n2 = sum3(hn::Mul(m1, p(1)), hn::Mul(m2, p(2)), hn::Mul(m3, p(4)));
  const Floats n3 = sum3(hn::Mul(m1, p(3)), hn::Mul(m2, p(4)), hn::Mul(m3, p(5)));
  return { sum3(hn::Mul(m1, n1), hn::Mul(m2, n2), hn::Mul(m3, n3)),
    hn::Sub(hn::Mul(w, n1), hn::Mul(v, n3)), hn::Add(hn::Mul(w, n2), hn::Mul(u, n3)),
    hn::Sub(hn::Mul(w, x1), hn::Mul(v, x3)), hn::Add(hn::Mul(w, x2), hn::Mul(u, x3)),
    hn::Add(hn::Mul(w, y2), hn::Mul(u, y3)) };
}

/// Rims beside edges, as the circles that touch them there; in pixels, from the centre of the
/// edge's pixel.
struct RimCircles
{
  Floats distance; ///< of the edge beyond the rim
  Floats nx, ny;   ///< unit normal, away from the sphere
  Floats x, y;     ///< centre
  Floats radius;

  /// How far beyond the rim another pixel is.
  [[nodiscard]] Floats distanceAt(int column, int row) const
  {
    const Floats dx = hn::Sub(number(static_cast<float>(column)), x);
    const Floats dy = hn::Sub(number(static_cast<float>(row)), y);
    return hn::Sub(hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy))), radius);
  }
};

/// The distance from the rim is (h - r) / |grad h|, with lengths in radii.
inline RimCircles circlesOf(const RayPatch& patch, const RimEdges& edges, std::size_t at)
{
  const Floats tiny = number(1e-30F), one = number(1.0F), straightest = number(1e-4F);
  const Floats x = load(edges.x, at), y = load(edges.y, at);
  const Evaluated moment = squaredMoments(patch, edges, at, x, y);
  const Evaluated length = evaluate(patch.squaredLength, x, y);
  const Floats value = hn::Max(moment.value, tiny);
  const Floats square = hn::Div(value, length.value);
  const auto lessLength = [square](Floats a, Floats b) { return hn::Sub(a, hn::Mul(square, b)); };
  // grad h times h |d|^2
  const Floats gx = lessLength(moment.x, length.x), gy = lessLength(moment.y, length.y);
  const Floats gradient = hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy));
  const Floats perLength = hn::Div(one, hn::Sqrt(hn::Max(gradient, tiny)));
  // (h - 1) h |d|^2
  const Floats beyond = hn::Sub(value, hn::Sqrt(hn::Mul(value, length.value)));
  const Floats distance = hn::Mul(beyond, perLength);
  const Floats nx = hn::Mul(gx, perLength), ny = hn::Mul(gy, perLength);
  // Curvature of the curve of equal h: from the second derivative along it.
  const Floats xx = lessLength(moment.xx, length.xx), xy = lessLength(moment.xy, length.xy),
               yy = lessLength(moment.yy, length.yy);
  const Floats bentX = hn::Sub(hn::Mul(xx, ny), hn::Mul(xy, nx)),
               bentY = hn::Sub(hn::Mul(yy, nx), hn::Mul(xy, ny));
  const Floats bent = hn::Add(hn::Mul(bentX, ny), hn::Mul(bentY, nx));
  const Floats toCenter = hn::Div(one, hn::Max(hn::Mul(bent, perLength), straightest));
  return { distance, nx, ny, hn::Neg(hn::Mul(nx, toCenter)), hn::Neg(hn::Mul(ny, toCenter)),
    hn::Sub(toCenter, distance) };
}

/// How much of a pixel lies beyond a straight line at a distance from its centre: from the
/// trapezoid that a square shows in the direction of the normal.
class PixelProfile
{
public:
  PixelProfile(Floats nx, Floats ny)
  {
    const Floats wide = hn::Max(hn::Abs(nx), hn::Abs(ny));
    const Floats narrow = hn::Min(hn::Abs(nx), hn::Abs(ny));
    const Floats half = number(0.5F);
    const Floats area = hn::Max(hn::Mul(number(2.0F), hn::Mul(wide, narrow)), number(1e-9F));
    const Floats both = hn::Div(number(1.0F), hn::Mul(wide, area));
    flat_ = hn::Mul(half, hn::Sub(wide, narrow));
    end_ = hn::Mul(half, hn::Add(wide, narrow));
    perWide_ = hn::Mul(both, area);
    perArea_ = hn::Mul(both, wide);
  }

  /// The share, less 1/2.
  [[nodiscard]] Floats moreThanHalfBeyond(Floats distance) const
  {
    const Floats x = hn::Abs(distance);
    const Floats left = hn::Max(hn::Sub(end_, x), number(0.0F));
    const Floats bent = hn::Sub(number(0.5F), hn::Mul(hn::Mul(left, left), perArea_));
    return hn::CopySign(hn::IfThenElse(hn::Le(x, flat_), hn::Mul(x, perWide_), bent), distance);
  }

private:
  Floats flat_, end_, perWide_, perArea_;
};

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
