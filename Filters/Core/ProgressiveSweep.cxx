// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressiveSweep.h"

#include "HeapMemory.h"
#include "Random.h"
#include "SweepDirections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace po
{
namespace
{
constexpr std::size_t WatchedParticles = 256;
constexpr float Unbounded = std::numeric_limits<float>::infinity();

/// Up to 256 of the particles, drawn by the seed.
void drawWatched(std::vector<unsigned>& particles, std::uint64_t seed)
{
  const std::size_t count = std::min(particles.size(), WatchedParticles);
  Random random(seed, particles.size(), 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto left = static_cast<std::uint32_t>(particles.size() - i);
    std::swap(particles[i], particles[i + random.below(left)]);
  }
  particles.resize(count);
  particles.shrink_to_fit();
}

/// Watched particles by their index in the order.
std::vector<unsigned> watchedSpheres(const SweepScene& order, std::vector<unsigned> particles,
  std::uint64_t seed, ProgressiveSweep::Watch watch)
{
  if (watch == ProgressiveSweep::Watch::Some)
  {
    drawWatched(particles, seed);
  }
  return order.indicesOf(std::move(particles));
}

LoggedVisibility::Watch watchOfLog(ProgressiveSweep::Watch watch)
{
  return watch == ProgressiveSweep::Watch::All ? LoggedVisibility::Watch::All
                                               : LoggedVisibility::Watch::Some;
}

/// Textures of places of the list that follow each other. Those of spheres that were never seen are
/// all the same: where the place before held one it stays.
class TextureChunk
{
public:
  TextureChunk(const SweepTextures& made, std::size_t texels)
    : made_(made)
    , texels_(texels)
  {
  }

  void resize(std::size_t count)
  {
    values_.resize(count * texels_);
    shares_.resize(count * texels_);
    isDark_.resize(count, 0);
  }

  void fill(std::size_t i, unsigned sphere)
  {
    const bool dark = made_.isDark(sphere);
    if (!dark || isDark_[i] == 0)
    {
      made_.fill(sphere, values_.data() + i * texels_, shares_.data() + i * texels_);
    }
    isDark_[i] = dark ? 1 : 0;
  }

  /// @param first place of the list
  void replace(const TextureReplacements& by, std::size_t first)
  {
    const auto begin = std::lower_bound(by.places.begin(), by.places.end(), first);
    for (auto place = begin; place != by.places.end() && *place < first + isDark_.size(); ++place)
    {
      const std::size_t from = static_cast<std::size_t>(place - by.places.begin()) * texels_;
      const std::size_t to = *place - first;
      std::copy_n(by.values.data() + from, texels_, values_.data() + to * texels_);
      std::copy_n(by.shares.data() + from, texels_, shares_.data() + to * texels_);
      isDark_[to] = 0;
    }
  }

  /// Texels without any part outside others.
  [[nodiscard]] std::uint64_t inside() const
  {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < isDark_.size(); ++i)
    {
      const float* shares = shares_.data() + i * texels_;
      count += isDark_[i] != 0
        ? 0
        : static_cast<std::uint64_t>(std::count(shares, shares + texels_, 0.0f));
    }
    return count;
  }

  /// @param first place of the list
  [[nodiscard]] RawTextures raw(std::size_t first) const
  {
    return { first, isDark_.size(), values_.data(), shares_.data() };
  }

private:
  const SweepTextures& made_;
  std::size_t texels_; ///< T * T
  std::vector<float> values_;
  std::vector<float> shares_;
  std::vector<std::uint8_t> isDark_; ///< flags
};

/// Flags, by index in the order, of the spheres outside the distance of any other. Where rounding
/// might matter a sphere is not alone.
std::vector<std::uint8_t> aloneFlags(
  const BakeScene& scene, const SweepScene& order, float distance)
{
  std::vector<std::uint8_t> flags(order.size(), 0);
  if (!std::isfinite(distance))
  {
    return flags;
  }
  float largest = 0;
  for (const SweepScene::Band& band : order.bands())
  {
    largest = std::max(largest, band.largestRadius);
  }
  const float reach = distance + 1e-5f * (distance + largest);
  tbb::parallel_for(std::size_t(0), flags.size(),
    [&](std::size_t i)
    { flags[i] = scene.overlaps.hasNear(order.source(static_cast<unsigned>(i)), reach) ? 0 : 1; });
  return flags;
}
}

