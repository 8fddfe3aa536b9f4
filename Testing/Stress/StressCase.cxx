// SPDX-License-Identifier: BSD-3-Clause
#include "StressCase.h"

#include "EmbreeEstimator.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace stress
{
namespace
{
std::unique_ptr<po::OcclusionEstimator> estimatorOf(Method method, int work)
{
  if (method == Method::Reference)
  {
    return std::make_unique<po::ReferenceEstimator>();
  }
  if (method == Method::Sweep)
  {
    po::SweepOptions options;
    options.directions = work;
    return std::make_unique<po::SweepEstimator>(options);
  }
  po::EmbreeOptions options;
  options.directions = work;
  return std::make_unique<po::EmbreeEstimator>(options);
}

/// Area of a texel's row on the unit sphere, up to a factor.
double areaOf(std::size_t texel)
{
  constexpr double pi = 3.14159265358979323846;
  const auto row = static_cast<double>(texel / Resolution % Resolution);
  return std::cos(pi * row / Resolution) - std::cos(pi * (row + 1) / Resolution);
}

/// a ln(a / b), 0 for a = 0.
double term(double a, double b)
{
  return a > 0 ? a * std::log(a / b) : 0;
}
}

const char* nameOf(Method method)
{
  constexpr const char* names[] = { "Reference", "Sweep", "Embree" };
  return names[static_cast<int>(method)];
}

int usualWork(Method method)
{
  return method == Method::Reference ? 256 : 512;
}

Baked bake(const std::vector<Ball>& balls, const std::vector<std::size_t>& watched, Method method,
  int work, std::uint64_t seed, double maximumDistance)
{
  const po::SphereCloud cloud = po::makeSphereCloud(
    balls.size(), [&](std::size_t i) { return balls[i].center; },
    [&](std::size_t i) { return balls[i].radius; });
  const po::BakeScene scene(cloud);
  po::BakeSettings settings;
  settings.textureResolution = Resolution;
  settings.samplesPerTexel = work;
  settings.maximumDistance = maximumDistance;
  settings.seed = seed;
  // A sweep sees all particles at once, as it does in use.
  std::vector<unsigned> list;
  std::vector<std::size_t> placeOf(balls.size(), balls.size());
  for (unsigned i = 0; i < cloud.spheres.size(); ++i)
  {
    const auto source = static_cast<std::size_t>(cloud.sourceIds[i]);
    if (method == Method::Sweep ||
      std::find(watched.begin(), watched.end(), source) != watched.end())
    {
      placeOf[source] = list.size();
      list.push_back(i);
    }
  }
  Baked all;
  po::Progress progress;
  po::BakeCounters counters;
  estimatorOf(method, work)
    ->estimate(
      scene, list, settings, progress,
      [&](const po::RawTextures& raw)
      {
        all.values.insert(all.values.end(), raw.values, raw.values + raw.count * Texels);
        all.shares.insert(
          all.shares.end(), raw.outsideShares, raw.outsideShares + raw.count * Texels);
      },
      counters);
  Baked baked;
  for (const std::size_t id : watched)
  {
    for (std::size_t texel = 0; texel < Texels; ++texel)
    {
      const std::size_t at = placeOf[id] * Texels + texel;
      const bool known = placeOf[id] < list.size();
      baked.values.push_back(known ? all.values[at] : 0.0f);
      baked.shares.push_back(known ? all.shares[at] : -1.0f);
    }
  }
  return baked;
}

Judgement judgeOf(const std::vector<Ball>& balls, const std::vector<std::size_t>& watched,
  int points, double maximumDistance)
{
  const judge::Judge judge(balls);
  const double distance =
    maximumDistance > 0 ? maximumDistance : std::numeric_limits<double>::infinity();
  Judgement judgement;
  for (const std::size_t id : watched)
  {
    for (int texel = 0; texel < static_cast<int>(Texels); ++texel)
    {
      const int row = texel / Resolution;
      const int column = texel % Resolution;
      judgement.texels.push_back(judge.look(id, Resolution, row, column, points, distance));
      judgement.open.push_back(judge.isOpen(id, Resolution, row, column));
    }
  }
  return judgement;
}

Outcome compare(
  const Scene& scene, const Judgement& judgement, const Baked& baked, double independent)
{
  Outcome outcome;
  double area = 0;
  double squares = 0;
  double noise = 0;
  double variance = 0;
  outcome.squares.assign(judgement.texels.size(), 0);
  for (std::size_t i = 0; i < judgement.texels.size(); ++i)
  {
    const judge::Texel& truth = judgement.texels[i];
    const std::size_t id = scene.watched[i / Texels];
    const bool dark = std::count(scene.sealed.begin(), scene.sealed.end(), id) > 0;
    outcome.leaks += dark && baked.values[i] > 0 ? 1 : 0;
    outcome.open += judgement.open[i] ? 1 : 0;
    outcome.selfHits += judgement.open[i] && baked.values[i] < 1 - 1e-6 ? 1 : 0;
    if (truth.outside < 16 || baked.shares[i] <= 0)
    {
      continue;
    }
    ++outcome.texels;
    const double weight = areaOf(i) * truth.outsideShare();
    const auto value = static_cast<double>(baked.values[i]);
    const double error = value - truth.value();
    const double rays = independent * std::min(1.0, static_cast<double>(baked.shares[i]));
    const double share = (truth.open + value * rays) / (truth.outside + rays);
    outcome.squares[i] = weight * error * error;
    squares += weight * error * error;
    noise += weight * share * (1 - share) / truth.outside;
    variance += weight * weight * share * (1 - share) * (1.0 / truth.outside + 1 / rays);
    outcome.bias += weight * error;
    area += weight;
    outcome.worstZ =
      std::max(outcome.worstZ, std::abs(zOf(truth.open, truth.outside, value * rays, rays)));
  }
  if (area > 0)
  {
    outcome.rms = std::sqrt(std::max(0.0, (squares - noise) / area));
    outcome.bias /= area;
    outcome.biasError = std::sqrt(variance) / area;
  }
  return outcome;
}

double independentRays(Method method, int work)
{
  return method == Method::Reference ? work : 3.0 * work / 8;
}

double zOf(double a, double n, double b, double m)
{
  const double share = (a + b) / (n + m);
  const double other = 1 - share;
  const double ratio =
    term(a, n * share) + term(n - a, n * other) + term(b, m * share) + term(m - b, m * other);
  return std::copysign(std::sqrt(2 * std::max(0.0, ratio)), b / m - a / n);
}

double sidakBound(std::size_t count, double risk)
{
  // 1 - (1 - p)^count = risk for the two tails p of one deviation, which erfc gives.
  const double p = -std::expm1(std::log1p(-risk) / static_cast<double>(count));
  double low = 0;
  double high = 40;
  for (int i = 0; i < 100; ++i)
  {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
  }
  return high;
}

std::vector<Row> runScene(const Scene& scene)
{
  // Where the input is the same up to rounding, so is what the judge finds.
  constexpr double same = 1e-9;
  const Judgement atOrigin = judgeOf(scene.balls, scene.watched, JudgePoints);
  std::vector<Row> rows;
  for (const Placement& placement : placements())
  {
    Row row{ placement, inputError(scene, placement), {} };
    const std::vector<Ball> balls = place(scene, placement);
    const Judgement judgement =
      row.inputError < same ? atOrigin : judgeOf(balls, scene.watched, JudgePoints);
    for (const Method method : Methods)
    {
      const int work = usualWork(method);
      row.outcomes[static_cast<int>(method)] = compare(
        scene, judgement, bake(balls, scene.watched, method, work), independentRays(method, work));
    }
    rows.push_back(row);
  }
  return rows;
}

double growth(const Outcome& outcome, const Outcome& base)
{
  double sum = 0;
  double square = 0;
  const auto count = static_cast<double>(outcome.squares.size());
  for (std::size_t i = 0; i < outcome.squares.size(); ++i)
  {
    const double difference = outcome.squares[i] - base.squares[i];
    sum += difference;
    square += difference * difference;
  }
  const double variance = square - sum * sum / count;
  return variance > 0 ? sum / std::sqrt(variance) : 0;
}
}
