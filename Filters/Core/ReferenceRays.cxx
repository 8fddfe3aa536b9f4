// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRays.h"

#include "Constants.h"
#include "TexelMap.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// Texels near a pole are slivers: with noise of their own they would meet in a visible star. As
/// many as make up the width of a texel on the equator share their random numbers, so that their
/// errors are nearly equal; around the pole all do. Every texel by itself stays an unbiased
/// estimate.
int columnsSharingRandomNumbers(int resolution, int row)
{
  if (row == 0 || row == resolution - 1)
  {
    return resolution;
  }
  return static_cast<int>(std::lround(1 / std::sin(Pi * (row + 0.5) / resolution)));
}

bool insideAny(const std::vector<BuriedCap>& caps, Vec3d normal)
{
  return std::any_of(caps.begin(), caps.end(),
    [normal](const BuriedCap& cap) { return dot(normal, cap.axis) > cap.cosine; });
}
}

ReferenceRays::ReferenceRays(const BakeScene& scene, const BakeSettings& settings)
  : scene_(scene)
  , settings_(settings)
  , strata_(settings.samplesPerTexel)
{
  for (int row = 0; row < settings.textureResolution; ++row)
  {
    rows_.push_back({ texelAngularRadius(settings.textureResolution, row),
      columnsSharingRandomNumbers(settings.textureResolution, row) });
  }
}

bool ReferenceRays::beginParticle(unsigned id, Workspace& work) const
{
  work.pairing.resize(static_cast<std::size_t>(strata_.size()));
  scene_.overlaps.find(id, work.overlaps);
  return !work.overlaps.buried;
}

/// Sorts the caps into those that miss the texel and those that cut it; true if one covers it all.
bool ReferenceRays::isCovered(int row, int column, Workspace& work) const
{
  work.cuttingCaps.clear();
  const int resolution = settings_.textureResolution;
  const Vec3d center = textureDirection({ (column + 0.5) / resolution, (row + 0.5) / resolution });
  // A little wider than the texel: rounding may then cost time, but never a wrong answer.
  const double reach = rows_[static_cast<std::size_t>(row)].angularRadius + 1e-6;
  for (const BuriedCap& cap : work.overlaps.caps)
  {
    const double angle = std::acos(std::clamp(dot(center, cap.axis), -1.0, 1.0));
    const double halfAngle = std::acos(cap.cosine);
    if (angle + reach < halfAngle)
    {
      return true;
    }
    if (angle - reach <= halfAngle)
    {
      work.cuttingCaps.push_back(cap);
    }
  }
  return false;
}

/// One stratified set of rays from the part of a texel that is outside the cutting caps.
void ReferenceRays::addSet(unsigned id, const TexelPatch& patch, Random& random, Workspace& work,
  std::vector<SurfaceRay>& rays) const
{
  const Sphere sphere = scene_.set().inBrick(id);
  randomPermutation(random, work.pairing);
  const int samples = strata_.size();
  for (int k = 0; k < samples; ++k)
  {
    const Point2 place = strata_.point(k, random.uniform(), random.uniform());
    const Point2 heading =
      strata_.point(static_cast<int>(work.pairing[static_cast<std::size_t>(k)]), random.uniform(),
        random.uniform());
    const Vec3d normal = patch.point(place.x, place.y);
    if (!insideAny(work.cuttingCaps, normal))
    {
      rays.push_back(makeSurfaceRay(sphere, sphere.center() + sphere.radius * normal.as<float>(),
        aboutNormal(normal, cosineHemisphereFromSquare(heading)).as<float>()));
    }
  }
}

int ReferenceRays::makeRays(
  unsigned id, int row, int column, Workspace& work, std::vector<SurfaceRay>& rays) const
{
  if (isCovered(row, column, work))
  {
    return 0;
  }
  const int resolution = settings_.textureResolution;
  const TexelPatch patch(resolution, row, column);
  const int shared = rows_[static_cast<std::size_t>(row)].sharedColumns;
  Random random(
    settings_.seed, scene_.randomKey(id), texelIndex(resolution, row, column - column % shared));

  // A texel of which little is outside would be left with few rays, and show as a noisy rim of the
  // overlap: it gets further sets. Where to stop depends on the geometry alone, so there is no
  // bias.
  constexpr int MaximumSets = 8;
  const std::size_t before = rays.size();
  int sets = 0;
  do
  {
    addSet(id, patch, random, work, rays);
    ++sets;
  } while (sets < MaximumSets && rays.size() > before &&
    2 * (rays.size() - before) < static_cast<std::size_t>(strata_.size()));
  return sets * strata_.size();
}
}
