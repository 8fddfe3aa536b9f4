// SPDX-License-Identifier: BSD-3-Clause
#include "StorageCandidates.h"

#include "ByteCandidates.h"
#include "ComponentPacker.h"
#include "HarmonicBasis.h"
#include "LeaderSearch.h"
#include "PackedCandidates.h"
#include "TexturePacker.h"
#include "TextureSample.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace po
{
namespace
{
constexpr double Error = 0.01;
constexpr std::size_t SampleSize = 4096;

Candidate oneValue(const Baked& baked)
{
  Candidate candidate;
  candidate.name = "one value";
  candidate.bytes = IndexBytes * static_cast<double>(baked.rowOf.size()) + 256;
  candidate.decode = [&baked](std::size_t particle, float* texture)
  { std::fill_n(texture, texelsOf(baked), baked.mean[particle]); };
  return candidate;
}

/// What was tried and is not in the filter.
void addStudied(
  const Baked& baked, const TextureSample& sample, double allowed, std::vector<Candidate>& all)
{
  const int resolution = baked.resolution;
  const double maximum = baked.maximum;
  all.push_back(nearEqual(baked, Error));
  all.push_back(
    byPacker(baked, "variable size, difference 0.01", SizePacker(resolution, maximum, Error)));
  all.push_back(packedNearEqual(baked, "variable size, near-equal ones once",
    SizePacker(resolution, maximum, allowed), allowed));
  all.push_back(packedNearEqual(baked, "compressed, near-equal ones once",
    ComponentPacker(resolution, maximum, allowed, sample), allowed));
  all.push_back(fourBits(baked));
  all.push_back(vectorQuantization(baked, sample.values, 256));
  all.push_back(vectorQuantization(baked, sample.values, 2048));
  for (const int bands : { 3, 4 })
  {
    all.push_back(byCoefficients(baked, "spherical harmonics, " + std::to_string(bands * bands),
      sphericalHarmonics(resolution, sample.values, bands)));
  }
  const TextureBasis basis = principalComponents(resolution, sample.values, 64);
  for (const std::size_t count : { 4, 8, 12, 16 })
  {
    all.push_back(
      byCoefficients(baked, "principal components, " + std::to_string(count) + " of 8 bit",
        firstComponents(basis, count)));
  }
  const std::vector<std::uint8_t> bits =
    shareBits(TextureProjection(basis).variances(), PackedFormat::classBitCount(3));
  all.push_back(byPacker(baked, "principal components, 12 bytes, bits by variance",
    FixedPacker(baked, firstComponents(basis, bits.size()), 1, bits)));
  all.push_back(byPacker(baked, "the same, length by texture, difference 0.01",
    ComponentPacker(resolution, maximum, Error, sample)));
}
}

Candidate uncompressed(const Baked& baked)
{
  Candidate candidate;
  candidate.name = "floats";
  candidate.decode = [&baked](std::size_t particle, float* texture)
  {
    std::copy_n(
      textureOf(baked, static_cast<std::size_t>(baked.rowOf[particle])), texelsOf(baked), texture);
  };
  return candidate;
}

std::vector<Candidate> makeCandidates(const Baked& baked, Candidates which)
{
  const double allowed = allowedDifference(Error, baked.noise);
  const TextureSample sample = sampleTextures(baked.table, SampleSize, ProcessGroup::alone());
  std::vector<Candidate> all;
  all.push_back(plainBytes(baked));
  if (which == Candidates::All)
  {
    addStudied(baked, sample, allowed, all);
  }
  all.push_back(oneValue(baked));
  all.push_back(
    byPacker(baked, "**variable size**", SizePacker(baked.resolution, baked.maximum, allowed)));
  all.push_back(byPacker(
    baked, "**compressed**", ComponentPacker(baked.resolution, baked.maximum, allowed, sample)));
  for (Candidate& candidate : all)
  {
    candidate.timeFrames = candidate.name == all.front().name || candidate.name[0] == '*';
  }
  return all;
}

double differenceOf(const Baked& baked, const Candidate& candidate)
{
  const SizePacker areas(baked.resolution, baked.maximum, 0);
  std::vector<float> weights, texture(texelsOf(baked));
  double sum = 0;
  double visible = 0;
  for (std::size_t particle = 0; particle < baked.rowOf.size(); ++particle)
  {
    if (baked.mean[particle] > 0)
    {
      candidate.decode(particle, texture.data());
      const WeighedTexture own = baked.table.texture(baked.rowOf[particle]);
      const TexturePacker::Area area = areas.areaOf(own, weights);
      sum += squareDifference(
        { area.weights, area.weights + texture.size() }, own.values, texture.data());
      visible += area.sum;
    }
  }
  return std::sqrt(sum / visible);
}
}
