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
/// instructions; --without switches off one of the SweepSkips; --values writes all values as raw
/// floats, and --compare tells the RMS difference from such a file. `judge` writes the independent
/// values by which errors are found. `targets` lists sets of vector instructions. The scenes and
/// backgrounds are told in BenchmarkScenes.h.

#include "BenchmarkJudge.h"
#include "BenchmarkScenes.h"
#include "EmbreeEstimator.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "TexelMap.h"

#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{
constexpr std::uint64_t MeasuredSeed = 1;
constexpr std::uint64_t JudgeSeeds[2] = { 7701, 7702 };

/// "--name value" pairs of the command line.
class Options
{
public:
  Options(int argc, char* argv[], int first)
  {
    for (int i = first; i < argc; i += 2)
    {
      const std::string name = argv[i];
      if (name.compare(0, 2, "--") != 0 || i + 1 == argc)
      {
        throw std::runtime_error("'" + name + "' is no option with a value");
      }
      values_[name.substr(2)] = argv[i + 1];
    }
  }

  [[nodiscard]] std::string text(const std::string& name, const std::string& otherwise = {}) const
  {
    const auto found = values_.find(name);
    return found == values_.end() ? otherwise : found->second;
  }

  [[nodiscard]] std::string required(const std::string& name) const
  {
    const std::string value = text(name);
    if (value.empty())
    {
      throw std::runtime_error("--" + name + " is missing");
    }
    return value;
  }

  /// A whole number from 0 to 2^30.
  [[nodiscard]] int number(const std::string& name, int otherwise) const
  {
    const std::string value = text(name, std::to_string(otherwise));
    const bool digits = !value.empty() && value.size() <= 10 &&
      value.find_first_not_of("0123456789") == std::string::npos;
    if (!digits || std::stoull(value) > 1u << 30)
    {
      throw std::runtime_error("--" + name + " must be a whole number, not '" + value + "'");
    }
    return std::stoi(value);
  }

private:
  std::map<std::string, std::string> values_;
};

/// An estimator at one level of quality.
struct Method
{
  std::unique_ptr<po::OcclusionEstimator> estimator;
  int samplesPerTexel;
  bool allAtOnce; ///< the time does not depend on how many particles are asked for
};

/// All that a sweep may leave out, but for what is named.
po::SweepSkips skipsWithout(const std::string& name)
{
  static const std::map<std::string, bool po::SweepSkips::*> flags{
    { "closedCells", &po::SweepSkips::closedCells },
    { "neverSeen", &po::SweepSkips::neverSeen },
    { "offsetMasks", &po::SweepSkips::offsetMasks },
    { "blackSky", &po::SweepSkips::blackSky },
    { "lonely", &po::SweepSkips::lonely },
  };
  po::SweepSkips skips;
  if (!name.empty())
  {
    const auto flag = flags.find(name);
    if (flag == flags.end())
    {
      throw std::runtime_error("There is no skip '" + name + "'");
    }
    skips.*flag->second = false;
  }
  return skips;
}

/// The one place to add another estimator (and its levels to METHODS in run_error_benchmark.py).
Method makeMethod(const std::string& name, int level, const std::string& without)
{
  if (name == "Sweep")
  {
    po::SweepOptions options;
    options.directions = level;
    options.skips = skipsWithout(without);
    return { std::make_unique<po::SweepEstimator>(options), 1, true };
  }
  if (!without.empty())
  {
    throw std::runtime_error("--without is only for the method Sweep");
  }
  if (name == "Reference")
  {
    return { std::make_unique<po::ReferenceEstimator>(), level, false };
  }
  if (name == "Embree")
  {
    return { std::make_unique<po::EmbreeEstimator>(po::EmbreeOptions{ level, 0 }), 1, false };
  }
  throw std::runtime_error("There is no method '" + name + "'");
}

/// Gets the raw textures while they are made.
using Observer = std::function<void(const po::RawTextures&)>;

/// RMS difference from values that an earlier run wrote, weighted like the error of a judge.
class Comparison
{
public:
  Comparison(const std::string& file, int resolution)
    : file_(file, std::ios::binary)
    , resolution_(resolution)
  {
  }

  void add(const po::RawTextures& raw)
  {
    const auto side = static_cast<std::size_t>(resolution_);
    std::vector<float> others(raw.count * side * side);
    file_.read(reinterpret_cast<char*>(others.data()),
      static_cast<std::streamsize>(others.size() * sizeof(float)));
    if (!file_)
    {
      throw std::runtime_error("The values to compare with are too few, or cannot be read");
    }
    for (std::size_t i = 0; i < others.size(); ++i)
    {
      const double weight = static_cast<double>(raw.outsideShares[i]) *
        po::texelArea(resolution_, static_cast<int>(i / side % side));
      const double difference = static_cast<double>(raw.values[i]) - others[i];
      squares_ += weight * difference * difference;
      area_ += weight;
    }
  }

