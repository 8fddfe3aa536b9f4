// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorPilot.h"

#include "Random.h"
#include "TexelMap.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace po
{
namespace
{
constexpr std::size_t PilotParticles = 128;

/// Those with the smallest random keys.
std::vector<unsigned> choosePilotParticles(
  const BakeScene& scene, const std::vector<unsigned>& particles)
{
  const auto smallest = [](ProcessGroup::Words keys)
  {
    std::sort(keys.begin(), keys.end());
    keys.resize(std::min(keys.size(), PilotParticles));
    return keys;
  };
  ProcessGroup::Words keys;
  for (const unsigned particle : particles)
  {
    keys.push_back(scene.randomKey(particle));
  }
  const ProcessGroup::Words chosenKeys = smallest(scene.group.gather(smallest(std::move(keys))));
  std::vector<unsigned> chosen;
  std::copy_if(particles.begin(), particles.end(), std::back_inserter(chosen),
    [&](unsigned particle) { return scene.randomKey(particle) <= chosenKeys.back(); });
  return chosen;
}

struct Textures
{
  std::vector<float> values;
  std::vector<float> shares;
};

Textures bakePilot(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, const OcclusionEstimator& estimator, Progress& progress)
{
  Textures textures;
  BakeCounters counters;
  const auto texels = static_cast<std::size_t>(settings.textureResolution) *
    static_cast<std::size_t>(settings.textureResolution);
  estimator.estimate(
    scene, particles, settings, progress,
    [&](const RawTextures& raw)
    {
      const std::size_t count = raw.count * texels;
      textures.values.insert(textures.values.end(), raw.values, raw.values + count);
      textures.shares.insert(textures.shares.end(), raw.outsideShares, raw.outsideShares + count);
    },
    counters);
  return textures;
}

/// RMS difference of two bakes over the visible area, divided by sqrt(2).
double errorOf(const Textures& a, const Textures& b, int resolution, const ProcessGroup& group)
{
  double squares = 0;
  double area = 0;
  const auto columns = static_cast<std::size_t>(resolution);
  for (std::size_t i = 0; i < a.values.size(); ++i)
  {
    const auto row = static_cast<int>(i / columns % columns);
    const double share = 0.5 * (static_cast<double>(a.shares[i]) + b.shares[i]);
    const double weight = texelArea(resolution, row) * share;
    const double difference = static_cast<double>(a.values[i]) - b.values[i];
    squares += weight * difference * difference;
    area += weight;
  }
  squares = group.sum(squares);
  area = group.sum(area);
  return area > 0 ? std::sqrt(squares / area / 2) : 0;
}

/// The error falls as N^-1/2 at worst and about N^-3/4 at best; aim between and look again.
int moreSamples(int samples, double excess)
{
  const double factor = std::max(1.1, std::pow(excess, 1.6));
  const double next = std::ceil(samples * std::min(factor, 16.0));
  return static_cast<int>(std::min<double>(next, BakeSettings::MaximumSamplesPerTexel));
}
}

PilotResult samplesForError(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, const OcclusionEstimator& estimator, double targetError,
  Progress& progress)
{
  const std::vector<unsigned> pilot = choosePilotParticles(scene, particles);
  PilotResult result;
  result.samplesPerTexel = 16;
  for (;;)
  {
    BakeSettings trial = settings;
    trial.samplesPerTexel = result.samplesPerTexel;
    const Textures first = bakePilot(scene, pilot, trial, estimator, progress);
    trial.seed = mixBits(settings.seed + 1);
    const Textures second = bakePilot(scene, pilot, trial, estimator, progress);
    if (progress.aborted())
    {
      return result;
    }
    result.estimatedError = errorOf(first, second, settings.textureResolution, scene.group);
    result.reached = result.estimatedError <= targetError;
    if (result.reached || result.samplesPerTexel == BakeSettings::MaximumSamplesPerTexel)
    {
      return result;
    }
    result.samplesPerTexel =
      moreSamples(result.samplesPerTexel, result.estimatedError / targetError);
  }
}
}
