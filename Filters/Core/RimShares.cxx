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

#include "RimLanes-inl.h" // after foreach_target.h

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// A rim farther than this from an edge, in pixels, is not what the edge is the edge of.
constexpr float FarFromEdge = 1.5F;

/// A pixel whose centre lies about so far within a rim, rounded to whole pixels, shows the sphere.
constexpr float WithinRim = 0.75F;

/// Some pixels of a tile, one a lane.
struct TilePixels
{
  Integers i, j;
  Integers at; ///< in blocks that have more around
  Lanes isEdge;
};

/// Paints the lines of one tile.
class Painter
{
public:
  Painter(const RimTile& tile, const SilhouetteRule& rule, int reach, RimWork& work)
    : tile_(tile)
    , rule_(rule)
    , reach_(reach)
    , work_(work)
    , farthest_(rule.backgroundLines ? std::numeric_limits<float>::infinity()
                                     : std::numeric_limits<float>::max())
    , followsJump_(rule.greyByJump || rule.maximumWidth > rule.width)
  {
  }

  /// Lists all pixels first: the loops over them are long, and nothing in them depends on what is
  /// not known yet.
  void paint(const std::vector<Rim>& rims, RimLines& painted)
  {
    for (const Rim& rim : rims)
    {
      listPixels(rim);
    }
    work_.reserveCovered(listed_ + MostLanes);
    for (std::size_t first = 0; first < listed_; first += hn::Lanes(Tag()))
    {
      cover(first, *work_.rims[first / hn::Lanes(Tag())]);
    }
    merge(painted);
  }

private:
  static constexpr std::size_t MostLanes = 16;
  /// Without AVX-512 it takes longer to leave out pixels than to merge them with strength 0.
  static constexpr bool CompressesFast = HWY_TARGET <= HWY_AVX3;
  /// A place behind the last pixel.
  static constexpr std::size_t Unused = TileLines::indexOf(0, DepthTileSize) - 1;
  // In lists of pixels, which are i + 32 j.
  static constexpr std::int32_t EdgeBit = 1 << 10, NoPixel = 1 << 11;

