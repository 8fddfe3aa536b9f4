// SPDX-License-Identifier: BSD-3-Clause
#include "ThesisEstimator.h"

#include "Random.h"
#include "Sampling.h"
#include "TexelMap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace po
{
namespace
{
constexpr float Unbounded = std::numeric_limits<float>::infinity();

/// Shoots the rays of texels of any particle.
class TexelShooter
{
public:
  TexelShooter(const BakeScene& scene, const BakeSettings& settings)
    : scene_(scene)
    , settings_(settings)
    , strata_(settings.samplesPerTexel)
    , pairing_(static_cast<std::size_t>(strata_.size()))
  {
  }

  /// The mean background over the rays of a texel.
  [[nodiscard]] float shoot(unsigned id, int row, int column)
  {
    const int resolution = settings_.textureResolution;
    const Sphere sphere = scene_.set().inBrick(id);
    const TexelPatch patch(resolution, row, column);
    Random random(settings_.seed, scene_.randomKey(id), texelIndex(resolution, row, column));
    randomPermutation(random, pairing_);
    double light = 0;
    for (int k = 0; k < strata_.size(); ++k)
    {
      const Point2 place = strata_.point(k, random.uniform(), random.uniform());
      const Point2 heading = strata_.point(static_cast<int>(pairing_[static_cast<std::size_t>(k)]),
        random.uniform(), random.uniform());
      const Vec3d normal = patch.point(place.x, place.y);
      const Vec3d direction = aboutNormal(normal, cosineHemisphereFromSquare(heading));
      const Vec3f origin = sphere.center() + sphere.radius * normal.as<float>();
      const bool stopped = scene_.rays().occluded(origin, direction.as<float>(), Unbounded, id);
      light += stopped ? 0 : luminance(settings_.background, direction);
    }
    return static_cast<float>(light / strata_.size());
  }

private:
  const BakeScene& scene_;
  const BakeSettings& settings_;
  StratifiedSquare strata_;
  std::vector<std::uint32_t> pairing_; ///< stratum of the direction for each of the texel
};
}

void ThesisEstimator::estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  constexpr std::size_t chunk = 64;
  scene.prepareRays();
  const auto side = static_cast<std::size_t>(settings.textureResolution);
  const std::vector<float> shares(chunk * side * side, 1.0f);
  std::vector<float> values(shares.size());
  progress.begin(particles.size(), "Rays of all texels");
  for (std::size_t first = 0; first < particles.size() && !progress.aborted(); first += chunk)
  {
    const std::size_t count = std::min(chunk, particles.size() - first);
    tbb::parallel_for(std::size_t(0), count,
      [&](std::size_t i)
      {
        TexelShooter shooter(scene, settings);
        for (std::size_t texel = 0; texel < side * side; ++texel)
        {
          values[i * side * side + texel] = shooter.shoot(
            particles[first + i], static_cast<int>(texel / side), static_cast<int>(texel % side));
        }
        progress.advance(1);
      });
    sink({ first, count, values.data(), shares.data() });
  }
  counters.particles += particles.size();
  counters.rays += particles.size() * side * side *
    static_cast<std::uint64_t>(StratifiedSquare(settings.samplesPerTexel).size());
}
}
