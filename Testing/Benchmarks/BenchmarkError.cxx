// SPDX-License-Identifier: BSD-3-Clause
/// One measurement a process, so that the peak of memory is its own: time, memory and error of one
/// method at one level of quality. run_error_benchmark.py calls it and gathers what it prints.
///
///   BenchmarkError measure --scene NAME --method NAME --level N [--count N] [--resolution T]
///     [--background NAME] [--distance N] [--judge FILE] [--measured N] [--threads N] [--target
///     NAME] [--bake 1]
///     [--without SKIP] [--values FILE] [--compare FILE]
///   BenchmarkError judge --scene NAME --output FILE [--count N] [--resolution T] [--samples N]
///     [--background NAME] [--distance N] [--judged N]
///   BenchmarkError targets
///
/// `measure` prints one line of JSON. A method whose time grows with the particles that are asked
/// for is measured on --measured of them, and its time scaled to all. --bake goes on to the table
/// of stored textures, for methods that do all particles; --target allows only one set of vector
/// instructions; --without switches off one of the SweepSkips, or smoothing; --values writes all
/// values as raw floats, and --compare tells the RMS difference from such a file. `judge` writes
/// the independent values by which errors are found. `targets` lists sets of vector instructions.
/// The scenes and backgrounds are told in BenchmarkScenes.h.

#include "BenchmarkJudge.h"
#include "BenchmarkScenes.h"
#include "ErrorOptions.h"
#include "MeasuredMethod.h"
#include "OcclusionBaker.h"
#include "ProcessCost.h"
#include "ReferenceEstimator.h"
#include "TextureRecorder.h"

#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{
constexpr std::uint64_t MeasuredSeed = 1;
constexpr std::uint64_t JudgeSeeds[2] = { 7701, 7702 };

// ---- targets

void allowOnlyTarget(const std::string& name)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    if (name == hwy::TargetName(target))
    {
      hwy::SetSupportedTargetsForTest(target);
      return;
    }
  }
  throw std::runtime_error("There is no target '" + name + "' here; see BenchmarkError targets");
}

void printTargets()
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    std::cout << hwy::TargetName(target) << '\n';
  }
}

// ---- judge

po::JudgedTexels judgeHalf(
  const po::BakeScene& scene, const po::Judge& judge, po::BakeSettings settings, std::uint64_t seed)
{
  settings.samplesPerTexel = judge.samples / 2;
  settings.seed = seed;
  std::vector<std::size_t> positions(judge.particles.size());
  std::iota(positions.begin(), positions.end(), std::size_t(0));
  const po::ReferenceEstimator reference;
  const po::TextureRecorder recorder(reference, positions, po::texelCount(judge.resolution));
  po::Progress progress;
  po::BakeCounters counters;
  recorder.estimate(
    scene, judge.particles, settings, progress, [](const po::RawTextures&) {}, counters);
  return recorder.kept();
}

void makeJudge(const po::ErrorOptions& options)
{
  const std::string output = options.required("output");
  const po::SphereCloud cloud =
    po::makeBenchmarkScene(options.required("scene"), po::sphereCount(options));
  const po::BakeScene scene(cloud);
  po::Judge judge;
  judge.scene = po::shortName(options);
  judge.spheres = cloud.spheres.size();
  judge.checksum = po::checksum(cloud);
  judge.resolution = po::resolutionOf(options);
  judge.samples = options.number("samples", 16200);
  std::copy_n(JudgeSeeds, 2, judge.seeds);
  judge.particles =
    po::drawParticles(cloud.spheres.size(), static_cast<std::size_t>(options.number("judged", 32)));
  if (judge.particles.empty() || judge.samples < 2)
  {
    throw std::runtime_error("There must be a particle to judge, and two samples a texel");
  }
  const po::BakeSettings settings = po::settingsOf(options, cloud.scale);
  po::mergeHalves(judgeHalf(scene, judge, settings, judge.seeds[0]),
    judgeHalf(scene, judge, settings, judge.seeds[1]), judge);
  po::writeJudge(judge, output);
  std::printf("{\"scene\": \"%s\", \"particles\": %zu, \"samples\": %d, \"noise\": %.6g}\n",
    judge.scene.c_str(), judge.spheres, judge.samples, judge.noise);
}

// ---- measure

/// The particles to estimate, and where among them those are that are judged.
struct Selection
{
  std::vector<unsigned> list;
  std::vector<std::size_t> judged;
};

Selection selectAll(std::size_t particles, const std::vector<unsigned>& judged)
{
  Selection selection;
  selection.list.resize(particles);
  std::iota(selection.list.begin(), selection.list.end(), 0u);
  selection.judged.assign(judged.begin(), judged.end());
  return selection;
}

