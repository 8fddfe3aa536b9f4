// SPDX-License-Identifier: BSD-3-Clause
#include "TextureSmoothing.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. No sum is reordered, so that only fused multiply-adds make a difference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "TextureSmoothing.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
using Tap = TextureSmoothing::Tap;

/// Adds up term(tap) over the taps, in two sums, so that one need not wait for the other.
template <typename Term>
hn::Vec<Floats> sumOverTaps(const Tap* first, const Tap* last, const Term& term)
{
  const Floats d;
  auto even = hn::Zero(d);
  auto odd = hn::Zero(d);
  for (; last - first > 1; first += 2)
  {
    even = term(first[0], even);
    odd = term(first[1], odd);
  }
  return hn::Add(first == last ? even : term(*first, even), odd);
}

/// Are all texels from here on that make a vector inside others? Their sums do not matter.
inline bool isInside(const float* factors)
{
  const Floats d;
  return hn::AllFalse(d, hn::Gt(hn::LoadU(d, factors), hn::Zero(d)));
}

/// Of the texels of a row, the areas around weighted by the Gaussian.
/// @param sums are left as they are where texels are inside
void sumRow(const Tap* first, const Tap* last, const float* areas, const float* factors,
  std::size_t columns, float* sums)
{
  const Floats d;
  for (std::size_t i = 0; i < columns; i += hn::Lanes(d))
  {
    if (isInside(factors + i))
    {
      continue;
    }
    const auto addArea = [&](const Tap& tap, hn::Vec<Floats> sum)
    { return hn::MulAdd(hn::Set(d, tap.kernel), hn::LoadU(d, areas + tap.offset + i), sum); };
    hn::StoreU(sumOverTaps(first, last, addArea), d, sums + i);
  }
}

/// @param row where it begins in the padded arrays
void smoothRow(const Tap* first, const Tap* last, std::size_t row, const float* values,
  const float* areas, const float* scales, const float* factors, std::size_t columns,
  float* smoothed)
{
  const Floats d;
  for (std::size_t i = 0; i < columns; i += hn::Lanes(d))
  {
    const auto own = hn::LoadU(d, values + row + i);
    if (isInside(factors + i))
    {
      hn::StoreU(own, d, smoothed + i);
      continue;
    }
    const auto scale = hn::LoadU(d, scales + row + i);
    const auto addFlow = [&](const Tap& tap, hn::Vec<Floats> sum)
    {
      const std::size_t other = tap.offset + i;
      const auto part = hn::Mul(hn::Set(d, tap.kernel), hn::LoadU(d, areas + other));
      const auto flow = hn::Mul(part, hn::Min(scale, hn::LoadU(d, scales + other)));
      return hn::MulAdd(flow, hn::Sub(hn::LoadU(d, values + other), own), sum);
    };
    const auto change = sumOverTaps(first, last, addFlow);
    hn::StoreU(hn::MulAdd(hn::LoadU(d, factors + i), change, own), d, smoothed + i);
  }
}

/// Copies whole vectors: up to one is read and written behind the last of `count`.
inline float* copyVectors(const float* from, std::size_t count, float* to)
{
  const Floats d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d))
  {
    hn::StoreU(hn::LoadU(d, from + i), d, to + i);
  }
  return to + count;
}

/// Rows, continued by `margin` at both ends as they go around.
void padRows(
  const float* texels, std::size_t side, std::size_t margin, std::size_t stride, float* padded)
{
  for (std::size_t row = 0; row < side; ++row)
  {
    const float* from = texels + row * side;
    float* to = padded + row * stride;
    to = copyVectors(from + side - margin, margin, to);
    to = copyVectors(from, side, to);
    copyVectors(from, side - margin, to);
  }
}

/// d becomes sqrt(d / S'), where S' is S without its own d; 0 stays.
void scaleFactors(const float* sums, std::size_t texels, float* factors)
{
  const Floats d;
  const auto zero = hn::Zero(d);
  for (std::size_t i = 0; i < texels; i += hn::Lanes(d))
  {
    const auto factor = hn::LoadU(d, factors + i);
    const auto scaled = hn::Sqrt(hn::Div(factor, hn::LoadU(d, sums + i)));
    hn::StoreU(hn::IfThenElseZero(hn::Gt(factor, zero), scaled), d, factors + i);
  }
}

