// SPDX-License-Identifier: BSD-3-Clause
#include "TextureStore.h"

#include "ComponentPacker.h"
#include "TexturePacker.h"
#include "TextureSample.h"

#include <cmath>
#include <utility>

namespace po
{
namespace
{
double noiseOfAll(double own, std::size_t particles, const ProcessGroup& group)
{
  constexpr double StepsPerUnit = 1000;
  const auto weight = static_cast<double>(particles);
  const double squares = group.sum(weight * own * own);
  const double weights = group.sum(weight);
  return weights > 0 ? std::floor(StepsPerUnit * std::sqrt(squares / weights)) / StepsPerUnit : 0;
}

EncodedTable compress(TextureTable&& table, double maximum, double allowed,
  const ProcessGroup& group, std::vector<std::int32_t>& rowOf)
{
  // Below 1024 samples of 16 x 16 texels, noise of the sample gets into the basis. More texels
  // make products of samples, whose time grows with their third power.
  constexpr std::size_t ManySamples = 4096, FewSamples = 1024, ManyTexels = 1024;
  const std::size_t most = table.texelsPerRow() < ManyTexels ? ManySamples : FewSamples;
  const TextureSample sample = sampleTextures(table, most, group);
  const ComponentPacker packer(table.resolution(), maximum, allowed, sample);
  return packTable(std::move(table), packer, rowOf);
}
}

EncodedTable storeTextures(TextureTable&& table, const BakeSettings& settings, double maximum,
  double noise, const ProcessGroup& group, std::vector<std::int32_t>& rowOf)
{
  if (settings.storage == Storage::Full || settings.storage == Storage::OneValue)
  {
    EncodedTable encoded = encode(std::move(table), settings.encoding, rowOf, maximum);
    encoded.storage = settings.storage;
    return encoded;
  }
  const double allowed =
    allowedDifference(settings.storageError, noiseOfAll(noise, rowOf.size(), group));
  EncodedTable packed = settings.storage == Storage::VariableSize
    ? packTable(std::move(table), SizePacker(settings.textureResolution, maximum, allowed), rowOf)
    : compress(std::move(table), maximum, allowed, group, rowOf);
  packed.storage = settings.storage;
  return packed;
}
}
