// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteEdges.h"

#include <algorithm>
#include <cmath>

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. Sums have one order and no fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SilhouetteEdges.cxx"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#ifndef po_SilhouetteEdges_cxx
#define po_SilhouetteEdges_cxx
namespace po
{
/// What the rule asks of one sample, as numbers for the inner loop.
struct EdgeLimits
{
  float threshold, jump, smallestStep;
  bool slopeTest, backgroundLines;
};

/// Samples of a block that are tested; two more on each side are read.
struct TestedSamples
{
  int begin, end;        ///< columns
  int firstRow, lastRow; ///< the last is not tested
};

/// Of eight bytes each.
constexpr int SamplesOfCacheLine = 8;

/// Columns and rows to the neighbours of a sample; opposite ones are k and 7 - k.
constexpr int NeighbourI[8] = { -1, 0, 1, -1, 1, -1, 0, 1 };
constexpr int NeighbourJ[8] = { -1, -1, -1, 0, 0, 1, 1, 1 };
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// As long as the rows of a tile: groups lie in one tile each.
using Tag = hn::CappedTag<float, EdgeGroup::Size>;
using IntegerTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Lanes = hn::Mask<Tag>;

/// Some samples side by side and what their neighbours say about them.
class EdgeTest
{
public:
  EdgeTest(const EdgeLimits& limits, const float* center, int stride)
    : limits_(limits)
    , center_(center)
    , stride_(stride)
    , t_(hn::LoadU(d_, center))
  {
  }

  /// Which lanes are edges, one bit each; their jumps and fronts are stored.
  std::uint32_t find(EdgeGroup& group) const
  {
    Floats neighbours[8], steps[8];
    Floats sum = hn::Zero(d_);
    for (int k = 0; k < 8; ++k)
    {
      neighbours[k] = hn::LoadU(d_, center_ + offsetTo(k));
      steps[k] = hn::Sub(t_, neighbours[k]);
      sum = hn::Add(sum, steps[k]);
    }
    // Background makes steps, and their sum, infinite or not a number.
    if (hn::AllTrue(d_, hn::Lt(hn::Abs(sum), infinity_)))
    {
      return findInside(neighbours, steps, sum, group);
    }
    return findBesideBackground(neighbours, group);
  }

private:
  [[nodiscard]] int offsetTo(int k) const { return NeighbourJ[k] * stride_ + NeighbourI[k]; }

  std::uint32_t findInside(
    const Floats* neighbours, const Floats* steps, Floats sum, EdgeGroup& group) const
  {
    Floats jump = hn::Zero(d_), front = hn::Zero(d_);
    for (int k = 0; k < 8; ++k)
    {
      Floats candidate = steps[k];
      if (limits_.slopeTest)
      {
        // Less the slope before the jump or behind it, whichever is steeper.
        const Floats beyond = hn::LoadU(d_, center_ + 2 * offsetTo(k));
        const Floats lessBefore = hn::Sub(candidate, hn::Sub(neighbours[k], beyond));
        const Floats lessBehind = hn::Add(candidate, steps[7 - k]);
        candidate = hn::Min(candidate, hn::Min(lessBefore, lessBehind));
      }
      raise(candidate, k, jump, front);
    }
    const Lanes isDeep = hn::Gt(sum, hn::Set(d_, limits_.threshold));
    return store(hn::And(isDeep, isSteep(jump)), jump, front, group);
  }