  /// Lists the pixels that a line can cover, and fills the last group up.
  void listPixels(const Rim& rim)
  {
    const std::size_t lanes = hn::Lanes(Tag()), first = listed_;
    work_.reserveListed(first + DepthTileSize * DepthTileSize + MostLanes);
    std::uint32_t rows = spread(rim.rows) >> Rim::Border & ((1U << tile_.rows) - 1);
    for (; rows != 0; rows &= rows - 1)
    {
      const auto j = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rows));
      std::uint32_t edges = 0;
      for (int row = j + Rim::Border - reach_; row <= j + Rim::Border + reach_; ++row)
      {
        edges |= rim.edges[static_cast<std::size_t>(row)];
      }
      const std::uint32_t inside = (1U << tile_.columns) - 1;
      listRow(j, spread(edges) >> Rim::Border & inside,
        rim.edges[static_cast<std::size_t>(j + Rim::Border)] >> Rim::Border);
    }
    if (listed_ > first)
    {
      const std::int32_t filling = work_.pixels[listed_ - 1] | NoPixel;
      hn::StoreU(number(filling), IntegerTag(), work_.pixels.data() + listed_);
      listed_ += (first - listed_) % lanes;
    }
    std::fill(work_.rims.begin() + first / lanes, work_.rims.begin() + listed_ / lanes, &rim);
  }

  /// Sets the bits up to the reach from each bit.
  [[nodiscard]] std::uint32_t spread(std::uint32_t bits) const
  {
    for (int step = 0; step < reach_; ++step)
    {
      bits |= bits << 1 | bits >> 1;
    }
    return bits;
  }

  void listRow(int j, std::uint32_t pixels, std::uint32_t edges)
  {
    if constexpr (!CompressesFast)
    {
      for (; pixels != 0; pixels &= pixels - 1)
      {
        const auto i = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(pixels));
        const bool isEdge = (edges >> i & 1U) != 0;
        work_.pixels[listed_++] = 32 * j + i + (isEdge ? EdgeBit : 0);
      }
      return;
    }
    const IntegerTag integers;
    for (int i = 0; i < DepthTileSize; i += static_cast<int>(hn::Lanes(integers)))
    {
      const auto isEdge = maskOf(edges >> i), isListed = maskOf(pixels >> i);
      const Integers pixel = countFrom(32 * j + i);
      const Integers marked = hn::Add(pixel, hn::IfThenElseZero(isEdge, number(EdgeBit)));
      hn::StoreU(hn::Compress(marked, isListed), integers, work_.pixels.data() + listed_);
      listed_ += hn::CountTrue(integers, isListed);
    }
  }

  static hn::Mask<IntegerTag> maskOf(std::uint32_t bits)
  {
    const std::uint8_t bytes[8] = { static_cast<std::uint8_t>(bits),
      static_cast<std::uint8_t>(bits >> 8) };
    return hn::LoadMaskBits(IntegerTag(), bytes);
  }

  /// Notes what the line along a rim covers of some pixels.
  void cover(std::size_t first, const Rim& rim)
  {
    const Integers listed = hn::LoadU(IntegerTag(), work_.pixels.data() + first);
    const auto has = [listed](std::int32_t bit)
    { return hn::RebindMask(Tag(), hn::Ne(hn::And(listed, number(bit)), number(0))); };
    const Integers i = hn::And(listed, number(31));
    const Integers j = hn::And(hn::ShiftRight<5>(listed), number(31));
    const Integers row = hn::Add(hn::Mul(j, number(tile_.pitch)), number(tile_.first));
    const TilePixels pixels{ i, j, hn::Add(row, i), has(EdgeBit) };
    const auto fromMiddle = [](Integers place)
    { return hn::ConvertTo(Tag(), hn::Sub(place, number(DepthTileSize / 2))); };
    const Place place = placeOf(rim.squaredMoment, *rim.patch, fromMiddle(i), fromMiddle(j));

    const Integers sphere = number(static_cast<std::int32_t>(rim.shown));
    const Lanes isHere = hn::RebindMask(Tag(), hn::Eq(gather(tile_.shown, pixels.at), sphere));
    const Floats jump = jumpOf(pixels, isHere, rim);
    const Lanes isBehind = hn::And(
      hn::Gt(jump, number(static_cast<float>(rule_.jump))), hn::Le(jump, number(farthest_)));
    // Pixels of the sphere are beside an edge.
    const Lanes isBeside = rule_.slopeTest ? hn::Or(isHere, isBehind) : isBehind;
    const Lanes isLine = hn::AndNot(has(NoPixel), hn::Or(pixels.isEdge, isBeside));
    const Share share = shareOf(place, jump, pixels.isEdge);
    const Lanes isCovered = hn::And(isLine, hn::Gt(share.strength, number(0.0F)));
    note(isCovered, hn::Add(hn::Mul(j, number(TileLines::Pitch)), i), share,
      stepsToFront(place, isHere), rim.shown);
  }

  /// From the rim to what lies behind it. Pixels of the sphere are covered in part, by what lies
  /// behind at the edges around: the farthest counts. It is not asked for where jumps do not
  /// matter.
  [[nodiscard]] Floats jumpOf(const TilePixels& pixels, Lanes isHere, const Rim& rim) const
  {
    Floats behind = hn::GatherIndex(Tag(), tile_.depth, pixels.at);
    if ((followsJump_ || !rule_.slopeTest) && !hn::AllFalse(Tag(), isHere))
    {
      behind = hn::IfThenElse(isHere, farthestAround(pixels.at, rim), behind);
    }
    return hn::Sub(behind, number(rim.depth));
  }

  [[nodiscard]] Floats farthestAround(Integers pixels, const Rim& rim) const
  {
    const Integers sphere = number(static_cast<std::int32_t>(rim.shown));
    Floats farthest = number(std::numeric_limits<float>::lowest());
    for (int row = -reach_; row <= reach_; ++row)
    {
      for (int column = -reach_; column <= reach_; ++column)
      {
        const Integers at = hn::Add(pixels, number(row * tile_.pitch + column));
        const auto isRim = hn::Eq(gather(tile_.fronts, at), sphere);
        if (!hn::AllFalse(IntegerTag(), isRim))
        {
          const Floats depth = hn::GatherIndex(Tag(), tile_.depth, at);
          farthest =
            hn::IfThenElse(hn::RebindMask(Tag(), isRim), hn::Max(farthest, depth), farthest);
        }
      }
    }
    return farthest;
  }

  /// What the line covers of pixels, and what lies within the rim.
  struct Share
  {
    Floats strength, inside;
  };

  [[nodiscard]] Share shareOf(const Place& place, Floats jump, Lanes isEdge) const
  {
    Floats width = number(static_cast<float>(rule_.width)), weight = number(1.0F);
    if (followsJump_)
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
      hn::IfThenElse(hn::And(isEdge, isFar), number(1.0F), hn::Sub(beyond, outer));
    const Floats inside =
      hn::IfThenElseZero(hn::Ge(place.distance, number(0.0F)), hn::Sub(number(1.0F), beyond));
    return { hn::Mul(covered, weight), hn::Mul(inside, weight) };
  }

  /// The way from a pixel to one of the sphere: none, or straight to the rim and a little further.
  [[nodiscard]] Integers stepsToFront(const Place& place, Lanes isHere) const
  {
    const Floats way = hn::Min(hn::Max(hn::Add(place.distance, number(WithinRim)), number(0.0F)),
      number(static_cast<float>(reach_ + 1)));
    const Floats back = hn::IfThenZeroElse(isHere, hn::Neg(way));
    const Integers i = hn::NearestInt(hn::Mul(place.nx, back));
    const Integers j = hn::NearestInt(hn::Mul(place.ny, back));
    const Integers row = hn::ShiftLeft<RimLines::RowBits>(j);
    return hn::Add(hn::Add(row, i), number(RimLines::NoStep));
  }

  void note(Lanes which, Integers at, const Share& share, Integers steps, std::uint32_t shown)
  {
    const Tag d;
    const IntegerTag integers;
    const auto store = [&](auto tag, auto values, auto* to)
    {
      const auto kept = hn::RebindMask(tag, which);
      if constexpr (CompressesFast)
      {
        hn::StoreU(hn::Compress(values, kept), tag, to + covered_);
      }
      else
      {
        hn::StoreU(hn::IfThenElseZero(kept, values), tag, to + covered_);
      }
    };
    store(integers, at, work_.at.data());
    store(integers, steps, work_.steps.data());
    store(d, share.strength, work_.strength.data());
    store(d, share.inside, work_.inside.data());
    hn::StoreU(number(static_cast<std::int32_t>(shown)), integers,
      reinterpret_cast<std::int32_t*>(work_.shown.data()) + covered_);
    covered_ += CompressesFast ? hn::CountTrue(d, which) : hn::Lanes(d);
  }

  /// Keeps what is stronger than what is there. Without branches, which nothing could predict.
  void merge(RimLines& painted) const
  {
    for (std::size_t k = 0; k < covered_; ++k)
    {
      const auto at = static_cast<std::size_t>(work_.at[k]);
      const float before = painted.lines.strength[at], now = work_.strength[k];
      const std::size_t to = now > before ? at : Unused;
      painted.lines.strength[at] = std::max(now, before);
      painted.lines.inside[to] = work_.inside[k];
      painted.steps[to] = work_.steps[k];
      painted.shown[to] = work_.shown[k];
    }
  }

  const RimTile& tile_;
  const SilhouetteRule& rule_;
  int reach_;
  RimWork& work_;
  float farthest_; ///< largest jump that a line beside an edge is drawn for
  bool followsJump_;
  std::size_t listed_ = 0, covered_ = 0;
};

void paintLines(const RimTile& tile, const std::vector<Rim>& rims, const SilhouetteRule& rule,
  int reach, RimWork& work, RimLines& painted)
{
  Painter(tile, rule, reach, work).paint(rims, painted);
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(paintLines);

void RimWork::reserveListed(std::size_t count)
{
  if (pixels.size() < count)
  {
    pixels.resize(2 * count);
    rims.resize(2 * count);
  }
}

void RimWork::reserveCovered(std::size_t count)
{
  if (at.size() < count)
  {
    at.resize(count);
    steps.resize(count);
    strength.resize(count);
    inside.resize(count);
    shown.resize(count);
  }
}

RimBrush::RimBrush(const SilhouetteRule& rule)
  : rule_(rule)
  , reach_(static_cast<int>(std::ceil(rule.maximumWidth)))
{
}

void RimBrush::paint(const RimTile& tile, const std::vector<Rim>& rims, RimLines& painted)
{
  HWY_DYNAMIC_DISPATCH(paintLines)(tile, rims, rule_, reach_, work_, painted);
}
}
#endif
