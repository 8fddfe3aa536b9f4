// SPDX-License-Identifier: BSD-3-Clause
#include "RimShares.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. There are no fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "RimShares.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "RimLanes-inl.h" // after foreach_target.h

#ifndef po_RimShares_cxx
#define po_RimShares_cxx
namespace po
{
/// What is painted where.
struct RimPainting
{
  const RimEdges& edges;
  const RayPatch& patch;
  std::uint32_t firstNumber; ///< of the layer of the edges' spheres
  const ShownBlock& shown;
  const SilhouetteRule& rule;
  const std::vector<EdgeNeighbour>& neighbours;
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// A rim farther than this from an edge, in pixels, is not what the edge is the edge of.
constexpr float FarFromEdge = 1.5F;

/// Paints the lines of one block.
class Painter
{
public:
  Painter(const RimPainting& all, CoveredPixels& covered, std::uint32_t* codes)
    : edges_(all.edges)
    , patch_(all.patch)
    , firstNumber_(all.firstNumber)
    , depth_(all.shown.depths.depth.data())
    , spheres_(all.shown.spheres)
    , stride_(all.shown.depths.stride())
    , rule_(all.rule)
    , neighbours_(all.neighbours)
    , farthest_(rule_.backgroundLines ? std::numeric_limits<float>::infinity()
                                      : std::numeric_limits<float>::max())
    , followsJump_(rule_.greyByJump || rule_.maximumWidth > rule_.width)
    , covered_(covered)
    , codes_(codes)
  {
  }

  /// Lists all that is covered first: the loops over it are long, and nothing in them depends on
  /// what is not known yet.
  void paint()
  {
    const std::size_t edges = edges_.count() + MostLanes;
    covered_.reserve(edges, edges * neighbours_.size() + MostLanes);
    for (std::size_t first = 0; first < edges_.count(); first += hn::Lanes(Tag()))
    {
      coverFrom(first);
    }
    mergeOwn();
    mergeNeighbours();
  }

private:
  static constexpr std::size_t MostLanes = EdgeGroup::Size;
  static constexpr int EdgeShift = 16; ///< blocks have fewer pixels than 2^16
  static constexpr std::uint32_t PixelMask = (1U << EdgeShift) - 1;
  /// No pixel shows the sphere of this number.
  static constexpr std::int32_t Nobody = -2;

  /// Edges side by side in the list, with what is known of all pixels around them.
  struct Edges
  {
    std::size_t first;
    Integers place; ///< as in CoveredPixels
    Integers directions;
    Integers front; ///< as in LineCode
    Floats rimDepth, depth;
    RimCircles rims;
    PixelProfile profile;
  };

  /// Notes what the lines along the rims at some edges cover.
  void coverFrom(std::size_t first)
  {
    const Integers pixel = load(edges_.pixel, first), toFront = load(edges_.toFront, first);
    const RimCircles rims = circlesOf(patch_, edges_, first);
    const Integers rows = hn::ShiftLeft<LineCode::StepBits>(hn::ShiftRight<2>(toFront));
    const Integers front = hn::Add(hn::Add(rows, hn::And(toFront, number(3))),
      number((LineCode::NoStep - 1) * (1 + LineCode::StepMask + 1)));
    const Integers index =
      hn::Add(hn::Iota(IntegerTag(), 0), number(static_cast<std::int32_t>(first)));
    // Where jumps matter, each edge has its own.
    const Integers directions = followsJump_ ? number(-1) : load(edges_.directions, first);
    const Edges edges{ first, hn::Add(hn::ShiftLeft<EdgeShift>(index), pixel), directions, front,
      load(edges_.depth, first), hn::GatherIndex(Tag(), depth_, pixel), rims,
      PixelProfile(rims.nx, rims.ny) };
    setLimits(edges);
    coverOwn(edges);
    for (const EdgeNeighbour& neighbour : neighbours_)
    {
      coverNeighbour(edges, neighbour);
    }
  }

