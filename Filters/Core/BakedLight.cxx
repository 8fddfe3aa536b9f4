// SPDX-License-Identifier: BSD-3-Clause
#include "BakedLight.h"

#include "MaskedSums.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace po
{
namespace
{
Vec3d towards(const DistantLight& light)
{
  return -normalized(light.direction);
}

/// A direction, looked along from each point of the texels in turn.
std::vector<SharedDirection> raysTowards(
  Vec3d direction, const SweepTexels& texels, const TexelPatterns& patterns)
{
  std::vector<SharedDirection> directions;
  for (std::size_t pattern = 0; pattern < TexelPatterns::Count; ++pattern)
  {
    directions.emplace_back(texels, patterns, pattern, direction, 1.0);
  }
  return directions;
}
}

BakedLight::BakedLight(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, bool outOfCore, Progress& progress)
  : scene_(scene)
  , particles_(particles)
  , intensity_(static_cast<float>(settings.light->intensity))
  , distance_(scene.cloud.toLocalReach(settings.maximumDistance))
  , texels_(settings.textureResolution)
  , patterns_(texels_, settings.seed, 0)
  , directions_(raysTowards(towards(*settings.light), texels_, patterns_))
  , formula_(texels_, patterns_, UniformBackground{})
  , workspaces_([this] { return makeWorkspace(); })
{
  if (!scene.hasMesh())
  {
    sweep_.emplace(scene, particles, texels_, settings.seed, towards(*settings.light), distance_,
      outOfCore, progress);
  }
}

BakedLight::Workspace BakedLight::makeWorkspace() const
{
  const std::vector<float> slots(texels_.slots());
  const std::vector<float> texels(formula_.texels());
  return { ParticleView(scene_, distance_, RayShare::One), {}, {}, {}, {}, slots, slots, texels,
    texels };
}

RawTextures BakedLight::addTo(const RawTextures& textures, Progress& progress)
{
  values_.resize(textures.count * formula_.texels());
  shares_.resize(values_.size());
  std::size_t count = 0;
  for (std::size_t first = 0; first < textures.count; first += count)
  {
    const std::size_t known =
      sweep_ ? sweep_->loadFor(textures.firstParticle + first) : textures.count;
    count = std::min(known, textures.count - first);
    tbb::parallel_for(first, first + count,
      [&](std::size_t place)
      {
        if (progress.advance(0))
        {
          addTo(textures, place);
        }
      });
  }
  return { textures.firstParticle, textures.count, values_.data(), shares_.data() };
}

/// @param place among the textures
void BakedLight::addTo(const RawTextures& textures, std::size_t place)
{
  Workspace& work = workspaces_.local();
  look(particles_[textures.firstParticle + place], work);
  const std::size_t texels = formula_.texels();
  for (std::size_t texel = 0; texel < texels; ++texel)
  {
    const std::size_t i = place * texels + texel;
    values_[i] = (textures.values[i] + intensity_ * work.light[texel]) / (1 + intensity_);
    shares_[i] = work.shares[texel];
  }
}

/// Fills D and the outside share of each texel of a particle.
void BakedLight::look(unsigned id, Workspace& work) const
{
  scene_.overlaps.find(id, work.overlaps);
  if (work.overlaps.buried)
  {
    formula_.fill(0, 0, work.light.data(), work.shares.data());
    return;
  }
  work.exposure.bits.clear();
  OutsideSurface outside = formula_.whole();
  if (!work.overlaps.caps.empty())
  {
    exposeTexels(texels_, patterns_, work.rims.find(texels_, work.overlaps.caps), work.exposure);
    formula_.cut(work.exposure, outside);
  }
  // Every point counts, those that face away too.
  std::transform(outside.shares.begin(), outside.shares.end(), work.weights.begin(),
    [](float share) { return TexelPatterns::Count * share; });
  formula_.fill(
    outside, sumsOf(id, work), work.weights.data(), work.light.data(), work.shares.data());
}

/// [slots] max(0, n.l), summed over the points of a texel that the light reaches.
const float* BakedLight::sumsOf(unsigned id, Workspace& work) const
{
  if (const float* swept = sweep_ ? sweep_->sums(id) : nullptr)
  {
    return swept;
  }
  std::fill(work.sums.begin(), work.sums.end(), 0.0f);
  if (!sweep_)
  {
    trace(id, work);
  }
  return work.sums.data();
}

void BakedLight::trace(unsigned id, Workspace& work) const
{
  Random unused(0, 0, 0); // each point has a ray of its own, so that nothing is drawn
  work.view.begin(id);
  for (const SharedDirection& direction : directions_)
  {
    if (facingOutside(direction.facing, work.exposure, direction.pattern, work.mask))
    {
      work.view.hide(direction, unused, work.mask.data());
      addMasked(texels_.groups(), work.mask.data(), direction.weight.data(), work.sums.data());
    }
  }
}

std::uint64_t BakedLight::rays() const
{
  std::uint64_t sum = 0;
  for (const Workspace& work : workspaces_)
  {
    sum += work.view.rays();
  }
  return sum;
}
}
