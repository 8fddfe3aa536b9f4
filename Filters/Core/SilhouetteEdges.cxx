// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteEdges.h"

#include <algorithm>
#include <cmath>

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. Sums have one order and no fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SilhouetteEdges.cxx"
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

/// Columns and rows to the neighbours of a sample; opposite ones are k and 7 - k.
constexpr int NeighbourI[8] = { -1, 0, 1, -1, 1, -1, 0, 1 };
constexpr int NeighbourJ[8] = { -1, -1, -1, 0, 0, 1, 1, 1 };
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// Edges are few: longer vectors would hold as many.
using Tag = hn::CappedTag<float, EdgeGroup::Size>;
using IntegerTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Lanes = hn::Mask<Tag>;

/// Some samples side by side and what their neighbours say about them.
class EdgeTest
{
public:
  /// @param nearest of each sample and its neighbours
  EdgeTest(const EdgeLimits& limits, const float* center, int stride, Floats nearest)
    : limits_(limits)
    , center_(center)
    , stride_(stride)
    , t_(hn::LoadU(d_, center))
    , nearest_(nearest)
  {
  }

  /// Is a neighbour so much nearer that there may be an edge? Also where background borders on
  /// anything.
  [[nodiscard]] bool any() const
  {
    const Lanes steep = hn::Gt(hn::Sub(t_, nearest_), hn::Set(d_, limits_.smallestStep));
    return !hn::AllFalse(d_, steep);
  }

  /// Which lanes are edges, one bit each; their jumps and fronts are stored.
  std::uint32_t find(EdgeGroup& group)
  {
    Floats steps[8];
    Floats sum = hn::Zero(d_);
    for (int k = 0; k < 8; ++k)
    {
      steps[k] = hn::Sub(t_, hn::LoadU(d_, center_ + offsetTo(k)));
      sum = hn::Add(sum, steps[k]);
    }
    // Background makes steps, and their sum, infinite or not a number.
    if (hn::AllTrue(d_, hn::Lt(hn::Abs(sum), infinity_)))
    {
      return findInside(steps, sum, group);
    }
    return findBesideBackground(group);
  }

private:
  [[nodiscard]] int offsetTo(int k) const { return NeighbourJ[k] * stride_ + NeighbourI[k]; }

  std::uint32_t findInside(const Floats* steps, Floats sum, EdgeGroup& group) const
  {
    const Lanes isDeep = hn::Gt(sum, hn::Set(d_, limits_.threshold));
    if (hn::AllFalse(d_, isDeep))
    {
      return 0;
    }
    Floats jump = hn::Zero(d_), front = hn::Zero(d_);
    for (int k = 0; k < 8; ++k)
    {
      Floats slope = hn::Zero(d_);
      if (limits_.slopeTest)
      {
        const Floats beyond = hn::LoadU(d_, center_ + 2 * offsetTo(k));
        const Floats n = hn::LoadU(d_, center_ + offsetTo(k));
        slope = slopeBeside(hn::Sub(n, beyond), hn::Neg(steps[7 - k]));
      }
      raise(hn::Sub(steps[k], slope), k, jump, front);
    }
    const Lanes isSteep = hn::Gt(jump, hn::Set(d_, limits_.slopeTest ? limits_.jump : 0.0F));
    return store(hn::And(isDeep, isSteep), jump, front, group);
  }

  /// As above, where any of the samples or neighbours is background.
  std::uint32_t findBesideBackground(EdgeGroup& group) const
  {
    Floats sum = hn::Zero(d_), backgrounds = hn::Zero(d_);
    Floats largest = hn::Set(d_, limits_.jump);
    Floats jump = hn::Zero(d_), front = hn::Zero(d_), nearest = hn::Zero(d_);
    for (int k = 0; k < 8; ++k)
    {
      const Floats n = hn::LoadU(d_, center_ + offsetTo(k));
      const Lanes isOpen = hn::Eq(n, infinity_);
      const Floats step = hn::IfThenZeroElse(isOpen, hn::Sub(t_, n));
      sum = hn::Add(sum, step);
      // A sample lies in front of background by at least as much as behind anything else.
      backgrounds = hn::Add(backgrounds, hn::IfThenElseZero(isOpen, hn::Set(d_, 1.0F)));
      largest = hn::Max(largest, step);
      nearest = hn::IfThenElse(hn::Eq(n, nearest_), number(k), nearest);
      Floats slope = hn::Zero(d_);
      if (limits_.slopeTest)
      {
        // Background before the jump gives -infinity, behind it +infinity: neither is a slope.
        const Floats b = hn::LoadU(d_, center_ - offsetTo(k));
        const Floats behind = hn::IfThenZeroElse(hn::Eq(b, infinity_), hn::Sub(b, t_));
        slope = slopeBeside(hn::Sub(n, hn::LoadU(d_, center_ + 2 * offsetTo(k))), behind);
      }
      raise(hn::Sub(step, slope), k, jump, front);
    }
    const Lanes isBackground = hn::Eq(t_, infinity_);
    const Floats laplacian = hn::Sub(sum, hn::Mul(backgrounds, largest));
    const Lanes isDeep = hn::Gt(laplacian, hn::Set(d_, limits_.threshold));
    const Lanes isSteep = hn::Gt(jump, hn::Set(d_, limits_.slopeTest ? limits_.jump : 0.0F));
    const Floats inside = hn::IfThenElseZero(hn::And(isDeep, isSteep), jump);
    const Floats outline = limits_.backgroundLines
      ? hn::IfThenElseZero(hn::Lt(nearest_, infinity_), infinity_)
      : hn::Zero(d_);
    const Floats jumps = hn::IfThenElse(isBackground, outline, inside);
    return store(
      hn::Gt(jumps, hn::Zero(d_)), jumps, hn::IfThenElse(isBackground, nearest, front), group);
  }