/// 1 / S, or 0 where d is 0, from S without its own d.
void invertSums(const float* factors, std::size_t texels, float* sums)
{
  const Floats d;
  const auto zero = hn::Zero(d);
  for (std::size_t i = 0; i < texels; i += hn::Lanes(d))
  {
    const auto factor = hn::LoadU(d, factors + i);
    const auto sum = hn::Mul(factor, hn::LoadU(d, sums + i));
    const auto inverse = hn::Div(hn::Set(d, 1.0f), sum);
    hn::StoreU(hn::IfThenElseZero(hn::Gt(factor, zero), inverse), d, sums + i);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "Constants.h"
#include "TexelMap.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace po
{
HWY_EXPORT(sumRow);
HWY_EXPORT(smoothRow);
HWY_EXPORT(padRows);
HWY_EXPORT(scaleFactors);
HWY_EXPORT(invertSums);

namespace
{
/// Neighbours of less weight are left out.
constexpr double SmallestKernel = 0.02;

/// Steps towards equal S. Errors do not fall further with a third.
constexpr int Scalings = 2;

double widthOf(int resolution, int directions)
{
  const double texel = Pi / (2.0 * resolution);
  return std::sqrt(0.01 + texel * texel) * std::pow(96.0 / directions, 0.25);
}

Vec3d centreOf(int resolution, int row, int column)
{
  return textureDirection({ (column + 0.5) / resolution, (row + 0.5) / resolution });
}
}

TextureSmoothing::TextureSmoothing(const SweepTexels& texels, int directions)
{
  if (texels.refinement() > 1 || directions < 1)
  {
    return;
  }
  const int resolution = texels.resolution();
  side_ = static_cast<std::size_t>(resolution);
  margin_ = side_ / 2;
  // Vectors may reach beyond the end of a row.
  stride_ = 2 * side_ + GroupSize;
  for (int row = 0; row < resolution; ++row)
  {
    areas_.insert(areas_.end(), side_, static_cast<float>(texelArea(resolution, row)));
  }
  addTaps(widthOf(resolution, directions));
  weigh(std::vector<float>(side_ * side_, 1.0f).data(), whole_);
}

void TextureSmoothing::addTaps(double width)
{
  const auto resolution = static_cast<int>(side_);
  const auto margin = static_cast<int>(margin_);
  for (int row = 0; row < resolution; ++row)
  {
    firstTap_.push_back(taps_.size());
    const Vec3d centre = centreOf(resolution, row, 0);
    for (int other = 0; other < resolution; ++other)
    {
      for (int shift = -margin; shift < resolution - margin; ++shift)
      {
        const double cosine = dot(centre, centreOf(resolution, other, shift));
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / width;
        const double kernel = std::exp(-0.5 * angle * angle);
        if (kernel >= SmallestKernel)
        {
          const std::size_t place = static_cast<std::size_t>(margin + shift);
          taps_.push_back({ static_cast<std::size_t>(other) * stride_ + place, float(kernel) });
        }
      }
    }
  }
  firstTap_.push_back(taps_.size());
}

std::size_t TextureSmoothing::rowOffset(std::size_t row) const
{
  return row * stride_ + margin_;
}

void TextureSmoothing::pad(const std::vector<float>& texels, std::vector<float>& padded) const
{
  padded.resize(side_ * stride_);
  HWY_DYNAMIC_DISPATCH(padRows)(texels.data(), side_, margin_, stride_, padded.data());
}

/// S of all texels, each without its own d.
void TextureSmoothing::sumOverKernel(
  const std::vector<float>& outside, Weights& weights, std::vector<float>& sums) const
{
  thread_local std::vector<float> scaled;
  scaled.resize(outside.size() + GroupSize);
  std::transform(
    outside.begin(), outside.end(), weights.factors.begin(), scaled.begin(), std::multiplies<>());
  pad(scaled, weights.areas);
  sums.resize(outside.size() + GroupSize);
  for (std::size_t row = 0; row < side_; ++row)
  {
    HWY_DYNAMIC_DISPATCH(sumRow)
    (taps_.data() + firstTap_[row], taps_.data() + firstTap_[row + 1], weights.areas.data(),
      weights.factors.data() + row * side_, side_, sums.data() + row * side_);
  }
}

void TextureSmoothing::weigh(const float* shares, Weights& weights) const
{
  thread_local std::vector<float> outside;
  thread_local std::vector<float> sums;
  const std::size_t texels = side_ * side_;
  outside.resize(texels);
  std::transform(areas_.begin(), areas_.end(), shares, outside.begin(), std::multiplies<>());
  weights.factors.assign(texels + GroupSize, 0.0f);
  std::transform(shares, shares + texels, weights.factors.begin(),
    [](float share) { return share > 0 ? 1.0f : 0.0f; });
  for (int i = 0; i < Scalings; ++i)
  {
    sumOverKernel(outside, weights, sums);
    HWY_DYNAMIC_DISPATCH(scaleFactors)(sums.data(), texels, weights.factors.data());
  }
  sumOverKernel(outside, weights, sums);
  HWY_DYNAMIC_DISPATCH(invertSums)(weights.factors.data(), texels, sums.data());
  pad(sums, weights.scales);
}

void TextureSmoothing::apply(float* values, const float* shares) const
{
  if (side_ == 0)
  {
    return;
  }
  thread_local Weights cut;
  thread_local std::vector<float> own;
  thread_local std::vector<float> padded;
  thread_local std::vector<float> smoothed;
  const bool isWhole =
    std::all_of(shares, shares + side_ * side_, [](float share) { return share == 1.0f; });
  if (!isWhole)
  {
    weigh(shares, cut);
  }
  const Weights& weights = isWhole ? whole_ : cut;
  own.resize(side_ * side_ + GroupSize);
  std::copy_n(values, side_ * side_, own.begin());
  pad(own, padded);
  smoothed.resize(side_ + GroupSize);
  for (std::size_t row = 0; row < side_; ++row)
  {
    HWY_DYNAMIC_DISPATCH(smoothRow)
    (taps_.data() + firstTap_[row], taps_.data() + firstTap_[row + 1], rowOffset(row),
      padded.data(), weights.areas.data(), weights.scales.data(),
      weights.factors.data() + row * side_, side_, smoothed.data());
    std::copy_n(smoothed.begin(), side_, values + row * side_);
  }
}
}
#endif