  [[nodiscard]] double rms() const { return area_ > 0 ? std::sqrt(squares_ / area_) : 0; }

private:
  std::ifstream file_;
  int resolution_;
  double squares_ = 0;
  double area_ = 0;
};

/// Passes on what an estimator finds and keeps the textures of some particles.
class Recorder : public po::OcclusionEstimator
{
public:
  /// @param positions of the particles to keep, in the list that will be estimated
  Recorder(const po::OcclusionEstimator& estimator, const std::vector<std::size_t>& positions,
    std::size_t texels, Observer observer = {})
    : estimator_(estimator)
    , texels_(texels)
    , observer_(std::move(observer))
  {
    for (std::size_t slot = 0; slot < positions.size(); ++slot)
    {
      slots_[positions[slot]] = slot;
    }
    kept_.values.resize(positions.size() * texels);
    kept_.shares.resize(positions.size() * texels);
  }

  void estimate(const po::BakeScene& scene, const std::vector<unsigned>& particles,
    const po::BakeSettings& settings, po::Progress& progress, const Sink& sink,
    po::BakeCounters& counters) const override
  {
    estimator_.estimate(
      scene, particles, settings, progress,
      [&](const po::RawTextures& raw)
      {
        keep(raw);
        sink(raw);
      },
      counters);
  }

  [[nodiscard]] double bytesPerTexel() const override { return estimator_.bytesPerTexel(); }

  [[nodiscard]] const po::JudgedTexels& kept() const { return kept_; }

private:
  void keep(const po::RawTextures& raw) const
  {
    const auto end = slots_.lower_bound(raw.firstParticle + raw.count);
    for (auto slot = slots_.lower_bound(raw.firstParticle); slot != end; ++slot)
    {
      const std::size_t from = (slot->first - raw.firstParticle) * texels_;
      const std::size_t to = slot->second * texels_;
      std::copy_n(raw.values + from, texels_, kept_.values.begin() + to);
      std::copy_n(raw.outsideShares + from, texels_, kept_.shares.begin() + to);
    }
    if (observer_)
    {
      observer_(raw);
    }
  }

  const po::OcclusionEstimator& estimator_;
  std::size_t texels_;
  Observer observer_;
  std::map<std::size_t, std::size_t> slots_;
  mutable po::JudgedTexels kept_;
};

struct Seconds
{
  double cpu = 0; ///< of all threads of the process
  double wall = 0;
};