  [[nodiscard]] Floats number(int k) const { return hn::Set(d_, static_cast<float>(k)); }

  /// The slope before the jump or behind it, whichever is steeper.
  [[nodiscard]] Floats slopeBeside(Floats before, Floats behind) const
  {
    return hn::Max(hn::Zero(d_), hn::Max(before, behind));
  }

  static void raise(Floats candidate, int k, Floats& jump, Floats& front)
  {
    const Tag d;
    const Lanes isLarger = hn::Gt(candidate, jump);
    jump = hn::Max(candidate, jump);
    front = hn::IfThenElse(isLarger, hn::Set(d, static_cast<float>(k)), front);
  }

  /// @param front number of the neighbour in front
  std::uint32_t store(Lanes isEdge, Floats jump, Floats front, EdgeGroup& group) const
  {
    const IntegerTag integers;
    // Numbers 0 to 8, with the centre, count rows of three.
    const Floats all = hn::IfThenElse(hn::Gt(front, number(3)), hn::Add(front, number(1)), front);
    const auto place = hn::ConvertTo(integers, all);
    const auto row = hn::ShiftRight<5>(hn::Mul(place, hn::Set(integers, 11))); // a third
    hn::StoreU(jump, d_, group.jumps);
    hn::StoreU(hn::Add(place, row), integers, group.fronts);
    std::uint8_t bytes[8] = {}; // Highway may write that many
    hn::StoreMaskBits(d_, isEdge, bytes);
    return bytes[0];
  }

  const Tag d_;
  const EdgeLimits& limits_;
  const float* center_;
  int stride_;
  const Floats infinity_ = hn::Set(d_, std::numeric_limits<float>::infinity());
  Floats t_, nearest_;
};

/// The nearest of each sample of a row and its neighbours to the left and right.
inline void findNearest(const float* row, int count, float* nearest)
{
  const Tag d;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d)))
  {
    const Floats beside = hn::Min(hn::LoadU(d, row + i - 1), hn::LoadU(d, row + i + 1));
    hn::StoreU(hn::Min(hn::LoadU(d, row + i), beside), d, nearest + i);
  }
}

/// @param nearest room for three rows of the block
/// @param groups room for all samples
/// @return number of groups that have edges
std::size_t findEdges(const EdgeLimits& limits, const SampleBlock& block,
  const TestedSamples& tested, std::vector<float>& nearest, EdgeGroup* groups)
{
  const Tag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int stride = block.stride(), count = tested.end - tested.begin;
  const auto rowOf = [&](int j)
  { return block.depth.data() + static_cast<std::ptrdiff_t>(j) * stride + tested.begin; };
  const std::size_t size = nearest.size() / 3;
  float* below = nearest.data();
  float* here = below + size;
  float* above = here + size;
  findNearest(rowOf(tested.firstRow - 1), count, below);
  findNearest(rowOf(tested.firstRow), count, here);
  std::size_t found = 0;
  for (int j = tested.firstRow; j < tested.lastRow; ++j)
  {
    const float* row = rowOf(j);
    findNearest(rowOf(j + 1), count, above);
    for (int i = 0; i < count; i += lanes)
    {
      const Floats around = hn::Min(hn::LoadU(d, below + i), hn::LoadU(d, above + i));
      EdgeTest test(limits, row + i, stride, hn::Min(around, hn::LoadU(d, here + i)));
      if (test.any())
      {
        const std::uint32_t inside = count - i < 32 ? (1U << (count - i)) - 1 : ~0U;
        // In place: to copy a group whose parts were just written stalls.
        EdgeGroup& group = groups[found];
        group.i = static_cast<std::int16_t>(tested.begin + i);
        group.j = static_cast<std::int16_t>(j);
        group.edges = test.find(group) & inside;
        found += group.edges != 0;
      }
    }
    std::swap(below, here);
    std::swap(here, above);
  }
  return found;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(findEdges);

EdgeFinder::EdgeFinder(const SilhouetteRule& rule, int samples)
  : rule_(rule)
  , samples_(samples)
{
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
  nearest_.resize(3 * (static_cast<std::size_t>(block_.stride()) + SampleBlock::Slack));
  // As many as there are in the shortest vectors of four samples, and one that may have no edge.
  const int perRow = (tested.end - tested.begin + 3) / 4;
  groups_.resize(static_cast<std::size_t>(perRow) * (tested.lastRow - tested.firstRow) + 1);
  found_ = HWY_DYNAMIC_DISPATCH(findEdges)(limits, block_, tested, nearest_, groups_.data());
  return found_ > 0;
}
}
#endif
