// SPDX-License-Identifier: BSD-3-Clause
/// Ways to store baked textures, as Markdown on standard output: bytes a particle, what storing
/// changes, the time of a lookup, and of a frame against the one with plain 8-bit textures.
///
///   BenchmarkStorage [COUNT] [FAMILY | FILE.vtp ...]
///
/// COUNT particles [200,000] of each synthetic family that is named [all five], and the files,
/// baked by Sweep with the filter's defaults.

#include "BenchmarkScenes.h"
#include "StorageCandidates.h"

#include "EmbreeEstimator.h"
#include "OcclusionBaker.h"
#include "Random.h"
#include "SphereRenderer.h"
#include "SweepEstimator.h"
#include "TexelMap.h"
#include "TextureRecorder.h"
#include "TextureSizes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace po;

constexpr std::size_t DefaultCount = 200000;
constexpr std::size_t Judged = 256;
constexpr int JudgeDirections = 4096; // RMS error below 0.01, and independent of the bake's
constexpr std::uint64_t JudgeSeed = 77;

/// A bake in full and nearly true values for some particles of it.
struct Scene
{
  std::string name;
  SphereCloud cloud;
  Baked baked;
  std::vector<unsigned> judged; ///< particles that light reaches
  std::vector<float> truth, shares;
  double noise = 0; ///< RMS error of the bake
};

/// RMS error of textures of the judged particles, weighted by what of each texel is visible.
double errorOf(const Scene& scene, const Candidate& candidate)
{
  const std::vector<float> areas = texelShares(scene.baked.resolution);
  std::vector<float> texture(areas.size());
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < scene.judged.size(); ++i)
  {
    candidate.decode(scene.judged[i], texture.data());
    for (std::size_t texel = 0; texel < texture.size(); ++texel)
    {
      const std::size_t k = i * texture.size() + texel;
      const double weight = static_cast<double>(areas[texel] * scene.shares[k]);
      const double difference = static_cast<double>(texture[texel] - scene.truth[k]);
      sum += weight * difference * difference;
      area += weight;
    }
  }
  return std::sqrt(sum / area);
}

Baked bake(const BakeScene& scene)
{
  BakeSettings settings;
  settings.encoding = Encoding::Float32Linear;
  const SweepEstimator sweep;
  const std::size_t texels = texelShares(settings.textureResolution).size();
  std::vector<float> shares;
  const TextureRecorder recorder(sweep, {}, texels,
    [&](const RawTextures& raw)
    { shares.insert(shares.end(), raw.outsideShares, raw.outsideShares + raw.count * texels); });
  Progress progress;
  BakeResult result = bakeOcclusion(scene, settings, recorder, progress);
  Baked baked;
  baked.resolution = settings.textureResolution;
  baked.table = TextureTable(baked.resolution, 0);
  TexelWeights weights(baked.resolution);
  for (std::size_t i = 0; i < result.rowOf.size(); ++i)
  {
    const float* texture =
      result.table.floats.data() + static_cast<std::size_t>(result.rowOf[i]) * texels;
    const bool weigh = !hasOneValue(texture, texels);
    baked.rowOf.push_back(
      baked.table.insert({ texture, weigh ? weights.of(&shares[i * texels]) : nullptr }));
  }
  baked.mean = std::move(result.mean);
  baked.maximum = result.table.maximum;
  baked.noise = po::SureShareOfError * sweep.report().estimatedError;
  return baked;
}

void judge(Scene& scene, const BakeScene& spheres)
{
  std::vector<unsigned> lit;
  for (unsigned i = 0; i < scene.baked.mean.size(); ++i)
  {
    if (scene.baked.mean[i] > 0)
    {
      lit.push_back(i);
    }
  }
  for (const unsigned i : drawParticles(lit.size(), Judged))
  {
    scene.judged.push_back(lit[i]);
  }
  std::sort(scene.judged.begin(), scene.judged.end());
  BakeSettings settings;
  settings.seed = JudgeSeed;
  EmbreeOptions options;
  options.directions = JudgeDirections;
  Progress progress;
  BakeCounters counters;
  const auto keep = [&](const RawTextures& raw)
  {
    const std::size_t size = raw.count * scene.baked.table.texelsPerRow();
    scene.truth.insert(scene.truth.end(), raw.values, raw.values + size);
    scene.shares.insert(scene.shares.end(), raw.outsideShares, raw.outsideShares + size);
  };
  EmbreeEstimator(options).estimate(spheres, scene.judged, settings, progress, keep, counters);
}

Scene makeScene(const std::string& name, std::size_t count)
{
  const std::size_t slash = name.find_last_of('/');
  Scene scene;
  scene.name = slash == std::string::npos ? name : name.substr(slash + 1);
  scene.cloud = makeBenchmarkScene(name, count);
  const BakeScene spheres(scene.cloud);
  scene.baked = bake(spheres);
  judge(scene, spheres);
  scene.noise = errorOf(scene, uncompressed(scene.baked));
  return scene;
}