  /// As above, where any of the samples or neighbours is background.
  std::uint32_t findBesideBackground(const Floats* neighbours, EdgeGroup& group) const
  {
    Floats sum = hn::Zero(d_), backgrounds = hn::Zero(d_);
    Floats largest = hn::Set(d_, limits_.jump);
    Floats jump = hn::Zero(d_), front = hn::Zero(d_), nearest = infinity_, nearestFront = front;
    for (int k = 0; k < 8; ++k)
    {
      const Floats n = neighbours[k];
      const Lanes isOpen = hn::Eq(n, infinity_);
      const Floats step = hn::IfThenZeroElse(isOpen, hn::Sub(t_, n));
      sum = hn::Add(sum, step);
      // A sample lies in front of background by at least as much as behind anything else.
      backgrounds = hn::Add(backgrounds, hn::IfThenElseZero(isOpen, hn::Set(d_, 1.0F)));
      largest = hn::Max(largest, step);
      nearestFront = hn::IfThenElse(hn::Le(n, nearest), placeOf(k), nearestFront);
      nearest = hn::Min(nearest, n);
      Floats slope = hn::Zero(d_);
      if (limits_.slopeTest)
      {
        // Background before the jump gives -infinity, behind it +infinity: neither is a slope.
        const Floats behind =
          hn::IfThenZeroElse(hn::Eq(neighbours[7 - k], infinity_), hn::Sub(neighbours[7 - k], t_));
        const Floats before = hn::Sub(n, hn::LoadU(d_, center_ + 2 * offsetTo(k)));
        slope = hn::Max(slope, hn::Max(before, behind));
      }
      raise(hn::Sub(step, slope), k, jump, front);
    }
    const Lanes isBackground = hn::Eq(t_, infinity_);
    const Floats laplacian = hn::Sub(sum, hn::Mul(backgrounds, largest));
    const Lanes isDeep = hn::Gt(laplacian, hn::Set(d_, limits_.threshold));
    const Floats inside = hn::IfThenElseZero(hn::And(isDeep, isSteep(jump)), jump);
    const Floats outline = limits_.backgroundLines
      ? hn::IfThenElseZero(hn::Lt(nearest, infinity_), infinity_)
      : hn::Zero(d_);
    const Floats jumps = hn::IfThenElse(isBackground, outline, inside);
    return store(
      hn::Gt(jumps, hn::Zero(d_)), jumps, hn::IfThenElse(isBackground, nearestFront, front), group);
  }

  [[nodiscard]] Lanes isSteep(Floats jump) const
  {
    return hn::Gt(jump, hn::Set(d_, limits_.slopeTest ? limits_.jump : 0.0F));
  }

  /// EdgeGroup::fronts of a neighbour.
  static Floats placeOf(int k)
  {
    return hn::Set(Tag(), static_cast<float>(4 * (NeighbourJ[k] + 1) + NeighbourI[k] + 1));
  }

  static void raise(Floats candidate, int k, Floats& jump, Floats& front)
  {
    const Lanes isLarger = hn::Gt(candidate, jump);
    jump = hn::Max(candidate, jump);
    front = hn::IfThenElse(isLarger, placeOf(k), front);
  }

  std::uint32_t store(Lanes isEdge, Floats jump, Floats front, EdgeGroup& group) const
  {
    const IntegerTag integers;
    hn::StoreU(jump, d_, group.jumps);
    hn::StoreU(hn::ConvertTo(integers, front), integers, group.fronts);
    std::uint8_t bytes[8] = {}; // Highway may write that many
    hn::StoreMaskBits(d_, isEdge, bytes);
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
  }

  const Tag d_;
  const EdgeLimits& limits_;
  const float* center_;
  int stride_;
  const Floats infinity_ = hn::Set(d_, std::numeric_limits<float>::infinity());
  Floats t_;
};

/// A row of samples, and the nearest of each and its neighbours to the left and right.
struct RowOfSamples
{
  Floats t, nearest;

