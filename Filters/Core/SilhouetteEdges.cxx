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
  const int* neighbours;
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;
using Floats = hn::Vec<Tag>;
using Lanes = hn::Mask<Tag>;

/// Some samples side by side and what their neighbours say about them.
class EdgeTest
{
public:
  EdgeTest(const EdgeLimits& limits, const float* center)
    : limits_(limits)
    , center_(center)
    , t_(hn::LoadU(d_, center))
    , nearest_(hn::LoadU(d_, center + limits.neighbours[0]))
  {
    for (int k = 1; k < 8; ++k)
    {
      nearest_ = hn::Min(nearest_, hn::LoadU(d_, center + limits.neighbours[k]));
    }
  }

  /// Is a neighbour so much nearer that there may be an edge? Also where background borders on
  /// anything.
  [[nodiscard]] bool any() const
  {
    const Lanes steep = hn::Gt(hn::Sub(t_, nearest_), hn::Set(d_, limits_.smallestStep));
    return !hn::AllFalse(d_, steep);
  }

  /// Stores the jump of each sample, 0 where it is no edge, and the number of its front neighbour.
  void store(float* jumps, std::int32_t* fronts)
  {
    addNeighbours();
    const Lanes isBackground = hn::Eq(t_, infinity_);
    const Lanes isBeside = hn::Lt(nearest_, infinity_);
    const Lanes isDeep = hn::Gt(laplacian(), hn::Set(d_, limits_.threshold));
    const Lanes isSteep = hn::Gt(jump_, hn::Set(d_, limits_.slopeTest ? limits_.jump : 0.0F));
    const Floats inside = hn::IfThenElseZero(hn::And(isDeep, isSteep), jump_);
    const Floats outline =
      limits_.backgroundLines ? hn::IfThenElseZero(isBeside, infinity_) : hn::Zero(d_);
    hn::StoreU(hn::IfThenElse(isBackground, outline, inside), d_, jumps);
    const hn::RebindToSigned<Tag> integers;
    const Floats front = hn::IfThenElse(isBackground, nearestNeighbour_, front_);
    hn::StoreU(hn::ConvertTo(integers, front), integers, fronts);
  }

private:
  void addNeighbours()
  {
    for (int k = 0; k < 8; ++k)
    {
      const int offset = limits_.neighbours[k];
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
  const Floats infinity_ = hn::Set(d_, std::numeric_limits<float>::infinity());
  Floats t_, nearest_;
  Floats sum_ = hn::Zero(d_), backgrounds_ = hn::Zero(d_), largest_ = hn::Zero(d_);
  Floats jump_ = hn::Zero(d_), front_ = hn::Zero(d_), nearestNeighbour_ = hn::Zero(d_);
};

/// Jumps and fronts of `count` samples side by side, and some beyond; false if none is an edge, and
/// then nothing is stored.
bool findEdges(
  const EdgeLimits& limits, const float* centers, int count, float* jumps, std::int32_t* fronts)
{
  const Tag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  bool any = false;
  for (int i = 0; i < count; i += lanes)
  {
    EdgeTest test(limits, centers + i);
    const bool here = test.any();
    if (here && !any)
    {
      std::fill(jumps, jumps + i, 0.0F);
      any = true;
    }
    if (here)
    {
      test.store(jumps + i, fronts + i);
    }
    else if (any)
    {
      hn::StoreU(hn::Zero(d), d, jumps + i);
    }
  }
  return any;
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

void EdgeFinder::searchRow(int j, int begin, int end)
{
  const int start = j * block_.stride() + begin;
  const EdgeLimits limits{ static_cast<float>(rule_.threshold), static_cast<float>(rule_.jump),
    static_cast<float>(smallestStep(rule_)), rule_.slopeTest, rule_.backgroundLines,
    neighbours_.data() };
  if (!HWY_DYNAMIC_DISPATCH(findEdges)(
        limits, block_.depth.data() + start, end - begin, jumps_.data(), fronts_.data()))
  {
    return;
  }
  for (int i = 0; i < end - begin; ++i)
  {
    if (jumps_[static_cast<std::size_t>(i)] > 0)
    {
      const int front = neighbours_[static_cast<std::size_t>(fronts_[static_cast<std::size_t>(i)])];
      edges_.push_back({ start + i, start + i + front, jumps_[static_cast<std::size_t>(i)] });
    }
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
  const int stride = block_.stride();
  neighbours_ = { -stride - 1, -stride, -stride + 1, -1, 1, stride - 1, stride, stride + 1 };
  jumps_.resize(static_cast<std::size_t>(stride) + SampleBlock::Slack);
  fronts_.resize(jumps_.size());
  edges_.clear();
  const int rim = (margin_ - around_) * samples_;
  for (int j = rim; j < block_.rows * samples_ - rim; ++j)
  {
    searchRow(j, rim, stride - rim);
  }
  return !edges_.empty();
}
}
#endif