/// Those to judge, then others up to the number that is measured.
Selection selectSome(
  std::size_t particles, const std::vector<unsigned>& judged, std::size_t measured)
{
  Selection selection;
  selection.list = judged;
  selection.judged.resize(judged.size());
  std::iota(selection.judged.begin(), selection.judged.end(), std::size_t(0));
  for (const unsigned particle : po::drawParticles(particles, measured))
  {
    const bool known = std::find(judged.begin(), judged.end(), particle) != judged.end();
    if (!known && selection.list.size() < measured)
    {
      selection.list.push_back(particle);
    }
  }
  return selection;
}

po::Judge judgeFor(const po::ErrorOptions& options, const po::SphereCloud& cloud, int resolution)
{
  const std::string file = options.text("judge");
  if (file.empty())
  {
    return {};
  }
  po::Judge judge = po::readJudge(file);
  if (judge.checksum != po::checksum(cloud) || judge.spheres != cloud.spheres.size() ||
    judge.resolution != resolution || judge.scene != po::shortName(options))
  {
    throw std::runtime_error(
      file + " was made from other spheres, for other textures or under another background");
  }
  return judge;
}

struct Measurement
{
  std::string scene;
  std::string method;
  int level = 0;
  int resolution = 0;
  std::size_t particles = 0;
  std::size_t measured = 0; ///< particles whose time was taken
  po::Seconds sceneSeconds; ///< what comes before any estimate: Embree's hierarchies
  po::Seconds seconds;      ///< scaled to all particles
  double sceneMegabytes = 0;
  double peakMegabytes = 0;
};

void printMeasurement(const Measurement& m)
{
  std::printf("{\"scene\": \"%s\", \"method\": \"%s\", \"level\": %d, \"resolution\": %d, "
              "\"particles\": %zu, \"measured_particles\": %zu, \"cpu_s\": %.6g, \"wall_s\": %.6g, "
              "\"scene_cpu_s\": %.6g, \"scene_wall_s\": %.6g, \"peak_MB\": %.6g, "
              "\"scene_MB\": %.6g",
    m.scene.c_str(), m.method.c_str(), m.level, m.resolution, m.particles, m.measured,
    m.seconds.cpu, m.seconds.wall, m.sceneSeconds.cpu, m.sceneSeconds.wall, m.peakMegabytes,
    m.sceneMegabytes);
}

void printError(const po::VisibilityError& error, const po::Judge& judge)
{
  std::printf(", \"rmse\": %.6g, \"bias\": %.6g, \"p99\": %.6g, \"judge_noise\": %.6g, "
              "\"judged_particles\": %zu",
    error.rms, error.bias, error.percentile99, judge.noise, judge.particles.size());
}

void printCounters(const po::BakeCounters& counters, bool baked)
{
  const std::pair<const char*, std::uint64_t> spared[] = {
    { "spheresClosed", counters.spheresClosed },
    { "spheresNeverSeen", counters.spheresNeverSeen },
    { "directionsBlack", counters.directionsBlack },
    { "texelsInside", counters.texelsInside },
    { "particlesBuried", counters.particlesBuried },
    { "particlesAlone", counters.particlesAlone },
  };
  for (const auto& [name, count] : spared)
  {
    std::printf(", \"%s\": %llu", name, static_cast<unsigned long long>(count));
  }
  if (baked) // else there is no table
  {
    std::printf(
      ", \"texturesStored\": %llu", static_cast<unsigned long long>(counters.texturesStored));
  }
}

/// Estimates the list, or bakes all.
po::BakeCounters run(const po::TextureRecorder& recorder, const po::BakeScene& scene,
  const std::vector<unsigned>& list, const po::BakeSettings& settings, bool bake)
{
  po::Progress progress;
  po::BakeCounters counters;
  if (bake)
  {
    return po::bakeOcclusion(scene, settings, recorder, progress).counters;
  }
  recorder.estimate(
    scene, list, settings, progress, [](const po::RawTextures&) {}, counters);
  return counters;
}

/// Writes the values as raw floats, if that is asked for.
po::TextureObserver valueWriter(const po::ErrorOptions& options)
{
  const std::string name = options.text("values");
  if (name.empty())
  {
    return {};
  }
  const auto file = std::make_shared<std::ofstream>(name, std::ios::binary);
  if (!*file)
  {
    throw std::runtime_error("Cannot write " + name);
  }
  return [file, texels = po::texelCount(po::resolutionOf(options))](const po::RawTextures& raw)
  {
    file->write(reinterpret_cast<const char*>(raw.values),
      static_cast<std::streamsize>(raw.count * texels * sizeof(float)));
  };
}

