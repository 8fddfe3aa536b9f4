// SPDX-License-Identifier: BSD-3-Clause
#include "PixelBlock.h"

#include <algorithm>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "PixelBlock.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, PixelBlock::Size>;
using Integers = hn::RebindToSigned<Floats>;
using Bytes = hn::Rebind<std::uint8_t, Floats>;
using Vector = hn::Vec<Floats>;

void addLight(const ParallelLight& light, const TexelLookup& normals, PixelBlock& block)
{
  const Floats d;
  const Vector x = hn::Set(d, light.toLight.x), y = hn::Set(d, light.toLight.y),
               z = hn::Set(d, light.toLight.z);
  const float color[] = { light.color.x, light.color.y, light.color.z };
  HWY_ALIGN float reach[PixelBlock::Size];
  std::fill_n(reach, PixelBlock::Size, 1.0f);
  if (light.reach)
  {
    std::transform(light.reach, light.reach + PixelBlock::Size, reach,
      [](std::uint8_t lit) { return lit ? 1.0f : 0.0f; });
  }
  for (std::size_t lane = 0; lane < PixelBlock::Size; lane += hn::Lanes(d))
  {
    const Vector facing = hn::MulAdd(hn::Load(d, normals.x + lane), x,
      hn::MulAdd(hn::Load(d, normals.y + lane), y, hn::Mul(hn::Load(d, normals.z + lane), z)));
    const Vector strength = hn::Mul(hn::Max(facing, hn::Zero(d)), hn::Load(d, reach + lane));
    for (std::size_t c = 0; c < 3; ++c)
    {
      float* sum = block.diffuseLight[c] + lane;
      hn::Store(hn::MulAdd(strength, hn::Set(d, color[c]), hn::Load(d, sum)), d, sum);
    }
  }
}

/// One colour of the lanes from `lane` on.
inline Vector compose(
  const ColorTerms& terms, const PixelBlock& block, std::size_t c, std::size_t lane)
{
  const Floats d;
  const Vector occlusion = hn::Load(d, block.occlusion + lane),
               diffuseColor = hn::Load(d, block.diffuseColor[c] + lane);
  if (terms.occlusionOnly)
  {
    return hn::Mul(occlusion, diffuseColor);
  }
  const Vector ambient = hn::Mul(
    hn::Mul(hn::Set(d, terms.ambient), occlusion), hn::Load(d, block.ambientColor[c] + lane));
  const Vector share = hn::Set(d, terms.diffuse);
  const Vector diffuse =
    hn::Mul(terms.occlusionOnDiffuse ? hn::Mul(share, occlusion) : share, diffuseColor);
  if (!terms.lit)
  {
    return hn::Add(ambient, diffuse);
  }
  const float specular[] = { terms.specularColor.x, terms.specularColor.y, terms.specularColor.z };
  const Vector highlight =
    hn::Mul(hn::Set(d, terms.specular * specular[c]), hn::Load(d, block.specularLight[c] + lane));
  return hn::Add(
    hn::MulAdd(diffuse, hn::Load(d, block.diffuseLight[c] + lane), ambient), highlight);
}

void composeColors(
  const ColorTerms& terms, const PixelBlock& block, const std::int32_t* shown, std::uint8_t* rgba)
{
  const Floats d;
  const Integers integers;
  const Bytes bytes;
  const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0f), most = hn::Set(d, 255.0f),
               half = hn::Set(d, 0.5f);
  for (std::size_t lane = 0; lane < PixelBlock::Size; lane += hn::Lanes(d))
  {
    const auto visible = hn::Ne(hn::Load(integers, shown + lane), hn::Zero(integers));
    const auto toBytes = [&](hn::Vec<Integers> v)
    { return hn::DemoteTo(bytes, hn::IfThenElseZero(visible, v)); };
    const auto color = [&](std::size_t c)
    {
      const Vector value = hn::Min(hn::Max(compose(terms, block, c, lane), zero), one);
      return toBytes(hn::ConvertTo(integers, hn::MulAdd(most, value, half)));
    };
    hn::StoreInterleaved4(color(0), color(1), color(2),
      toBytes(hn::Load(integers, block.alpha + lane)), bytes, rgba + 4 * lane);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(addLight);
HWY_EXPORT(composeColors);

void addLight(const ParallelLight& light, const TexelLookup& normals, PixelBlock& block)
{
  HWY_DYNAMIC_DISPATCH(addLight)(light, normals, block);
}

void composeColors(
  const ColorTerms& terms, const PixelBlock& block, const std::int32_t* shown, std::uint8_t* rgba)
{
  HWY_DYNAMIC_DISPATCH(composeColors)(terms, block, shown, rgba);
}
}
#endif