ProgressiveSweep::ProgressiveSweep(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, const Options& options)
  : settings_(settings)
  , particles_(particles)
  , order_(scene.set())
  , texels_(settings.textureResolution)
  , watch_(options.watch)
  , watched_(watchedSpheres(order_, particles_, settings.seed, options.watch))
  , alone_(aloneFlags(scene, order_,
      options.skips.lonely ? scene.cloud.toLocalReach(settings.maximumDistance) : Unbounded))
  , records_(scene, order_, texels_, settings.seed, order_.flagsOf(particles_), alone_, watched_,
      options.records == Records::OutOfCore
        ? std::make_unique<LoggedVisibility>(texels_, order_.indicesOf(particles_), order_.size(),
            watchOfLog(options.watch), watched_)
        : nullptr)
  , sweep_(order_, settings.background, scene.cloud.toLocalReach(settings.maximumDistance),
      records_, options.skips, alone_, scene.group)
  , smooth_(options.smooth)
{
  alone_ = std::vector<std::uint8_t>(); // the others know
}

void ProgressiveSweep::refine(int directions, Progress& progress, Spread spread)
{
  const std::size_t sets = spread == Spread::Evenly ? 1 : ErrorSubsets;
  const int perSet = 2 * static_cast<int>(sets);
  const int axes = (directions + perSet - 1) / perSet;
  const std::uint64_t swept = 2 * sets * static_cast<std::uint64_t>(axes);
  progress.begin(swept * order_.size(), "Sweep along " + std::to_string(swept) + " directions");
  for (std::size_t set = 0; set < sets && !progress.aborted(); ++set)
  {
    const std::uint64_t seed = rounds_ == 0 ? settings_.seed : mixBits(settings_.seed + rounds_);
    const auto subset = sets > 1 ? std::optional<std::size_t>(set) : std::nullopt;
    sweep_.run(sweepAxes(axes, seed), progress, subset);
    ++rounds_;
  }
}

void ProgressiveSweep::end()
{
  sweep_.end();
  records_.end(
    order_.indicesOf(particles_), watch_ == Watch::Some ? watched_ : std::vector<unsigned>());
  returnFreeMemory();
}

int ProgressiveSweep::directions() const
{
  return sweep_.directions() - sweep_.blackDirections();
}

/// What there is so far.
SweepTextures ProgressiveSweep::textures() const
{
  return { records_, settings_.background,
    smooth_ ? TextureSmoothing(texels_, sweep_.directions()) : TextureSmoothing() };
}

std::vector<SquaredError> ProgressiveSweep::squaredErrors() const
{
  const SweepTextures made = textures();
  std::vector<SquaredError> errors(watched_.size());
  std::size_t count = 0;
  for (std::size_t first = 0; first < errors.size(); first += count)
  {
    // Those of some are known whatever part is loaded.
    const std::size_t known = watch_ == Watch::All ? records_.loadFor(first) : errors.size();
    count = std::min(known, errors.size() - first);
    tbb::parallel_for(
      first, first + count, [&](std::size_t i) { errors[i] = made.squaredError(watched_[i]); });
  }
  return errors;
}

double ProgressiveSweep::estimatedError() const
{
  SquaredError all;
  for (const SquaredError& error : squaredErrors())
  {
    all.add(error);
  }
  return all.rms();
}

void ProgressiveSweep::handOut(const OcclusionEstimator::Sink& sink, Progress& progress,
  BakeCounters& counters, const TextureReplacements& replacements) const
{
  constexpr std::size_t valuesPerChunk = std::size_t(1) << 19; // 4 MiB with the shares
  const auto side = static_cast<std::size_t>(settings_.textureResolution);
  const std::size_t texels = side * side;
  const std::size_t chunk = std::max<std::size_t>(1, valuesPerChunk / texels);
  const SweepTextures made = textures();
  TextureChunk textures(made, texels);
  progress.begin(
    particles_.size(), "Textures of " + std::to_string(particles_.size()) + " particles");
  std::size_t count = 0;
  for (std::size_t first = 0; first < particles_.size() && !progress.aborted(); first += count)
  {
    count = std::min({ chunk, particles_.size() - first, records_.loadFor(first) });
    textures.resize(count);
    tbb::parallel_for(std::size_t(0), count,
      [&](std::size_t i)
      {
        const auto sphereAt = [&](std::size_t k)
        { return order_.indexOf(particles_[first + std::min(k, count - 1)]); };
        records_.prefetch(sphereAt(i + 8));
        records_.prefetchResult(sphereAt(i + 3));
        textures.fill(i, sphereAt(i));
      });
    textures.replace(replacements, first);
    counters.texelsInside += textures.inside();
    sink(textures.raw(first));
    progress.advance(count);
  }
  const SweepCounters swept = sweep_.counters();
  counters.particles += particles_.size();
  counters.texels += particles_.size() * texels;
  counters.particlesBuried += records_.buried();
  counters.particlesAlone += records_.alone();
  counters.spheresClosed += swept.closed;
  counters.spheresNeverSeen += sweep_.neverSeen();
  counters.directionsBlack += static_cast<std::uint64_t>(sweep_.blackDirections());
  counters.threads = std::max(counters.threads, sweep_.threads());
}
}