std::unique_ptr<po::TextureComparison> makeComparison(const po::ErrorOptions& options)
{
  const std::string file = options.text("compare");
  return file.empty() ? nullptr
                      : std::make_unique<po::TextureComparison>(file, po::resolutionOf(options));
}

po::TextureObserver joined(po::TextureObserver writer, po::TextureComparison* comparison)
{
  if (!comparison)
  {
    return writer;
  }
  return [writer = std::move(writer), comparison](const po::RawTextures& raw)
  {
    comparison->add(raw);
    if (writer)
    {
      writer(raw);
    }
  };
}

/// What the command line says of a measurement.
Measurement describe(const po::ErrorOptions& options)
{
  Measurement result;
  result.scene = po::shortName(options);
  result.method = options.required("method");
  result.level = options.number("level", 0);
  result.resolution = po::resolutionOf(options);
  if (result.level < 1)
  {
    throw std::runtime_error("--level must be at least 1");
  }
  return result;
}

/// Threads are limited as long as the result lives.
std::unique_ptr<tbb::global_control> limitThreads(int count)
{
  if (count == 0)
  {
    return nullptr;
  }
  return std::make_unique<tbb::global_control>(
    tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
}

Selection select(const po::ErrorOptions& options, const po::MeasuredMethod& method,
  std::size_t particles, const std::vector<unsigned>& judged)
{
  const auto measured = static_cast<std::size_t>(options.number("measured", 512));
  Selection selection =
    method.allAtOnce ? selectAll(particles, judged) : selectSome(particles, judged, measured);
  if (selection.list.empty())
  {
    throw std::runtime_error("There are no particles to measure");
  }
  return selection;
}

void measure(const po::ErrorOptions& options)
{
  Measurement result = describe(options);
  const po::MeasuredMethod method =
    po::makeMethod(result.method, result.level, options.text("without"));
  if (!options.text("target").empty())
  {
    allowOnlyTarget(options.text("target"));
  }
  const auto threads = limitThreads(options.number("threads", 0));

  const po::SphereCloud cloud =
    po::makeBenchmarkScene(options.required("scene"), po::sphereCount(options));
  const po::Stopwatch sceneWatch;
  const po::BakeScene scene(cloud);
  result.sceneSeconds = sceneWatch.elapsed();
  result.sceneMegabytes = po::statusMegabytes("VmRSS");
  result.particles = cloud.spheres.size();

  const po::Judge judge = judgeFor(options, cloud, result.resolution);
  const Selection selection = select(options, method, result.particles, judge.particles);
  result.measured = selection.list.size();
  po::BakeSettings settings = po::settingsOf(options, cloud.scale);
  settings.samplesPerTexel = method.samplesPerTexel;
  settings.seed = MeasuredSeed;
  const std::unique_ptr<po::TextureComparison> comparison = makeComparison(options);
  const po::TextureRecorder recorder(*method.estimator, selection.judged,
    po::texelCount(result.resolution), joined(valueWriter(options), comparison.get()));
  const bool bake = method.allAtOnce && options.number("bake", 0) > 0;

  const po::Stopwatch watch;
  const po::BakeCounters counters = run(recorder, scene, selection.list, settings, bake);
  const po::Seconds seconds = watch.elapsed();
  const double scale = static_cast<double>(result.particles) / static_cast<double>(result.measured);
  result.seconds = { scale * seconds.cpu, scale * seconds.wall };
  result.peakMegabytes = po::statusMegabytes("VmHWM");

  printMeasurement(result);
  printCounters(counters, bake);
  if (comparison)
  {
    std::printf(", \"rms_difference\": %.6g", comparison->rms());
  }
  if (!judge.particles.empty())
  {
    printError(po::errorOf(recorder.kept(), judge), judge);
  }
  std::printf("}\n");
}

void runCommand(int argc, char* argv[])
{
  const std::string command = argc > 1 ? argv[1] : "";
  const po::ErrorOptions options(argc, argv, 2);
  if (command == "measure")
  {
    measure(options);
  }
  else if (command == "judge")
  {
    makeJudge(options);
  }
  else if (command == "targets")
  {
    printTargets();
  }
  else
  {
    throw std::runtime_error("Usage: BenchmarkError measure|judge|targets [--option value]...");
  }
}
}

int main(int argc, char* argv[])
{
  try
  {
    runCommand(argc, argv);
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << argv[0] << ": there is not enough memory.\n";
    return EXIT_FAILURE;
  }
  catch (const std::exception& problem)
  {
    std::cerr << argv[0] << ": " << problem.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
