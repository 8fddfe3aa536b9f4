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
using Tag = hn::CappedTag<float, 8>;
using Floats = hn::Vec<Tag>;
using Lanes = hn::Mask<Tag>;
constexpr std::size_t MostLanes = 8;

/// Jumps of some samples side by side, 0 where there is no edge, and their front neighbours.
struct EdgeLanes
{
  HWY_ALIGN float jumps[MostLanes];
  HWY_ALIGN std::int32_t fronts[MostLanes];
};

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

  /// Which lanes are edges, one bit each.
  std::uint32_t store(EdgeLanes& lanes)
  {
    addNeighbours();
    const Lanes isBackground = hn::Eq(t_, infinity_);
    const Lanes isBeside = hn::Lt(nearest_, infinity_);
    const Lanes isDeep = hn::Gt(laplacian(), hn::Set(d_, limits_.threshold));
    const Lanes isSteep = hn::Gt(jump_, hn::Set(d_, limits_.slopeTest ? limits_.jump : 0.0F));
    const Floats inside = hn::IfThenElseZero(hn::And(isDeep, isSteep), jump_);
    const Floats outline =
      limits_.backgroundLines ? hn::IfThenElseZero(isBeside, infinity_) : hn::Zero(d_);
    const Floats jumps = hn::IfThenElse(isBackground, outline, inside);
    hn::Store(jumps, d_, lanes.jumps);
    const hn::RebindToSigned<Tag> integers;
    const Floats front = hn::IfThenElse(isBackground, nearestNeighbour_, front_);
    hn::Store(hn::ConvertTo(integers, front), integers, lanes.fronts);
    std::uint8_t bytes[8] = {}; // Highway may write that many
    hn::StoreMaskBits(d_, hn::Gt(jumps, hn::Zero(d_)), bytes);
    return bytes[0];
  }

private:
  void addNeighbours()
  {
    for (int k = 0; k < 8; ++k)
    {
      const int offset = NeighbourJ[k] * stride_ + NeighbourI[k];
      const Floats number = hn::Set(d_, static_cast<float>(k));
      const Floats n = hn::LoadU(d_, center_ + offset);
      const Lanes isBackground = hn::Eq(n, infinity_);
      const Floats step = hn::IfThenZeroElse(isBackground, hn::Sub(t_, n));
      sum_ = hn::Add(sum_, step);
      backgrounds_ = hn::Add(backgrounds_, hn::IfThenElseZero(isBackground, hn::Set(d_, 1.0F)));
      largest_ = hn::Max(largest_, step);
      nearestNeighbour_ = hn::IfThenElse(hn::Eq(n, nearest_), number, nearestNeighbour_);
      const Floats jump = limits_.slopeTest ? hn::Sub(step, slopeBeside(n, offset)) : step;
      const Lanes isLarger = hn::Gt(jump, jump_);
      jump_ = hn::Max(jump, jump_);
      front_ = hn::IfThenElse(isLarger, number, front_);
    }
  }

  /// The slope before the jump or behind it, whichever is steeper.
  [[nodiscard]] Floats slopeBeside(Floats n, int offset) const
  {
    // Background before the jump gives -infinity, behind it +infinity: neither is a slope.
    const Floats before = hn::Sub(n, hn::LoadU(d_, center_ + 2 * offset));
    const Floats b = hn::LoadU(d_, center_ - offset);
    const Floats behind = hn::IfThenZeroElse(hn::Eq(b, infinity_), hn::Sub(b, t_));
    return hn::Max(hn::Zero(d_), hn::Max(before, behind));
  }

  /// A sample lies in front of background by at least as much as behind anything else.
  [[nodiscard]] Floats laplacian() const
  {
    const Floats step = hn::Max(largest_, hn::Set(d_, limits_.jump));
    return hn::Sub(sum_, hn::Mul(backgrounds_, step));
  }

  const Tag d_;
  const EdgeLimits& limits_;
  const float* center_;
  int stride_;
  const Floats infinity_ = hn::Set(d_, std::numeric_limits<float>::infinity());
  Floats t_, nearest_;
  Floats sum_ = hn::Zero(d_), backgrounds_ = hn::Zero(d_), largest_ = hn::Zero(d_);
  Floats jump_ = hn::Zero(d_), front_ = hn::Zero(d_), nearestNeighbour_ = hn::Zero(d_);
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

/// Adds the edges among the lanes of `bits`, the first of which is sample (i, j).
inline void addEdges(const EdgeLanes& lanes, std::uint32_t bits, const float* center, int stride,
  int i, int j, std::vector<SilhouetteEdge>& edges)
{
  for (; bits != 0; bits &= bits - 1)
  {
    const auto lane = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
    const std::int32_t k = lanes.fronts[lane];
    const int di = NeighbourI[k], dj = NeighbourJ[k];
    // In place: a whole edge that is copied just after its parts were written stalls.
    SilhouetteEdge& edge = edges.emplace_back();
    edge.i = static_cast<std::int16_t>(i + lane);
    edge.j = static_cast<std::int16_t>(j);
    edge.frontI = static_cast<std::int16_t>(i + lane + di);
    edge.frontJ = static_cast<std::int16_t>(j + dj);
    edge.behind = center[lane];
    edge.front = center[lane + dj * stride + di];
    edge.jump = lanes.jumps[lane];
  }
}

/// @param nearest room for three rows of the block
void findEdges(const EdgeLimits& limits, const SampleBlock& block, const TestedSamples& tested,
  std::vector<float>& nearest, std::vector<SilhouetteEdge>& edges)
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
  EdgeLanes found;
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
        addEdges(found, test.store(found) & inside, row + i, stride, tested.begin + i, j, edges);
      }
    }
    std::swap(below, here);
    std::swap(here, above);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(findEdges);

EdgeFinder::EdgeFinder(const SilhouetteRule& rule, int samples, int around)
  : rule_(rule)
  , samples_(samples)
  , around_(around)
  // An edge looks at two samples in each direction.
  , margin_(around + (samples == 1 ? 2 : 1))
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
  const DepthSource& source, int x, int y, int columns, int rows, const DepthRange& range)
{
  block_.x = x - margin_;
  block_.y = y - margin_;
  block_.resize(columns + 2 * margin_, rows + 2 * margin_, samples_);
  block_.origin = range.nearest;
  source.fill(block_);
  placeBackground();
  const int rim = (margin_ - around_) * samples_;
  const TestedSamples tested{ rim, block_.stride() - rim, rim, block_.rows * samples_ - rim };
  const EdgeLimits limits{ static_cast<float>(rule_.threshold), static_cast<float>(rule_.jump),
    static_cast<float>(smallestStep(rule_)), rule_.slopeTest, rule_.backgroundLines };
  nearest_.resize(3 * (static_cast<std::size_t>(block_.stride()) + SampleBlock::Slack));
  edges_.clear();
  HWY_DYNAMIC_DISPATCH(findEdges)(limits, block_, tested, nearest_, edges_);
  return !edges_.empty();
}
}
#endif