/// Nanoseconds of a lookup: particles at random, each in some pixels side by side.
class LookupClock
{
public:
  explicit LookupClock(const Baked& baked)
  {
    constexpr std::size_t Particles = 1 << 14;
    Random random(1, 0, 0);
    for (std::size_t i = 0; i < Particles; ++i)
    {
      const auto particle =
        static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(baked.rowOf.size())));
      const Vec3d middle = textureDirection({ random.uniform(), random.uniform() });
      for (std::size_t pixel = 0; pixel < PixelsPerParticle; ++pixel)
      {
        particles_.push_back(particle);
        directions_.push_back((middle + Vec3d{ 0.05 * double(pixel), 0, 0 }).as<float>());
      }
    }
    values_.resize(particles_.size());
  }

  /// The fastest of some rounds.
  double nanoseconds(const OcclusionTextures& textures)
  {
    constexpr int Rounds = 7;
    double best = 1e300;
    for (int round = 0; round < Rounds; ++round)
    {
      const std::clock_t start = std::clock();
      for (std::size_t i = 0; i < values_.size(); i += OcclusionLookup::Size)
      {
        OcclusionLookup lookup;
        for (std::size_t lane = 0; lane < OcclusionLookup::Size; ++lane)
        {
          lookup.particles[lane] = particles_[i + lane];
          lookup.texels.x[lane] = directions_[i + lane].x;
          lookup.texels.y[lane] = directions_[i + lane].y;
          lookup.texels.z[lane] = directions_[i + lane].z;
        }
        textures.locate(lookup);
        textures.finish(lookup, &values_[i]);
      }
      best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return 1e9 * best / static_cast<double>(values_.size());
  }

private:
  static constexpr std::size_t PixelsPerParticle = 8;
  std::vector<std::int64_t> particles_;
  std::vector<Vec3f> directions_;
  std::vector<float> values_;
};

/// CPU seconds of a frame of the whole set: traced anew, and shaded by direct light and occlusion.
class FrameClock
{
public:
  explicit FrameClock(const SphereCloud& cloud)
  {
    constexpr int Side = 800;
    constexpr double Focal = 2;
    double extent = 0;
    for (const Sphere& sphere : cloud.spheres)
    {
      extent = std::max(extent, length(cloud.scale * sphere.center().as<double>()));
    }
    const Vec3d o = cloud.origin;
    const double distance = 2.5 * extent, near = 0.1 * extent, far = 5 * extent;
    camera_.worldToEye = { 1, 0, 0, -o.x, 0, 1, 0, -o.y, 0, 0, 1, -o.z - distance, 0, 0, 0, 1 };
    camera_.eyeToClip = { Focal, 0, 0, 0, 0, Focal, 0, 0, 0, 0, -(far + near) / (far - near),
      -2 * far * near / (far - near), 0, 0, -1, 0 };
    camera_.width = camera_.height = Side;
    step_ = 1e-6 * extent;
    renderer_.setCloud(cloud);
  }

  double seconds(const OcclusionTextures& textures)
  {
    Style style;
    style.textures = textures;
    style.lights = { Light() };
    camera_.worldToEye[3] += step_; // a new view each time: nothing is kept
    const std::clock_t start = std::clock();
    static_cast<void>(renderer_.trace(camera_, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }));
    renderer_.shade(style);
    return double(std::clock() - start) / CLOCKS_PER_SEC;
  }

private:
  Camera camera_;
  double step_ = 0;
  SphereRenderer renderer_;
};

/// The candidates' frames take turns; of each the fastest counts. Relative to the first.
std::vector<double> frameRatios(FrameClock& clock, const std::vector<Candidate>& candidates)
{
  constexpr int Rounds = 15;
  std::vector<double> best(candidates.size(), 1e300);
  for (int round = 0; round < Rounds; ++round)
  {
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      if (candidates[i].timeFrames)
      {
        best[i] = std::min(best[i], clock.seconds(*candidates[i].textures));
      }
    }
  }
  for (std::size_t i = candidates.size(); i-- > 0;)
  {
    best[i] /= best[0];
  }
  return best;
}

void print(const Scene& scene, Candidates which)
{
  LookupClock clock(scene.baked);
  const std::vector<Candidate> candidates = makeCandidates(scene.baked, which);
  FrameClock frames(scene.cloud);
  const std::vector<double> ratios = frameRatios(frames, candidates);
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const Candidate& candidate = candidates[i];
    const double error = errorOf(scene, candidate);
    std::cout << "| " << scene.name << " | " << candidate.name << " | " << std::fixed
              << std::setprecision(1)
              << candidate.bytes / static_cast<double>(scene.baked.rowOf.size()) << " | "
              << std::setprecision(4) << differenceOf(scene.baked, candidate) << " | "
              << std::showpos << error - scene.noise << std::noshowpos << " | ";
    if (candidate.textures)
    {
      std::cout << std::setprecision(1) << clock.nanoseconds(*candidate.textures);
    }
    std::cout << " | ";
    if (candidate.timeFrames)
    {
      std::cout << std::setprecision(2) << ratios[i];
    }
    std::cout << " |" << std::endl;
  }
  std::cout << "| " << scene.name << " | RMS error of the bake itself " << std::setprecision(4)
            << scene.noise << ", a third of its estimate " << scene.baked.noise << " | | | | | |"
            << std::endl;
}
}

int main(int argc, char** argv)
{
  try
  {
    std::vector<std::string> names(argv + 1, argv + argc);
    const bool brief = !names.empty() && names.front() == "--filter";
    names.erase(names.begin(), names.begin() + (brief ? 1 : 0));
    const std::size_t count =
      names.empty() ? DefaultCount : std::strtoull(names.front().c_str(), nullptr, 10);
    names.erase(names.begin(), names.begin() + (names.empty() ? 0 : 1));
    if (names.empty())
    {
      names = { "pack", "overlap", "gas", "shell", "foam" };
    }
    std::cout
      << "| set | storage | bytes a particle | difference | added error | ns a lookup | frame |\n"
         "| --- | --- | ---: | ---: | ---: | ---: | ---: |\n";
    for (const std::string& name : names)
    {
      print(makeScene(name, count), brief ? Candidates::OfTheFilter : Candidates::All);
    }
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
