// SPDX-License-Identifier: BSD-3-Clause
#include "RimShares.h"

#include <cmath>
#include <limits>

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. There are no fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "RimShares.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// The pixels of one rim in a tile are few: longer vectors would be mostly empty.
using Tag = hn::CappedTag<float, 8>;
using IntegerTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Integers = hn::Vec<IntegerTag>;
using Lanes = hn::Mask<Tag>;

/// A rim farther than this from an edge, in pixels, is not what the edge is the edge of.
constexpr float FarFromEdge = 1.5F;

inline Floats number(float value)
{
  return hn::Set(Tag(), value);
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
  Floats wide, narrow; ///< the larger and the smaller component of the unit normal, without sign
  Floats perWide, perArea;
};

/// The distance from the rim is (h - r) / |grad h|, with lengths in radii.
inline Place placeOf(const Quadratic& squaredMoment, const RayPatch& patch, Floats x, Floats y)
{
  const Floats tiny = number(1e-30F), one = number(1);
  const Evaluated moment(squaredMoment, x, y), length(patch.squaredLength, x, y);
  const Floats square = hn::Div(hn::Max(moment.value, tiny), length.value);
  const Floats h = hn::Sqrt(square);
  // grad h times h |d|^2
  const Floats gx = hn::Sub(moment.halfX, hn::Mul(square, length.halfX));
  const Floats gy = hn::Sub(moment.halfY, hn::Mul(square, length.halfY));
  const Floats gradient = hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy));
  const Floats perLength = hn::Div(one, hn::Sqrt(hn::Max(gradient, tiny)));
  const Floats beyond = hn::Mul(hn::Sub(h, one), hn::Mul(h, length.value));
  const Floats nx = hn::Mul(hn::Abs(gx), perLength), ny = hn::Mul(hn::Abs(gy), perLength);
  const Floats wide = hn::Max(nx, ny), narrow = hn::Min(nx, ny);
  const Floats area = hn::Max(hn::Mul(number(2), hn::Mul(wide, narrow)), number(1e-9F));
  return { hn::Mul(beyond, perLength), wide, narrow, hn::Div(one, wide), hn::Div(one, area) };
}

/// Share of a pixel that lies beyond a straight line at a distance from its centre: the
/// distribution function of the trapezoid that a square shows in the direction of the normal.
inline Floats shareBeyond(Floats distance, const Place& place)
{
  const Floats half = number(0.5F), one = number(1), zero = number(0);
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
  return hn::IfThenElse(hn::Ge(jump, to), number(1), hn::IfThenElseZero(hn::Gt(jump, from), rise));
}

/// What the edges of one rim around each of some pixels say: the nearest front counts.
struct EdgesAround
{
  Lanes any = hn::FirstN(Tag(), 0);
  Floats front = number(std::numeric_limits<float>::infinity());
  Floats jump = number(0); ///< the largest
  Integers frontPixel = hn::Zero(IntegerTag());

  EdgesAround(const RimTile& tile, int index, std::int32_t rim, int reach)
  {
    const Tag d;
    const IntegerTag integers;
    for (int row = -reach; row <= reach; ++row)
    {
      for (int at = index + row * RimTile::EdgePitch - reach, end = at + 2 * reach; at <= end; ++at)
      {
        const auto isRim =
          hn::Eq(hn::LoadU(integers, tile.rims.data() + at), hn::Set(integers, rim));
        const Lanes is = hn::RebindMask(d, isRim);
        const Floats itsFront = hn::LoadU(d, tile.fronts.data() + at);
        const Lanes isNearer = hn::And(is, hn::Lt(itsFront, front));
        any = hn::Or(any, is);
        front = hn::IfThenElse(isNearer, itsFront, front);
        jump = hn::Max(jump, hn::IfThenElseZero(is, hn::LoadU(d, tile.jumps.data() + at)));
        frontPixel = hn::IfThenElse(hn::RebindMask(integers, isNearer),
          hn::LoadU(integers, tile.frontPixels.data() + at), frontPixel);
      }
    }
  }
};

/// Paints lines along one rim.
class Painter
{
public:
  Painter(const RayPatch& patch, const Rim& rim, const SilhouetteRule& rule, RimTile& tile)
    : patch_(patch)
    , rim_(rim)
    , rule_(rule)
    , tile_(tile)
    , reach_(reachOfLines(rule))
    , farthest_(rule.backgroundLines ? std::numeric_limits<float>::infinity()
                                     : std::numeric_limits<float>::max())
  {
  }

