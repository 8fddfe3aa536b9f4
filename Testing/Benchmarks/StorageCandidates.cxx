// SPDX-License-Identifier: BSD-3-Clause
#include "StorageCandidates.h"

#include "ComponentPacker.h"
#include "Gamma2.h"
#include "TexelMap.h"
#include "TextureSample.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
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
    copy.insert(textureOf(baked, static_cast<std::size_t>(row)));
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

double squareDifference(
  const std::vector<float>& shares, const float* a, const float* b, double stopAt = 1e300)
{
  double sum = 0;
  for (std::size_t i = 0; i < shares.size() && sum <= stopAt; ++i)
  {
    const double d = static_cast<double>(a[i] - b[i]);
    sum += static_cast<double>(shares[i]) * d * d;
  }
  return sum;
}

/// Textures that differ by no more than is allowed are stored once. Candidates are those whose
/// means are alike, which is necessary.
Candidate nearEqual(const Baked& baked, double allowed)
{
  const std::vector<float> shares = texelShares(baked.resolution);
  Leaders leaders;
  std::map<long, std::vector<std::int32_t>> byMean;
  constexpr std::size_t MostTried = 2000; // of each mean: sharing was no more common with all
  for (std::int32_t row = 0; row < baked.table.rows(); ++row)
  {
    const float* texture = textureOf(baked, static_cast<std::size_t>(row));
    const double mean = std::inner_product(shares.begin(), shares.end(), texture, 0.0);
    const long cell = std::lround(mean / allowed);
    std::int32_t found = -1;
    for (long near = cell - 1; near <= cell + 1 && found < 0; ++near)
    {
      const std::vector<std::int32_t>& known = byMean[near];
      const std::size_t first = known.size() > MostTried ? known.size() - MostTried : 0;
      for (std::size_t i = first; i < known.size() && found < 0; ++i)
      {
        const std::size_t other = leaders.rows[static_cast<std::size_t>(known[i])];
        const bool near = squareDifference(shares, texture, textureOf(baked, other),
                            allowed * allowed) <= allowed * allowed;
        found = near ? known[i] : -1;
      }
    }
    if (found < 0)
    {
      found = static_cast<std::int32_t>(leaders.rows.size());
      leaders.rows.push_back(static_cast<std::size_t>(row));
      byMean[cell].push_back(found);
    }
    leaders.of.push_back(found);
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

/// @param size bytes of the table and its basis, or negative: as packed
Candidate byPacker(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double size = -1)
{
  auto packed = std::make_shared<Packed>();
  packed->rowOf = baked.rowOf;
  packed->table = packTable(copyOf(baked), packer, packed->rowOf);
  packed->textures = std::make_shared<PackedTextures>(
    packed->table.packed, packed->table.bytes.data(), static_cast<std::size_t>(packed->table.rows));
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

/// The first leader whose decoded texture differs from a texture by no more than is allowed, among
/// those of nearly the same mean, which is necessary.
class LeaderSearch
{
public:
  LeaderSearch(std::vector<float> shares, double allowed)
    : shares_(std::move(shares))
    , allowed_(allowed)
  {
  }

  /// @return its word, or -1
  [[nodiscard]] std::int32_t find(const float* texture) const
  {
    constexpr std::size_t MostTried = 500; // of each mean
    for (long cell = cellOf(texture) - 1, last = cell + 2; cell <= last; ++cell)
    {
      const auto known = byMean_.find(cell);
      const std::size_t count = known == byMean_.end() ? 0 : known->second.size();
      for (std::size_t i = count > MostTried ? count - MostTried : 0; i < count; ++i)
      {
        const Leader& leader = known->second[i];
        const double square = allowed_ * allowed_;
        if (squareDifference(shares_, texture, leader.texture.data(), square) <= square)
        {
          return leader.word;
        }
      }
    }
    return -1;
  }

  void add(std::int32_t word, std::vector<float> decoded)
  {
    const long cell = cellOf(decoded.data());
    byMean_[cell].push_back({ word, std::move(decoded) });
  }

private:
  struct Leader
  {
    std::int32_t word;
    std::vector<float> texture;
  };

  [[nodiscard]] long cellOf(const float* texture) const
  {
    return std::lround(std::inner_product(shares_.begin(), shares_.end(), texture, 0.0) / allowed_);
  }

  std::vector<float> shares_;
  double allowed_;
  std::map<long, std::vector<Leader>> byMean_;
};

/// Packed textures, in whose place one that is there already is taken where it differs by no more
/// than is allowed.
Candidate packedNearEqual(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double allowed)
{
  auto packed = std::make_shared<Packed>();
  packed->rowOf = baked.rowOf;
  packed->table = packTable(copyOf(baked), packer, packed->rowOf);
  packed->textures = std::make_shared<PackedTextures>(
    packed->table.packed, packed->table.bytes.data(), static_cast<std::size_t>(packed->table.rows));
  LeaderSearch leaders(texelShares(baked.resolution), allowed);
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

  [[nodiscard]] Code pack(const float* texture) const override
  {
    const bool dark =
      std::all_of(texture, texture + texelsPerTexture(), [](float value) { return value == 0; });
    if (dark)
    {
      return packSize(texture, 0);
    }
    std::vector<float> coefficients(format_.basis.components());
    projection_.front().project(texture, coefficients.data());
    return packClass(class_, coefficients, 0);
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

/// Real spherical harmonics of the first bands, each times the deviation of its coefficient.
TextureBasis sphericalHarmonics(const Baked& baked, const std::vector<float>& sample, int bands)
{
  const std::size_t texels = texelsOf(baked);
  const std::vector<float> shares = texelShares(baked.resolution);
  std::vector<std::vector<double>> rows;
  for (int l = 0; l < bands; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      std::vector<double> row(texels);
      double norm = 0;
      for (std::size_t t = 0; t < texels; ++t)
      {
        const int side = baked.resolution;
        const double polar = M_PI * (double(int(t) / side) + 0.5) / side;
        const double azimuth = 2 * M_PI * (double(int(t) % side) + 0.5) / side;
        const double legendre = std::assoc_legendre(
          static_cast<unsigned>(l), static_cast<unsigned>(std::abs(m)), std::cos(polar));
        row[t] = legendre * (m < 0 ? std::sin(-m * azimuth) : std::cos(m * azimuth));
        norm += static_cast<double>(shares[t]) * row[t] * row[t];
      }
      double square = 0;
      for (std::size_t i = 0; i < sample.size(); i += texels)
      {
        double c = 0;
        for (std::size_t t = 0; t < texels; ++t)
        {
          c += static_cast<double>(shares[t] * sample[i + t]) * row[t] / std::sqrt(norm);
        }
        square += c * c;
      }
      const double deviation =
        std::sqrt(square * static_cast<double>(texels) / static_cast<double>(sample.size()));
      for (double& value : row)
      {
        value *= deviation / std::sqrt(norm);
      }
      rows.push_back(std::move(row));
    }
  }
  TextureBasis basis;
  basis.resolution = baked.resolution;
  double largest = 0;
  for (const auto& row : rows)
  {
    for (const double value : row)
    {
      largest = std::max(largest, std::abs(value));
    }
  }
  basis.scale = largest / 32767;
  basis.numbers.assign(texels, 0); // no mean: the first harmonic is one
  for (const auto& row : rows)
  {
    std::transform(row.begin(), row.end(), std::back_inserter(basis.numbers),
      [&](double value) { return static_cast<std::int16_t>(std::lround(value / basis.scale)); });
  }
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
    ComponentPacker(resolution, maximum, allowed, sample.values, sample.population), allowed));
  all.push_back(fourBits(baked));
  all.push_back(vectorQuantization(baked, sample.values, 256));
  all.push_back(vectorQuantization(baked, sample.values, 2048));
  for (const int bands : { 3, 4 })
  {
    all.push_back(byCoefficients(baked, "spherical harmonics, " + std::to_string(bands * bands),
      sphericalHarmonics(baked, sample.values, bands)));
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
    ComponentPacker(resolution, maximum, Error, sample.values, sample.population)));
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
  all.push_back(byPacker(baked, "**compressed**",
    ComponentPacker(baked.resolution, baked.maximum, allowed, sample.values, sample.population)));
  for (Candidate& candidate : all)
  {
    candidate.timeFrames = candidate.name == all.front().name || candidate.name[0] == '*';
  }
  return all;
}

double differenceOf(const Baked& baked, const Candidate& candidate)
{
  const std::vector<float> shares = texelShares(baked.resolution);
  std::vector<float> texture(shares.size());
  double sum = 0;
  double count = 0;
  for (std::size_t particle = 0; particle < baked.rowOf.size(); ++particle)
  {
    if (baked.mean[particle] > 0)
    {
      candidate.decode(particle, texture.data());
      const float* own = textureOf(baked, static_cast<std::size_t>(baked.rowOf[particle]));
      sum += squareDifference(shares, own, texture.data());
      ++count;
    }
  }
  return std::sqrt(sum / count);
}
}