  void setLimits(const Edges& edges)
  {
    const Tag d;
    const Floats jump = number(static_cast<float>(rule_.jump));
    const Floats limit = hn::Add(edges.rimDepth, jump);
    hn::StoreU(limit, d, covered_.limit.data() + edges.first);
    // With the slope test all pixels of the sphere are beside an edge.
    const Lanes isBeside =
      hn::And(hn::Gt(edges.depth, limit), hn::Le(edges.depth, number(farthest_)));
    const auto keepsSphere = hn::RebindMask(IntegerTag(), isBeside);
    const Integers sphere = rule_.slopeTest
      ? sphereOf(edges)
      : hn::IfThenElse(keepsSphere, sphereOf(edges), number(Nobody));
    store(sphere, covered_.sphere.data() + edges.first);
  }

  void coverOwn(const Edges& edges)
  {
    const Share share = shareOf(edges, edges.rims.distance, edges.depth);
    const Lanes isFar = hn::Gt(hn::Abs(edges.rims.distance), number(FarFromEdge));
    const Integers strength =
      rounded(hn::IfThenElse(isFar, share.weight, share.strength), LineCode::StrengthScale);
    const Integers code = codeOf(edges, strength, share.inside, { 0, 0, 0 });
    store(
      hn::IfThenElseZero(hn::Gt(strength, number(0)), code), covered_.ownCode.data() + edges.first);
  }

  void coverNeighbour(const Edges& edges, const EdgeNeighbour& neighbour)
  {
    const Floats distance = edges.rims.distanceAt(neighbour.column, neighbour.row);
    const Floats behind = followsJump_ ? behindRim(edges, neighbour) : edges.depth;
    const Share share = shareOf(edges, distance, behind);
    const Integers strength = rounded(share.strength, LineCode::StrengthScale);
    const auto kept = hn::And(
      hn::Gt(strength, number(0)), hn::TestBit(edges.directions, number(neighbour.direction)));
    const auto note = [&](Integers values, std::vector<std::uint32_t>& to)
    { store(hn::Compress(values, kept), to.data() + count_); };
    const Integers offset = number(neighbour.row * stride_ + neighbour.column);
    note(hn::Add(edges.place, offset), covered_.place);
    note(codeOf(edges, strength, share.inside, neighbour), covered_.code);
    count_ += hn::CountTrue(IntegerTag(), kept);
  }

  /// Depth behind the rim in pixels beside edges: a pixel of the sphere is covered in part by what
  /// the edge shows.
  [[nodiscard]] Floats behindRim(const Edges& edges, const EdgeNeighbour& neighbour) const
  {
    const Integers offset = number(neighbour.row * stride_ + neighbour.column);
    const Integers pixel = hn::Add(load(edges_.pixel, edges.first), offset);
    const auto* spheres = reinterpret_cast<const std::int32_t*>(spheres_);
    const Integers shown = hn::GatherIndex(IntegerTag(), spheres, pixel);
    const Lanes isHere = hn::RebindMask(Tag(), hn::Eq(shown, sphereOf(edges)));
    return hn::IfThenElse(isHere, edges.depth, hn::GatherIndex(Tag(), depth_, pixel));
  }

  [[nodiscard]] Integers sphereOf(const Edges& edges) const
  {
    return hn::Add(
      load(edges_.place, edges.first), number(static_cast<std::int32_t>(firstNumber_)));
  }

  /// What the line covers of pixels, and what lies within the rim.
  struct Share
  {
    Floats strength, inside, weight;
  };

  [[nodiscard]] Share shareOf(const Edges& edges, Floats distance, Floats behind) const
  {
    Floats width = number(static_cast<float>(rule_.width)), weight = number(1.0F);
    if (followsJump_)
    {
      const Floats ramp = rampAt(rule_.ramp, hn::Sub(behind, edges.rimDepth));
      const auto growth = static_cast<float>(rule_.maximumWidth - rule_.width);
      width = hn::Add(width, hn::Mul(ramp, number(growth)));
      weight = rule_.greyByJump ? ramp : weight;
    }
    const Floats beyond = edges.profile.moreThanHalfBeyond(distance);
    const Floats outer = edges.profile.moreThanHalfBeyond(hn::Sub(distance, width));
    const Floats inside =
      hn::IfThenElseZero(hn::Ge(distance, number(0.0F)), hn::Sub(number(0.5F), beyond));
    return { hn::Mul(hn::Sub(beyond, outer), weight), hn::Mul(inside, weight), weight };
  }

