// SPDX-License-Identifier: BSD-3-Clause
/// CPU seconds of the sweep, or of the method Embree, at the error that 49 jittered rays a texel
/// leave (method Reference).
///
/// Usage: BenchmarkSweep [--method sweep|embree] [--count N] [--judged N] [--distance D] [--samples
/// N] [scene]...
///
/// Scenes, families and .vtp files among them, are told in BenchmarkScenes.h. Errors are taken
/// over a few particles against Reference with many more rays and another seed: area-weighted RMS
/// of linear visibility over the outside part of the texels. The Reference's time, and that of the
/// thesis' way, which traces samples inside others too (ThesisEstimator.h), are measured on the
/// same particles and scaled to all, as is that of Embree, on up to 2,000 particles. Seconds are
/// those of the process: all threads together.

#include "BenchmarkScenes.h"
#include "EmbreeEstimator.h"
#include "OcclusionBaker.h"
#include "Random.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "TexelMap.h"
#include "ThesisEstimator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <numeric>
#include <string>
#include <vector>

namespace
{
struct Options
{
  std::size_t count = 100000;
  std::size_t judged = 48;
  double distance = 0; ///< in mean radii
  int samples = 49;
  bool embree = false; ///< in place of the sweep
  std::vector<std::string> scenes;
};

struct Textures
{
  std::vector<float> values;
  std::vector<float> shares;
  double seconds = 0;
};

struct Error
{
  double rms = 0;
  double bias = 0;
};

double cpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Estimates the particles and keeps those of `kept` (indices into them).
Textures estimate(const po::OcclusionEstimator& estimator, const po::BakeScene& scene,
  const std::vector<unsigned>& particles, const std::vector<unsigned>& kept,
  const po::BakeSettings& settings)
{
  const auto texels =
    static_cast<std::size_t>(settings.textureResolution * settings.textureResolution);
  Textures result;
  po::Progress progress;
  po::BakeCounters counters;
  const double start = cpuSeconds();
  std::size_t next = 0;
  estimator.estimate(
    scene, particles, settings, progress,
    [&](const po::RawTextures& raw)
    {
      for (; next < kept.size() && kept[next] < raw.firstParticle + raw.count; ++next)
      {
        const std::size_t offset = (kept[next] - raw.firstParticle) * texels;
        result.values.insert(
          result.values.end(), raw.values + offset, raw.values + offset + texels);
        result.shares.insert(
          result.shares.end(), raw.outsideShares + offset, raw.outsideShares + offset + texels);
      }
    },
    counters);
  result.seconds = cpuSeconds() - start;
  return result;
}

Error errorOf(const Textures& found, const Textures& judge, int resolution)
{
  Error error;
  double area = 0;
  const auto side = static_cast<std::size_t>(resolution);
  for (std::size_t i = 0; i < judge.values.size(); ++i)
  {
    const double weight = po::texelArea(resolution, static_cast<int>(i / side % side)) *
      static_cast<double>(judge.shares[i]);
    const double difference = static_cast<double>(found.values[i]) - judge.values[i];
    error.rms += weight * difference * difference;
    error.bias += weight * difference;
    area += weight;
  }
  return { std::sqrt(error.rms / area), error.bias / area };
}

struct Run
{
  Textures textures; ///< of the judged particles; the time is that of all
  double estimatedError;
};

Run runSweep(int directions, const po::BakeScene& scene, const std::vector<unsigned>& all,
  const std::vector<unsigned>& judged, const po::BakeSettings& settings)
{
  const po::SweepEstimator sweep(po::SweepOptions{ directions, 0 });
  Textures found = estimate(sweep, scene, all, judged, settings);
  return { std::move(found), sweep.report().estimatedError };
}

/// Bakes a part of the particles, the judged ones among them, and scales the time to all.
Run runEmbree(int directions, const po::BakeScene& scene, const std::vector<unsigned>& judged,
  const po::BakeSettings& settings)
{
  constexpr std::size_t most = 2000;
  const std::size_t particles = scene.receivers();
  const std::size_t step = std::max<std::size_t>(particles / most, 1);
  std::vector<unsigned> list;
  std::vector<unsigned> kept; // places in the list
  for (unsigned id = 0; id < particles; ++id)
  {
    const bool isJudged = std::binary_search(judged.begin(), judged.end(), id);
    if (isJudged)
    {
      kept.push_back(static_cast<unsigned>(list.size()));
    }
    if (isJudged || id % step == 0)
    {
      list.push_back(id);
    }
  }
  const po::EmbreeEstimator embree(po::EmbreeOptions{ directions, 0 });
  Textures found = estimate(embree, scene, list, kept, settings);
  found.seconds *= static_cast<double>(particles) / static_cast<double>(list.size());
  return { std::move(found), embree.report().estimatedError };
}

/// Seconds at an error, between two measurements, on a log-log line.
double secondsAt(double error, double error0, double seconds0, double error1, double seconds1)
{
  const double t = std::log(error / error0) / std::log(error1 / error0);
  return seconds0 * std::pow(seconds1 / seconds0, t);
}

void benchmark(const std::string& name, const Options& options)
{
  const po::SphereCloud cloud = po::makeBenchmarkScene(name, options.count);
  const po::BakeScene scene(cloud);
  const std::size_t particles = cloud.spheres.size();
  std::vector<unsigned> all(particles);
  std::iota(all.begin(), all.end(), 0u);
  std::vector<unsigned> judged;
  for (std::size_t i = 0; i < options.judged; ++i)
  {
    judged.push_back(static_cast<unsigned>((static_cast<double>(i) + 0.5) /
      static_cast<double>(options.judged) * static_cast<double>(particles)));
  }
  std::vector<unsigned> positions(judged.size());
  std::iota(positions.begin(), positions.end(), 0u);

  po::BakeSettings settings;
  settings.maximumDistance = options.distance * cloud.scale;
  settings.samplesPerTexel = 48 * options.samples;
  settings.seed = 77;
  const po::ReferenceEstimator reference;
  const Textures judge = estimate(reference, scene, judged, positions, settings);
  settings.samplesPerTexel = options.samples;
  settings.seed = 1;
  const Textures baseline = estimate(reference, scene, judged, positions, settings);
  const Error target = errorOf(baseline, judge, settings.textureResolution);
  const double toAll = static_cast<double>(particles) / static_cast<double>(judged.size());
  const double baselineSeconds = baseline.seconds * toAll;
  const double thesisSeconds =
    estimate(po::ThesisEstimator(), scene, judged, positions, settings).seconds * toAll;
  std::printf("| %s (%zu) | Reference %d | %.1f | %.4f | %+.4f | | 1 |\n", name.c_str(), particles,
    options.samples, baselineSeconds, target.rms, target.bias);
  std::printf("| %s | Thesis %d | %.1f | | | | |\n", name.c_str(), options.samples, thesisSeconds);

  double lastError = 0;
  double lastSeconds = 0;
  for (const int directions : { 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024 })
  {
    const Run run = options.embree ? runEmbree(directions, scene, judged, settings)
                                   : runSweep(directions, scene, all, judged, settings);
    const Textures& found = run.textures;
    const Error error = errorOf(found, judge, settings.textureResolution);
    std::printf("| %s | %s %d | %.2f | %.4f | %+.4f | %.4f | %.1f |\n", name.c_str(),
      options.embree ? "Embree" : "Sweep", directions, found.seconds, error.rms, error.bias,
      run.estimatedError, baselineSeconds / found.seconds);
    if (error.rms < target.rms)
    {
      const double seconds = lastError > 0
        ? secondsAt(target.rms, lastError, lastSeconds, error.rms, found.seconds)
        : found.seconds;
      std::printf("| %s | equal error | %.2f | %.4f | | | **%.1f**, to Thesis %.1f |\n",
        name.c_str(), seconds, target.rms, baselineSeconds / seconds, thesisSeconds / seconds);
      return;
    }
    lastError = error.rms;
    lastSeconds = found.seconds;
    std::fflush(stdout);
  }
}

Options readOptions(int argc, char** argv)
{
  Options options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    const bool hasValue = i + 1 < argc;
    if (word == "--count" && hasValue)
    {
      options.count = std::stoul(argv[++i]);
    }
    else if (word == "--judged" && hasValue)
    {
      options.judged = std::stoul(argv[++i]);
    }
    else if (word == "--distance" && hasValue)
    {
      options.distance = std::stod(argv[++i]);
    }
    else if (word == "--samples" && hasValue)
    {
      options.samples = std::stoi(argv[++i]);
    }
    else if (word == "--method" && hasValue)
    {
      options.embree = std::string(argv[++i]) == "embree";
    }
    else
    {
      options.scenes.push_back(word);
    }
  }
  if (options.scenes.empty())
  {
    options.scenes = { "pack", "overlap", "gas", "shell", "foam" };
  }
  return options;
}
}

int main(int argc, char** argv)
try
{
  const Options options = readOptions(argc, argv);
  std::printf("| scene (spheres) | method | CPU seconds | RMSE | bias | estimated | ratio |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const std::string& scene : options.scenes)
  {
    benchmark(scene, options);
  }
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "BenchmarkSweep: " << error.what() << "\n";
  return 1;
}
