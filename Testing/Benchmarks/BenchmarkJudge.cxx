// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkJudge.h"

#include "TexelMap.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <stdexcept>
#include <utility>

namespace po
{
namespace
{
constexpr const char* Format = "ParticleOcclusionJudge";
constexpr int Version = 1;
constexpr float LargestValue = 65535;
constexpr float LargestShare = 255;

std::size_t texelsOf(const Judge& judge)
{
  const auto side = static_cast<std::size_t>(judge.resolution);
  return judge.particles.size() * side * side;
}

/// Steradians of a texel outside other spheres.
double weightOf(const Judge& judge, std::size_t texel)
{
  const auto side = static_cast<std::size_t>(judge.resolution);
  return texelArea(judge.resolution, static_cast<int>(texel / side % side)) *
    static_cast<double>(judge.texels.shares[texel]);
}

void writeNumber(std::ostream& file, std::uint32_t number, int bytes)
{
  for (int i = 0; i < bytes; ++i)
  {
    file.put(static_cast<char>(number >> (8 * i) & 0xFF));
  }
}

std::uint32_t readNumber(std::istream& file, int bytes)
{
  std::uint32_t number = 0;
  for (int i = 0; i < bytes; ++i)
  {
    number |= static_cast<std::uint32_t>(file.get() & 0xFF) << (8 * i);
  }
  return number;
}

void writeFractions(
  std::ostream& file, const std::vector<float>& fractions, float largest, int bytes)
{
  for (const float fraction : fractions)
  {
    const float clamped = std::clamp(fraction, 0.0f, 1.0f);
    writeNumber(file, static_cast<std::uint32_t>(std::lround(largest * clamped)), bytes);
  }
}

std::vector<float> readFractions(std::istream& file, std::size_t count, float largest, int bytes)
{
  std::vector<float> fractions(count);
  for (float& fraction : fractions)
  {
    fraction = static_cast<float>(readNumber(file, bytes)) / largest;
  }
  return fractions;
}

template <typename T>
T readKey(std::istream& file, const std::string& key)
{
  std::string found;
  T value{};
  if (!(file >> found >> value) || found != key)
  {
    throw std::runtime_error("'" + key + "' is missing");
  }
  return value;
}

void readHeader(std::istream& file, Judge& judge)
{
  if (readKey<int>(file, Format) != Version)
  {
    throw std::runtime_error("another version");
  }
  judge.scene = readKey<std::string>(file, "scene");
  judge.spheres = readKey<std::size_t>(file, "spheres");
  judge.checksum = readKey<std::uint64_t>(file, "checksum");
  judge.resolution = readKey<int>(file, "resolution");
  judge.samples = readKey<int>(file, "samples");
  judge.seeds[0] = readKey<std::uint64_t>(file, "seed");
  judge.seeds[1] = readKey<std::uint64_t>(file, "seed");
  judge.noise = readKey<double>(file, "noise");
  const auto particles = readKey<std::size_t>(file, "particles");
  if (judge.resolution < 1 || judge.resolution > 64 || particles < 1 || particles > judge.spheres)
  {
    throw std::runtime_error("numbers out of range");
  }
  judge.particles.resize(particles);
  std::string line;
  std::getline(file, line);
  if (!std::getline(file, line) || line != "data")
  {
    throw std::runtime_error("'data' is missing");
  }
}

Judge readFrom(std::istream& file)
{
  Judge judge;
  readHeader(file, judge);
  for (unsigned& particle : judge.particles)
  {
    particle = readNumber(file, 4);
    if (particle >= judge.spheres)
    {
      throw std::runtime_error("a particle that the scene has not");
    }
  }
  judge.texels.values = readFractions(file, texelsOf(judge), LargestValue, 2);
  judge.texels.shares = readFractions(file, texelsOf(judge), LargestShare, 1);
  if (!file)
  {
    throw std::runtime_error("it is too short");
  }
  return judge;
}

/// The error that 99 % of the area does not exceed.
double percentile99(std::vector<std::pair<double, double>> errorsAndWeights, double area)
{
  std::sort(errorsAndWeights.begin(), errorsAndWeights.end());
  double below = 0;
  for (const auto& [error, weight] : errorsAndWeights)
  {
    below += weight;
    if (below >= 0.99 * area)
    {
      return error;
    }
  }
  return 0;
}
}

void mergeHalves(const JudgedTexels& a, const JudgedTexels& b, Judge& judge)
{
  judge.texels = a;
  double squares = 0;
  double area = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
  {
    const float share = a.shares[i] + b.shares[i];
    judge.texels.shares[i] = share / 2;
    judge.texels.values[i] =
      share > 0 ? (a.values[i] * a.shares[i] + b.values[i] * b.shares[i]) / share : 0;
    if (a.shares[i] > 0 && b.shares[i] > 0)
    {
      const double weight = weightOf(judge, i);
      const double difference = static_cast<double>(a.values[i]) - b.values[i];
      squares += weight * difference * difference;
      area += weight;
    }
  }
  // The difference has twice the variance of a half, the mean has half of it.
  judge.noise = area > 0 ? std::sqrt(squares / area) / 2 : 0;
}

void writeJudge(const Judge& judge, const std::string& path)
{
  std::ofstream file(path, std::ios::binary);
  file << Format << ' ' << Version << "\nscene " << judge.scene << "\nspheres " << judge.spheres
       << "\nchecksum " << judge.checksum << "\nresolution " << judge.resolution << "\nsamples "
       << judge.samples << "\nseed " << judge.seeds[0] << "\nseed " << judge.seeds[1] << "\nnoise "
       << std::setprecision(4) << judge.noise << "\nparticles " << judge.particles.size()
       << "\ndata\n";
  for (const unsigned particle : judge.particles)
  {
    writeNumber(file, particle, 4);
  }
  writeFractions(file, judge.texels.values, LargestValue, 2);
  writeFractions(file, judge.texels.shares, LargestShare, 1);
  if (!file.flush())
  {
    throw std::runtime_error("Cannot write " + path);
  }
}

Judge readJudge(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  try
  {
    return readFrom(file);
  }
  catch (const std::runtime_error& problem)
  {
    throw std::runtime_error("Cannot read the reference " + path + ": " + problem.what());
  }
}

VisibilityError errorOf(const JudgedTexels& found, const Judge& judge)
{
  VisibilityError error;
  double area = 0;
  std::vector<std::pair<double, double>> errorsAndWeights;
  for (std::size_t i = 0; i < judge.texels.values.size(); ++i)
  {
    const double weight = weightOf(judge, i);
    const double difference = static_cast<double>(found.values[i]) - judge.texels.values[i];
    error.rms += weight * difference * difference;
    error.bias += weight * difference;
    area += weight;
    errorsAndWeights.emplace_back(std::abs(difference), weight);
  }
  if (!(area > 0))
  {
    return {};
  }
  return { std::sqrt(error.rms / area), error.bias / area,
    percentile99(std::move(errorsAndWeights), area) };
}
}