  static Integers rounded(Floats value, float scale)
  {
    return hn::NearestInt(hn::Mul(value, number(scale)));
  }

  /// LineCode.
  [[nodiscard]] static Integers codeOf(
    const Edges& edges, Integers strength, Floats inside, const EdgeNeighbour& neighbour)
  {
    const Integers high =
      hn::Or(hn::ShiftLeft<LineCode::InsideBits>(strength), rounded(inside, LineCode::InsideScale));
    const Integers front =
      hn::Sub(edges.front, number(neighbour.row * (LineCode::StepMask + 1) + neighbour.column));
    return hn::Or(hn::ShiftLeft<LineCode::FrontBits>(high), front);
  }

  static void store(Integers values, std::uint32_t* to)
  {
    hn::StoreU(values, IntegerTag(), reinterpret_cast<std::int32_t*>(to));
  }

  void mergeOwn() const
  {
    for (std::size_t k = 0; k < edges_.count(); ++k)
    {
      std::uint32_t& code = codes_[edges_.pixel[k]];
      code = std::max(code, covered_.ownCode[k]);
    }
  }

  /// Pixels of the sphere, and what lies behind its rim. Without branches, which nothing could
  /// predict.
  void mergeNeighbours() const
  {
    for (std::size_t k = 0; k < count_; ++k)
    {
      const std::uint32_t edge = covered_.place[k] >> EdgeShift,
                          pixel = covered_.place[k] & PixelMask;
      const float depth = depth_[pixel];
      const unsigned isHere = spheres_[pixel] == covered_.sphere[edge] ? 1 : 0;
      const unsigned isBehind =
        (depth > covered_.limit[edge] ? 1U : 0U) & (depth <= farthest_ ? 1U : 0U);
      const std::uint32_t code = covered_.code[k] | (isHere * LineCode::Here);
      codes_[pixel] = std::max(codes_[pixel], code & (0 - (isHere | isBehind)));
    }
  }

  const RimEdges& edges_;
  const RayPatch& patch_;
  std::uint32_t firstNumber_;
  const float* depth_;
  const std::uint32_t* spheres_;
  int stride_;
  const SilhouetteRule& rule_;
  const std::vector<EdgeNeighbour>& neighbours_;
  float farthest_; ///< that lines are drawn behind
  bool followsJump_;
  CoveredPixels& covered_;
  std::uint32_t* codes_;
  std::size_t count_ = 0; ///< of covered pixels beside edges
};

void paintLines(const RimPainting& all, CoveredPixels& covered, std::uint32_t* codes)
{
  Painter(all, covered, codes).paint();
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(paintLines);

void CoveredPixels::reserve(std::size_t edges, std::size_t neighbours)
{
  if (limit.size() < edges)
  {
    ownCode.resize(edges);
    limit.resize(edges);
    sphere.resize(edges);
  }
  if (place.size() < neighbours)
  {
    place.resize(neighbours);
    code.resize(neighbours);
  }
}

RimBrush::RimBrush(const SilhouetteRule& rule)
  : rule_(rule)
  , reach_(static_cast<int>(std::ceil(rule.maximumWidth)))
{
  const auto sign = [](int number) { return (number > 0) - (number < 0); };
  for (int row = -reach_; row <= reach_; ++row)
  {
    for (int column = -reach_; column <= reach_; ++column)
    {
      if (row != 0 || column != 0)
      {
        neighbours_.push_back({ column, row, 1 << (3 * (sign(row) + 1) + sign(column) + 1) });
      }
    }
  }
}

void RimBrush::paint(const RimEdges& edges, const RayPatch& patch, std::uint32_t firstNumber,
  const ShownBlock& shown, StrongestLines& lines)
{
  HWY_DYNAMIC_DISPATCH(paintLines)
  ({ edges, patch, firstNumber, shown, rule_, neighbours_ }, covered_, lines.codes());
}
}
#endif