  /// Pixels (i, j) and those to the right of it; false if there is no line.
  bool paint(int i, int j)
  {
    const Tag d;
    const int edge = RimTile::edgeIndexOf(i, j);
    const EdgesAround itself(tile_, edge, rim_.number, 0);
    EdgesAround around(tile_, edge, rim_.number, reach_);
    const Lanes isEdge = itself.any;
    const Floats jump = hn::IfThenElse(isEdge, itself.jump, jumpBeside(around, i, j));
    const Lanes isBehind = hn::And(
      hn::Gt(jump, number(static_cast<float>(rule_.jump))), hn::Le(jump, number(farthest_)));
    const Lanes isLine = hn::Or(isEdge, hn::And(around.any, isBehind));
    if (hn::AllFalse(d, isLine))
    {
      return false;
    }
    around.frontPixel =
      hn::IfThenElse(hn::RebindMask(IntegerTag(), isEdge), itself.frontPixel, around.frontPixel);
    const Floats x = hn::Add(hn::Iota(d, 0), number(static_cast<float>(i - RimTile::Side / 2)));
    const Place place =
      placeOf(rim_.squaredMoment, patch_, x, number(static_cast<float>(j - RimTile::Side / 2)));
    return merge(place, jump, isEdge, isLine, around.frontPixel, RimTile::indexOf(i, j));
  }

private:
  /// From the sphere to what lies behind it at a pixel beside the edge. Pixels of the sphere itself
  /// are covered in part, by what lies behind it at the edge.
  [[nodiscard]] Floats jumpBeside(const EdgesAround& around, int i, int j) const
  {
    const IntegerTag integers;
    const int at = j * tile_.pitch + i;
    const auto* shown = reinterpret_cast<const std::int32_t*>(tile_.shown + at);
    const Lanes isFront = hn::RebindMask(Tag(),
      hn::Eq(hn::LoadU(integers, shown), hn::Set(integers, static_cast<std::int32_t>(rim_.shown))));
    const Floats depth = hn::LoadU(Tag(), tile_.depth + at);
    return hn::IfThenElse(isFront, around.jump, hn::Sub(depth, around.front));
  }

  bool merge(
    const Place& place, Floats jump, Lanes isEdge, Lanes isLine, Integers frontPixel, int at)
  {
    const Tag d;
    const IntegerTag integers;
    Floats width = number(static_cast<float>(rule_.width)), weight = number(1);
    if (rule_.greyByJump || rule_.maximumWidth > rule_.width)
    {
      const Floats ramp = rampAt(rule_.ramp, jump);
      const auto growth = static_cast<float>(rule_.maximumWidth - rule_.width);
      width = hn::Add(width, hn::Mul(ramp, number(growth)));
      weight = rule_.greyByJump ? ramp : weight;
    }
    const Floats beyond = shareBeyond(place.distance, place);
    const Floats outer = shareBeyond(hn::Sub(place.distance, width), place);
    const Lanes isFar = hn::Gt(hn::Abs(place.distance), number(FarFromEdge));
    const Floats covered =
      hn::IfThenElse(hn::And(isEdge, isFar), number(1), hn::Sub(beyond, outer));
    const Floats inside =
      hn::IfThenElseZero(hn::Ge(place.distance, number(0)), hn::Sub(number(1), beyond));

    const Floats strength = hn::Mul(covered, weight);
    const Floats before = hn::LoadU(d, tile_.strength.data() + at);
    const Lanes isStronger = hn::And(isLine, hn::Gt(strength, before));
    const auto store = [&](auto tag, auto lanes, auto value, auto* to)
    { hn::StoreU(hn::IfThenElse(lanes, value, hn::LoadU(tag, to)), tag, to); };
    store(d, isStronger, strength, tile_.strength.data() + at);
    store(d, isStronger, hn::Mul(inside, weight), tile_.inside.data() + at);
    store(integers, hn::RebindMask(integers, isStronger), frontPixel, tile_.front.data() + at);
    return !hn::AllFalse(d, isStronger);
  }

  const RayPatch& patch_;
  const Rim& rim_;
  const SilhouetteRule& rule_;
  RimTile& tile_;
  int reach_;
  float farthest_; ///< largest jump that a line beside an edge is drawn for
};

bool paintLine(const RayPatch& patch, const Rim& rim, const SilhouetteRule& rule, RimTile& tile)
{
  Painter painter(patch, rim, rule, tile);
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(Tag()));
  bool any = false;
  for (int j = 0; j < RimTile::Side; ++j)
  {
    for (std::uint32_t left = rim.pixels[static_cast<std::size_t>(j)]; left != 0;)
    {
      const auto i = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(left));
      any |= painter.paint(static_cast<int>(i), j);
      left = i + lanes < 32 ? left & (~0U << (i + lanes)) : 0;
    }
  }
  return any;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(paintLine);

namespace
{
/// |a + x b + y c|^2 times a factor.
Quadratic squareOf(const WindowFunction<Vec3d>& f, double factor)
{
  const auto product = [factor](double scale, const Vec3d& a, const Vec3d& b)
  { return static_cast<float>(factor * scale * dot(a, b)); };
  return { product(1, f.base, f.base), product(2, f.base, f.dx), product(2, f.base, f.dy),
    product(1, f.dx, f.dx), product(2, f.dx, f.dy), product(1, f.dy, f.dy) };
}
}

RayPatch makeRayPatch(const RayPencil& rays)
{
  const double scale = 1 / length(rays.localDirection.base);
  return { rays, scale, squareOf(rays.localDirection, scale * scale) };
}

Quadratic squaredMoment(const RayPatch& patch, const Sphere& sphere)
{
  const WindowFunction<Vec3d>& d = patch.rays.localDirection;
  const WindowFunction<Vec3d>& origin = patch.rays.localOrigin;
  const Vec3d toCenter = sphere.center().as<double>() - origin.base;
  const WindowFunction<Vec3d> moment{ cross(toCenter, d.base),
    cross(toCenter, d.dx) - cross(origin.dx, d.base),
    cross(toCenter, d.dy) - cross(origin.dy, d.base) };
  const double scale = patch.scale / sphere.radius;
  return squareOf(moment, scale * scale);
}

bool paintRim(const RayPatch& patch, const Rim& rim, const SilhouetteRule& rule, RimTile& tile)
{
  return HWY_DYNAMIC_DISPATCH(paintLine)(patch, rim, rule, tile);
}

int reachOfLines(const SilhouetteRule& rule)
{
  return static_cast<int>(std::ceil(rule.maximumWidth));
}
}
#endif
