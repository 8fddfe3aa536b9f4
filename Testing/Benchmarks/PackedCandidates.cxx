// SPDX-License-Identifier: BSD-3-Clause
#include "PackedCandidates.h"

#include "LeaderSearch.h"
#include "TextureSizes.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace po
{
namespace
{
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

/// In the place of each texture one that is there already where it differs by no more than is
/// allowed. Returns the words that are still used.
std::set<std::int32_t> shareNearEqual(const Baked& baked, Packed& packed, double allowed)
{
  constexpr std::size_t MostTried = 500;
  LeaderSearch leaders(texelShares(baked.resolution), allowed, MostTried);
  std::map<std::int32_t, std::int32_t> wordOfRow;
  std::set<std::int32_t> kept;
  for (std::size_t particle = 0; particle < packed.rowOf.size(); ++particle)
  {
    const auto [known, isNew] = wordOfRow.try_emplace(baked.rowOf[particle], -1);
    if (isNew)
    {
      const float* texture = textureOf(baked, static_cast<std::size_t>(known->first));
      known->second = leaders.find(texture);
    }
    if (known->second < 0)
    {
      known->second = packed.rowOf[particle];
      std::vector<float> decoded(texelsOf(baked));
      packed.textures->decode(static_cast<std::size_t>(known->second), decoded.data());
      leaders.add(known->second, std::move(decoded));
    }
    packed.rowOf[particle] = known->second;
    kept.insert(known->second);
  }
  return kept;
}

double bytesOf(const Packed& packed, const std::set<std::int32_t>& words)
{
  double bytes = IndexBytes * static_cast<double>(packed.rowOf.size()) +
    static_cast<double>(sizeof(std::int16_t) * packed.table.packed.basis.numbers.size());
  for (const std::int32_t word : words)
  {
    bytes += static_cast<double>(
      PackedFormat::WordBytes * packed.textures->lengthAt(static_cast<std::size_t>(word)));
  }
  return bytes;
}

std::function<void(std::size_t, float*)> decoderOf(const std::shared_ptr<Packed>& packed)
{
  return [packed](std::size_t particle, float* texture)
  { packed->textures->decode(static_cast<std::size_t>(packed->rowOf[particle]), texture); };
}

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
}

FixedPacker::FixedPacker(
  const Baked& baked, TextureBasis basis, std::size_t c, std::vector<std::uint8_t> bits)
  : TexturePacker(baked.resolution, baked.maximum)
  , class_(c)
{
  format_.basis = std::move(basis);
  format_.classBits.resize(c + 1);
  format_.classBits[c] = std::move(bits);
  projection_.emplace_back(format_.basis);
}

TexturePacker::Code FixedPacker::pack(const WeighedTexture& texture) const
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

Candidate byPacker(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double size)
{
  const std::shared_ptr<Packed> packed = packWith(baked, packer);
  Candidate candidate;
  candidate.name = name;
  candidate.bytes = (size < 0 ? static_cast<double>(packed->table.size()) : size) +
    IndexBytes * static_cast<double>(baked.rowOf.size());
  candidate.textures = std::make_shared<OcclusionTextures>(
    packed->textures, baked.resolution, packed->rowOf.data(), nullptr);
  candidate.decode = decoderOf(packed);
  return candidate;
}

Candidate packedNearEqual(
  const Baked& baked, const std::string& name, const TexturePacker& packer, double allowed)
{
  const std::shared_ptr<Packed> packed = packWith(baked, packer);
  const std::set<std::int32_t> kept = shareNearEqual(baked, *packed, allowed);
  Candidate candidate;
  candidate.name = name;
  candidate.bytes = bytesOf(*packed, kept);
  candidate.decode = decoderOf(packed);
  return candidate;
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
}