class Stopwatch
{
public:
  [[nodiscard]] Seconds elapsed() const
  {
    return { static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC,
      std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count() };
  }

private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// Megabytes from a line of /proc/self/status: "VmHWM" is the peak, "VmRSS" is used now. (The peak
/// of getrusage can be that of the program that started this one.)
double statusMegabytes(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.compare(0, name.size() + 1, name + ":") == 0)
    {
      return std::strtod(line.c_str() + name.size() + 1, nullptr) * 1024 / 1e6;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::size_t texelCount(int resolution)
{
  return static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
}

std::size_t sphereCount(const Options& options)
{
  return static_cast<std::size_t>(options.number("count", 30000));
}

int resolutionOf(const Options& options)
{
  const int resolution = options.number("resolution", 16);
  if (resolution < 1 || resolution > po::BakeSettings::MaximumTextureResolution)
  {
    throw std::runtime_error("--resolution must be from 1 to 64");
  }
  return resolution;
}

/// The base name of a file; other names stay. Unusual conditions come behind it.
std::string shortName(const Options& options)
{
  const std::string scene = options.required("scene");
  const std::size_t slash = scene.find_last_of('/');
  const std::string name = slash == std::string::npos ? scene : scene.substr(slash + 1);
  const std::size_t dot = name.rfind(".vtp");
  std::string result = name.substr(0, dot);
  for (const char* condition : { "background", "distance" })
  {
    const std::string value = options.text(condition);
    result += value.empty() ? "" : "-" + value;
  }
  return result;
}

/// @param radius the mean one, in which --distance is counted
po::BakeSettings settingsOf(const Options& options, double radius)
{
  po::BakeSettings settings;
  settings.textureResolution = resolutionOf(options);
  if (!options.text("background").empty())
  {
    settings.background = po::makeBenchmarkBackground(options.text("background"));
  }
  settings.maximumDistance = options.number("distance", 0) * radius;
  return settings;
}

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
  const Recorder recorder(reference, positions, texelCount(judge.resolution));
  po::Progress progress;
  po::BakeCounters counters;
  recorder.estimate(
    scene, judge.particles, settings, progress, [](const po::RawTextures&) {}, counters);
  return recorder.kept();
}

void makeJudge(const Options& options)
{
  const std::string output = options.required("output");
  const po::SphereCloud cloud =
    po::makeBenchmarkScene(options.required("scene"), sphereCount(options));
  const po::BakeScene scene(cloud);
  po::Judge judge;
  judge.scene = shortName(options);
  judge.spheres = cloud.spheres.size();
  judge.checksum = po::checksum(cloud);
  judge.resolution = resolutionOf(options);
  judge.samples = options.number("samples", 16200);
  std::copy_n(JudgeSeeds, 2, judge.seeds);
  judge.particles =
    po::drawParticles(cloud.spheres.size(), static_cast<std::size_t>(options.number("judged", 32)));
  if (judge.particles.empty() || judge.samples < 2)
  {
    throw std::runtime_error("There must be a particle to judge, and two samples a texel");
  }
  const po::BakeSettings settings = settingsOf(options, cloud.scale);
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

po::Judge judgeFor(const Options& options, const po::SphereCloud& cloud, int resolution)
{
  const std::string file = options.text("judge");
  if (file.empty())
  {
    return {};
  }
  po::Judge judge = po::readJudge(file);
  if (judge.checksum != po::checksum(cloud) || judge.spheres != cloud.spheres.size() ||
    judge.resolution != resolution || judge.scene != shortName(options))
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
  Seconds sceneSeconds;     ///< what comes before any estimate: Embree's hierarchies
  Seconds seconds;          ///< scaled to all particles
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
po::BakeCounters run(const Recorder& recorder, const po::BakeScene& scene,
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
Observer valueWriter(const Options& options)
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
  return [file, texels = texelCount(resolutionOf(options))](const po::RawTextures& raw)
  {
    file->write(reinterpret_cast<const char*>(raw.values),
      static_cast<std::streamsize>(raw.count * texels * sizeof(float)));
  };
}

std::unique_ptr<Comparison> makeComparison(const Options& options)
{
  const std::string file = options.text("compare");
  return file.empty() ? nullptr : std::make_unique<Comparison>(file, resolutionOf(options));
}

Observer joined(Observer writer, Comparison* comparison)
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
Measurement describe(const Options& options)
{
  Measurement result;
  result.scene = shortName(options);
  result.method = options.required("method");
  result.level = options.number("level", 0);
  result.resolution = resolutionOf(options);
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

Selection select(const Options& options, const Method& method, std::size_t particles,
  const std::vector<unsigned>& judged)
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

void measure(const Options& options)
{
  Measurement result = describe(options);
  const Method method = makeMethod(result.method, result.level, options.text("without"));
  if (!options.text("target").empty())
  {
    allowOnlyTarget(options.text("target"));
  }
  const auto threads = limitThreads(options.number("threads", 0));

  const po::SphereCloud cloud =
    po::makeBenchmarkScene(options.required("scene"), sphereCount(options));
  const Stopwatch sceneWatch;
  const po::BakeScene scene(cloud);
  result.sceneSeconds = sceneWatch.elapsed();
  result.sceneMegabytes = statusMegabytes("VmRSS");
  result.particles = cloud.spheres.size();

  const po::Judge judge = judgeFor(options, cloud, result.resolution);
  const Selection selection = select(options, method, result.particles, judge.particles);
  result.measured = selection.list.size();
  po::BakeSettings settings = settingsOf(options, cloud.scale);
  settings.samplesPerTexel = method.samplesPerTexel;
  settings.seed = MeasuredSeed;
  const std::unique_ptr<Comparison> comparison = makeComparison(options);
  const Recorder recorder(*method.estimator, selection.judged, texelCount(result.resolution),
    joined(valueWriter(options), comparison.get()));
  const bool bake = method.allAtOnce && options.number("bake", 0) > 0;

  const Stopwatch watch;
  const po::BakeCounters counters = run(recorder, scene, selection.list, settings, bake);
  const Seconds seconds = watch.elapsed();
  const double scale = static_cast<double>(result.particles) / static_cast<double>(result.measured);
  result.seconds = { scale * seconds.cpu, scale * seconds.wall };
  result.peakMegabytes = statusMegabytes("VmHWM");

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
  const Options options(argc, argv, 2);
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