  explicit RowOfSamples(const float* row)
    : t(hn::LoadU(Tag(), row))
    , nearest(hn::Min(t, hn::Min(hn::LoadU(Tag(), row - 1), hn::LoadU(Tag(), row + 1))))
  {
  }
};

/// Flags groups of samples, as many as a vector holds: 1 where a neighbour is so much nearer that
/// there may be an edge, else 0. Also where background borders on anything.
void flagSteep(const EdgeLimits& limits, const SampleBlock& block, const TestedSamples& tested,
  std::uint8_t* flags)
{
  const Tag d;
  const int lanes = static_cast<int>(hn::Lanes(d)), stride = block.stride();
  const int count = tested.end - tested.begin, groups = (count + lanes - 1) / lanes;
  const Floats smallest = hn::Set(d, limits.smallestStep);
  for (int g = 0; g < groups; ++g)
  {
    const Lanes inside = hn::FirstN(d, static_cast<std::size_t>(count - g * lanes));
    const float* row =
      block.depth.data() + block.indexOf(tested.begin + g * lanes, tested.firstRow);
    RowOfSamples below(row - stride), here(row);
    for (int j = 0; j < tested.lastRow - tested.firstRow; ++j, row += stride)
    {
      for (int i = 0; i < lanes; i += SamplesOfCacheLine)
      {
        hwy::Prefetch(block.next.at(g * lanes + i, tested.firstRow + j));
      }
      const RowOfSamples above(row + stride);
      const Floats nearest = hn::Min(here.nearest, hn::Min(below.nearest, above.nearest));
      const Lanes isSteep = hn::And(inside, hn::Gt(hn::Sub(here.t, nearest), smallest));
      flags[j * groups + g] = hn::AllFalse(d, isSteep) ? 0 : 1;
      below = here;
      here = above;
    }
  }
}

/// @return number of groups that have edges
std::size_t findEdges(
  const EdgeLimits& limits, const SampleBlock& block, const TestedSamples& tested, EdgeWork& work)
{
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  const int count = tested.end - tested.begin, groups = (count + lanes - 1) / lanes;
  const int rows = tested.lastRow - tested.firstRow;
  work.reserve(static_cast<std::size_t>(rows) * groups);
  flagSteep(limits, block, tested, work.flags.data());
  // Lists first what is to be tested: no branch would foretell where that is.
  std::size_t steep = 0, found = 0;
  for (int j = 0, at = 0; j < rows; ++j)
  {
    for (int g = 0; g < groups; ++g, ++at)
    {
      EdgeGroup& group = work.groups[steep];
      group.i = static_cast<std::int16_t>(tested.begin + g * lanes);
      group.j = static_cast<std::int16_t>(tested.firstRow + j);
      steep += work.flags[at];
    }
  }
  for (std::size_t at = 0; at < steep; ++at)
  {
    // In place: to copy a group whose parts were just written stalls.
    EdgeGroup& group = work.groups[found];
    group.i = work.groups[at].i;
    group.j = work.groups[at].j;
    if (block.readsSpheres)
    {
      hwy::Prefetch(block.spheres.at(group.i, group.j));
    }
    const int left = tested.end - group.i;
    const std::uint32_t inside = left < 32 ? (1U << left) - 1 : ~0U;
    const EdgeTest test(
      limits, block.depth.data() + block.indexOf(group.i, group.j), block.stride());
    group.edges = test.find(group) & inside;
    found += group.edges != 0;
  }
  return found;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(findEdges);

void EdgeWork::reserve(std::size_t count)
{
  if (flags.size() < count)
  {
    flags.resize(count);
    groups.resize(count + 1); // one that may have no edge
  }
}

EdgeFinder::EdgeFinder(const SilhouetteRule& rule, int samples, bool readsSpheres)
  : rule_(rule)
  , samples_(samples)
{
  block_.readsSpheres = readsSpheres;
}

void EdgeFinder::placeBackground()
{
  if (std::isfinite(rule_.background) && rule_.backgroundLines)
  {
    const auto depth = static_cast<float>(rule_.background - block_.origin);
    std::replace(
      block_.depth.begin(), block_.depth.end(), std::numeric_limits<float>::infinity(), depth);
  }
}

bool EdgeFinder::find(
  const DepthSource& source, const PixelRange& searched, const PixelRange& read, double origin)
{
  block_.x = read.x0;
  block_.y = read.y0;
  block_.resize(read.x1 - read.x0, read.y1 - read.y0, samples_);
  block_.origin = origin;
  source.fill(block_);
  placeBackground();
  const TestedSamples tested{ (searched.x0 - read.x0) * samples_,
    (searched.x1 - read.x0) * samples_, (searched.y0 - read.y0) * samples_,
    (searched.y1 - read.y0) * samples_ };
  const EdgeLimits limits{ static_cast<float>(rule_.threshold), static_cast<float>(rule_.jump),
    static_cast<float>(smallestStep(rule_)), rule_.slopeTest, rule_.backgroundLines };
  found_ = HWY_DYNAMIC_DISPATCH(findEdges)(limits, block_, tested, work_);
  return found_ > 0;
}
}
#endif
