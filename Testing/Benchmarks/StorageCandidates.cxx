// SPDX-License-Identifier: BSD-3-Clause
#include "StorageCandidates.h"

#include "ComponentPacker.h"
#include "Gamma2.h"
#include "HarmonicBasis.h"
#include "LeaderSearch.h"
#include "TexelMap.h"
#include "TextureSample.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace po
{
namespace
{
constexpr double IndexBytes = 4;
constexpr double Error = 0.01;
constexpr std::size_t SampleSize = 4096;

std::size_t texelsOf(const Baked& baked)
{
  return baked.table.texelsPerRow();
}

const float* textureOf(const Baked& baked, std::size_t row)
{
  return baked.table.values().data() + row * texelsOf(baked);
}

TextureTable copyOf(const Baked& baked)
{
  TextureTable copy(baked.resolution, static_cast<std::size_t>(baked.table.rows()));
  for (std::int32_t row = 0; row < baked.table.rows(); ++row)
  {
    copy.insert(baked.table.texture(row));
  }
  return copy;
}

/// A table as bytes of UInt8Gamma2, and which row each particle has.
struct BytesOfBake
{
  EncodedTable table;
  std::vector<std::int32_t> rowOf;
};

Candidate fromBytes(const Baked& baked, const std::string& name, BytesOfBake&& bytes, double size)
{
  auto kept = std::make_shared<BytesOfBake>(std::move(bytes));
  Candidate candidate;
  candidate.name = name;
  candidate.bytes = size + IndexBytes * static_cast<double>(kept->rowOf.size());
  candidate.decode = [kept, texels = texelsOf(baked)](std::size_t particle, float* texture)
  {
    const auto row = static_cast<std::size_t>(kept->rowOf[particle]);
    std::transform(kept->table.bytes.begin() + static_cast<std::ptrdiff_t>(row * texels),
      kept->table.bytes.begin() + static_cast<std::ptrdiff_t>((row + 1) * texels), texture,
      [&](std::uint8_t byte)
      { return static_cast<float>(decodeGamma2(byte, kept->table.maximum)); });
  };
  candidate.textures = std::make_shared<OcclusionTextures>(
    baked.resolution, kept->table.bytes.data(), kept->table.maximum, kept->rowOf.data(), nullptr);
  // The textures refer to the table: both live as long as the candidate.
  candidate.decode = [kept, textures = candidate.textures, decode = candidate.decode](
                       std::size_t particle, float* texture) { decode(particle, texture); };
  return candidate;
}

Candidate plainBytes(const Baked& baked)
{
  BytesOfBake bytes;
  bytes.rowOf = baked.rowOf;
  bytes.table = encode(copyOf(baked), Encoding::UInt8Gamma2, bytes.rowOf, baked.maximum);
  const auto size = static_cast<double>(bytes.table.bytes.size());
  return fromBytes(baked, "8 bit, equal ones once", std::move(bytes), size);
}

/// The rows of a table that stand for others, and which stands for each.
struct Leaders
{
  std::vector<std::size_t> rows;
  std::vector<std::int32_t> of;
};

BytesOfBake byLeaders(const Baked& baked, const Leaders& leaders)
{
  TextureTable table(baked.resolution, leaders.rows.size());
  std::vector<std::int32_t> target;
  for (const std::size_t row : leaders.rows)
  {
    target.push_back(table.insert(textureOf(baked, row)));
  }
  BytesOfBake bytes;
  for (const std::int32_t row : baked.rowOf)
  {
    bytes.rowOf.push_back(
      target[static_cast<std::size_t>(leaders.of[static_cast<std::size_t>(row)])]);
  }
  bytes.table = encode(std::move(table), Encoding::UInt8Gamma2, bytes.rowOf, baked.maximum);
  return bytes;
}

/// Textures that differ by no more than is allowed are stored once.
Candidate nearEqual(const Baked& baked, double allowed)
{
  constexpr std::size_t MostTried = 2000; // sharing was no more common with all
  LeaderSearch search(texelShares(baked.resolution), allowed, MostTried);
  Leaders leaders;
  for (std::int32_t row = 0; row < baked.table.rows(); ++row)
  {
    const float* texture = textureOf(baked, static_cast<std::size_t>(row));
    std::int32_t leader = search.find(texture);
    if (leader < 0)
    {
      leader = static_cast<std::int32_t>(leaders.rows.size());
      leaders.rows.push_back(static_cast<std::size_t>(row));
      search.add(leader, std::vector<float>(texture, texture + texelsOf(baked)));
    }
    leaders.of.push_back(leader);
  }
  BytesOfBake bytes = byLeaders(baked, leaders);
  const auto size = static_cast<double>(bytes.table.bytes.size());
  return fromBytes(baked, "8 bit, near-equal ones once", std::move(bytes), size);
}

/// A codebook by Lloyd's iteration on a sample; textures go to the nearest word.
Candidate vectorQuantization(
  const Baked& baked, const std::vector<float>& sample, std::size_t words)
{
  const std::size_t texels = texelsOf(baked);
  const std::vector<float> shares = texelShares(baked.resolution);
  const std::size_t samples = sample.size() / texels;
  words = std::min(words, samples);
  std::vector<float> book(
    sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(words * texels));
  const auto nearest = [&](const float* texture)
  {
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t word = 0; word < words; ++word)
    {
      const double d = squareDifference(shares, texture, book.data() + word * texels, least);
      if (d < least)
      {
        best = word;
        least = d;
      }
    }
    return best;
  };
  constexpr int Rounds = 6;
  std::vector<std::size_t> wordOf(samples);
  for (int round = 0; round < Rounds; ++round)
  {
    tbb::parallel_for(std::size_t(0), samples,
      [&](std::size_t i) { wordOf[i] = nearest(sample.data() + i * texels); });
    std::vector<float> sums(book.size(), 0.0f);
    std::vector<float> counts(words, 0.0f);
    for (std::size_t i = 0; i < samples; ++i)
    {
      ++counts[wordOf[i]];
      for (std::size_t t = 0; t < texels; ++t)
      {
        sums[wordOf[i] * texels + t] += sample[i * texels + t];
      }
    }
    for (std::size_t i = 0; i < book.size(); ++i)
    {
      const float count = counts[i / texels];
      book[i] = count > 0 ? sums[i] / count : book[i];
    }
  }
  BytesOfBake bytes;
  bytes.table.maximum = baked.maximum;
  std::transform(book.begin(), book.end(), std::back_inserter(bytes.table.bytes),
    [&](float v) { return encodeGamma2(static_cast<double>(v), baked.maximum); });
  bytes.table.bytes.resize(bytes.table.bytes.size() + texels, 0); // for the dark ones
  std::vector<std::int32_t> wordOfRow(static_cast<std::size_t>(baked.table.rows()));
  tbb::parallel_for(std::size_t(0), wordOfRow.size(),
    [&](std::size_t row)
    {
      const float* texture = textureOf(baked, row);
      const bool dark = std::all_of(texture, texture + texels, [](float v) { return v == 0; });
      wordOfRow[row] = static_cast<std::int32_t>(dark ? words : nearest(texture));
    });
  for (const std::int32_t row : baked.rowOf)
  {
    bytes.rowOf.push_back(wordOfRow[static_cast<std::size_t>(row)]);
  }
  const auto size = static_cast<double>(bytes.table.bytes.size());
  return fromBytes(
    baked, "vector quantization, " + std::to_string(words) + " words", std::move(bytes), size);
}

/// Blocks of 4 x 4 texels: the least and the largest value as bytes, 4 bits a texel between them.
Candidate fourBits(const Baked& baked)
{
  const std::size_t texels = texelsOf(baked);
  const auto side = static_cast<std::size_t>(baked.resolution);
  Candidate candidate;
  candidate.name = "4 bit, blocks of 4 x 4";
  candidate.bytes =
    static_cast<double>(baked.table.rows()) * static_cast<double>(texels / 16 * 10) +
    IndexBytes * static_cast<double>(baked.rowOf.size());
  candidate.decode = [&baked, side](std::size_t particle, float* texture)
  {
    const float* source = textureOf(baked, static_cast<std::size_t>(baked.rowOf[particle]));
    for (std::size_t block = 0; block < side * side / 16; ++block)
    {
      const std::size_t first = block / (side / 4) * 4 * side + block % (side / 4) * 4;
      int low = 255, high = 0;
      std::array<int, 16> bytes;
      for (std::size_t i = 0; i < 16; ++i)
      {
        const float value = source[first + i / 4 * side + i % 4];
        bytes[i] = encodeGamma2(static_cast<double>(value), baked.maximum);
        low = std::min(low, bytes[i]);
        high = std::max(high, bytes[i]);
      }
      for (std::size_t i = 0; i < 16; ++i)
      {
        const double step = (high - low) / 15.0;
        const double level = step > 0 ? std::round((bytes[i] - low) / step) : 0;
        const double shown = (low + level * step) / 255;
        texture[first + i / 4 * side + i % 4] = static_cast<float>(baked.maximum * shown * shown);
      }
    }
  };
  return candidate;
}

/// What a packed table is read with.
struct Packed
{
  EncodedTable table;
  std::vector<std::int32_t> rowOf;
  std::shared_ptr<const PackedTextures> textures;
};

std::shared_ptr<Packed> packWith(const Baked& baked, const TexturePacker& packer)
{
  auto packed = std::make_shared<Packed>();
  packed->rowOf = baked.rowOf;
  packed->table = packTable(copyOf(baked), packer, packed->rowOf);
  packed->textures = std::make_shared<PackedTextures>(
    packed->table.packed, packed->table.bytes.data(), static_cast<std::size_t>(packed->table.rows));
  return packed;
}

/// @param size bytes of the table and its basis, or negative: as packed
Candidate byPacker(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double size = -1)
{
  const std::shared_ptr<Packed> packed = packWith(baked, packer);
  Candidate candidate;
  candidate.name = name;
  candidate.bytes = (size < 0 ? static_cast<double>(packed->table.size()) : size) +
    IndexBytes * static_cast<double>(baked.rowOf.size());
  candidate.textures = std::make_shared<OcclusionTextures>(
    packed->textures, baked.resolution, packed->rowOf.data(), nullptr);
  candidate.decode = [packed](std::size_t particle, float* texture)
  { packed->textures->decode(static_cast<std::size_t>(packed->rowOf[particle]), texture); };
  return candidate;
}

/// Packed textures, in whose place one that is there already is taken where it differs by no more
/// than is allowed.
Candidate packedNearEqual(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double allowed)
{
  const std::shared_ptr<Packed> packed = packWith(baked, packer);
  constexpr std::size_t MostTried = 500;
  LeaderSearch leaders(texelShares(baked.resolution), allowed, MostTried);
  std::map<std::int32_t, std::int32_t> wordOfRow;
  std::set<std::int32_t> kept;
  for (std::size_t particle = 0; particle < packed->rowOf.size(); ++particle)
  {
    const auto [known, isNew] = wordOfRow.try_emplace(baked.rowOf[particle], -1);
    if (isNew)
    {
      const float* texture = textureOf(baked, static_cast<std::size_t>(known->first));
      known->second = leaders.find(texture);
    }
    if (known->second < 0)
    {
      known->second = packed->rowOf[particle];
      std::vector<float> decoded(texelsOf(baked));
      packed->textures->decode(static_cast<std::size_t>(known->second), decoded.data());
      leaders.add(known->second, std::move(decoded));
    }
    packed->rowOf[particle] = known->second;
    kept.insert(known->second);
  }
  Candidate candidate;
  candidate.name = name;
  candidate.bytes = IndexBytes * static_cast<double>(baked.rowOf.size()) +
    static_cast<double>(sizeof(std::int16_t) * packed->table.packed.basis.numbers.size());
  for (const std::int32_t word : kept)
  {
    candidate.bytes += static_cast<double>(
      PackedFormat::WordBytes * packed->textures->lengthAt(static_cast<std::size_t>(word)));
  }
  candidate.decode = [packed](std::size_t particle, float* texture)
  { packed->textures->decode(static_cast<std::size_t>(packed->rowOf[particle]), texture); };
  return candidate;
}

/// Every texture by the same number of coefficients in a basis; dark ones as one value.
class FixedPacker : public TexturePacker
{
public:
  FixedPacker(const Baked& baked, TextureBasis basis, std::size_t c, std::vector<std::uint8_t> bits)
    : TexturePacker(baked.resolution, baked.maximum)
    , class_(c)
  {
    format_.basis = std::move(basis);
    format_.classBits.resize(c + 1);
    format_.classBits[c] = std::move(bits);
    projection_.emplace_back(format_.basis);
  }

  [[nodiscard]] Code pack(const WeighedTexture& texture) const override
  {
    const float* values = texture.values;
    std::vector<float> weights;
    const bool dark =
      std::all_of(values, values + texelsPerTexture(), [](float value) { return value == 0; });
    if (dark)
    {
      return packSize(values, areaOf({ values, nullptr }, weights), 0);
    }
    std::vector<float> coefficients(format_.basis.components());
    projection_.front().project(values, coefficients.data());
    return packClass(class_, coefficients);
  }

private:
  std::size_t class_;
  std::vector<TextureProjection> projection_;
};

/// The shortest class that holds so many bits.
std::size_t classFor(std::size_t bits)
{
  std::size_t c = 0;
  while (static_cast<std::size_t>(PackedFormat::classBitCount(PackedFormat::ClassWords[c])) < bits)
  {
    ++c;
  }
  return c;
}

double sizeOf(const Baked& baked, const TextureBasis& basis, std::size_t bytesPerTexture)
{
  return static_cast<double>(bytesPerTexture) * baked.table.rows() +
    static_cast<double>(sizeof(std::int16_t) * basis.numbers.size());
}

Candidate byCoefficients(const Baked& baked, const std::string& name, const TextureBasis& basis)
{
  const std::size_t count = basis.components();
  const FixedPacker packer(baked, basis, classFor(8 * count), std::vector<std::uint8_t>(count, 8));
  return byPacker(baked, name, packer, sizeOf(baked, basis, count));
}

TextureBasis firstComponents(TextureBasis basis, std::size_t count)
{
  count = std::min(count, basis.components());
  basis.numbers.resize((1 + count) * basis.texels());
  return basis;
}

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
