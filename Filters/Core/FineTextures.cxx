// SPDX-License-Identifier: BSD-3-Clause
#include "FineTextures.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. All get the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "FineTextures.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// The texels of a group, side by side.
struct GroupTexels
{
  HWY_ALIGN float values[GroupSize];
  HWY_ALIGN float shares[GroupSize];

  GroupTexels(const FineTexels& texels, std::size_t first)
  {
    const Floats d;
    const auto one = hn::Set(d, 1.0f);
    for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
    {
      const std::size_t slot = first + lane;
      const auto weight = hn::LoadU(d, texels.weights + slot);
      const auto counts = hn::Gt(weight, hn::Zero(d));
      const auto share = hn::IfThenElseZero(counts, hn::LoadU(d, texels.outside + slot));
      const auto seen =
        hn::Div(hn::LoadU(d, texels.sums + slot), hn::IfThenElse(counts, weight, one));
      const auto light = hn::Mul(hn::Min(seen, one), hn::LoadU(d, texels.irradiance + slot));
      hn::Store(hn::IfThenElseZero(hn::Gt(share, hn::Zero(d)), light), d, values + lane);
      hn::Store(share, d, shares + lane);
    }
  }
};

/// Copies them to their places in a texture.
inline void copyRows(const float* from, const FineTextures::Row* rows, float* texture)
{
  const hn::CappedTag<float, PatchSide> d;
  for (std::size_t k = 0; k < PatchSide; ++k, from += PatchSide)
  {
    if (rows[k].count == PatchSide) // nearly always
    {
      for (std::size_t i = 0; i < PatchSide; i += hn::Lanes(d))
      {
        hn::StoreU(hn::LoadU(d, from + i), d, texture + rows[k].texel + i);
      }
    }
    else
    {
      std::copy_n(from, rows[k].count, texture + rows[k].texel);
    }
  }
}

void fillTexture(const FineTexels& texels, const FineTextures::Row* rows, std::size_t groups,
  float* values, float* shares)
{
  for (std::size_t g = 0; g < groups; ++g)
  {
    const GroupTexels group(texels, g * GroupSize);
    copyRows(group.values, rows + g * PatchSide, values);
    copyRows(group.shares, rows + g * PatchSide, shares);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(fillTexture);

FineTextures::FineTextures(const SweepTexels& texels)
{
  for (std::size_t slot = 0; slot < texels.slots(); slot += PatchSide)
  {
    Row row{ texels.texelOfSlot(slot), 0 };
    while (row.count < PatchSide && texels.texelOfSlot(slot + row.count) != SweepTexels::Empty)
    {
      ++row.count;
    }
    rows_.push_back(row);
  }
}

void FineTextures::fill(const FineTexels& texels, float* values, float* shares) const
{
  HWY_DYNAMIC_DISPATCH(fillTexture)
  (texels, rows_.data(), rows_.size() / PatchSide, values, shares);
}
}
#endif
