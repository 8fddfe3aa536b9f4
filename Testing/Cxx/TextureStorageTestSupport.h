// SPDX-License-Identifier: BSD-3-Clause
/// Textures to store, and both forms of them.
#ifndef TextureStorageTestSupport_h
#define TextureStorageTestSupport_h

#include "PackedTextures.h"
#include "Random.h"
#include "TexelMap.h"
#include "TextureSizes.h"
#include "TextureStore.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace storage_test
{
using namespace po;

/// Of the values of textures; the scale of their bytes.
constexpr double Maximum = 1.2;

/// What a point of the sphere shows.
using Shape = std::function<double(Vec3d)>;

inline std::vector<float> textureOf(int resolution, const Shape& shape)
{
  std::vector<float> texture;
  for (int row = 0; row < resolution; ++row)
  {
    for (int column = 0; column < resolution; ++column)
    {
      const Vec3d point =
        textureDirection({ (column + 0.5) / resolution, (row + 0.5) / resolution });
      texture.push_back(static_cast<float>(std::clamp(shape(point), 0.0, Maximum)));
    }
  }
  return texture;
}

inline Vec3d anyDirection(Random& random)
{
  const double z = 2 * random.uniform() - 1;
  return textureDirection({ random.uniform(), std::acos(z) / M_PI });
}

/// Some hundred textures: dark, open, of one value, smooth, and with spots of any sharpness.
inline TextureTable someTextures(int resolution, std::vector<std::int32_t>& rowOf, int count = 600)
{
  TextureTable table(resolution, static_cast<std::size_t>(count));
  Random random(3, 0, 0);
  rowOf.clear();
  for (int i = 0; i < count; ++i)
  {
    const Vec3d up = anyDirection(random), spot = anyDirection(random);
    const double base = random.uniform(), slope = 0.5 * random.uniform();
    const double width = 0.02 + random.uniform(), noise = i % 5 == 0 ? 0.2 : 0.0;
    const auto shape = [&](Vec3d p)
    {
      const double far = std::acos(std::clamp(dot(p, spot), -1.0, 1.0));
      return base + slope * dot(p, up) - 0.5 * std::exp(-far * far / width) +
        noise * (random.uniform() - 0.5);
    };
    const bool flat = i % 10 < 2;
    rowOf.push_back(table.insert(
      textureOf(resolution, flat ? Shape([&](Vec3d) { return i % 10 * 1.0; }) : Shape(shape))
        .data()));
  }
  rowOf.push_back(-1); // a particle without a texture
  return table;
}

inline TextureTable copyOf(const TextureTable& table)
{
  TextureTable copy(table.resolution(), 0);
  for (std::int32_t row = 0; row < table.rows(); ++row)
  {
    copy.insert(table.values().data() + static_cast<std::size_t>(row) * table.texelsPerRow());
  }
  return copy;
}

/// RMS difference over the sphere.
inline double difference(int resolution, const float* a, const float* b)
{
  const std::vector<float> shares = texelShares(resolution);
  double sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    sum += static_cast<double>(shares[i] * (a[i] - b[i]) * (a[i] - b[i]));
  }
  return std::sqrt(sum);
}

/// A table in both forms.
struct Stored
{
  Stored(int resolution, Storage storage, double error, double noise = 0)
    : full(someTextures(resolution, rowOf))
  {
    BakeSettings settings;
    settings.textureResolution = resolution;
    settings.storage = storage;
    settings.storageError = error;
    packedRows = rowOf;
    table =
      storeTextures(copyOf(full), settings, Maximum, noise, ProcessGroup::alone(), packedRows);
    packed = std::make_shared<PackedTextures>(
      table.packed, table.bytes.data(), static_cast<std::size_t>(table.rows));
  }

  /// Of each particle with a texture, by reading the packed one.
  [[nodiscard]] std::vector<double> differences() const
  {
    std::vector<double> all;
    std::vector<float> shown(full.texelsPerRow());
    for (std::size_t i = 0; i < rowOf.size(); ++i)
    {
      if (rowOf[i] >= 0)
      {
        packed->decode(static_cast<std::size_t>(packedRows[i]), shown.data());
        all.push_back(difference(full.resolution(), textureAt(i), shown.data()));
      }
    }
    return all;
  }

  [[nodiscard]] const float* textureAt(std::size_t particle) const
  {
    return full.values().data() + static_cast<std::size_t>(rowOf[particle]) * full.texelsPerRow();
  }

  std::vector<std::int32_t> rowOf, packedRows;
  TextureTable full;
  EncodedTable table;
  std::shared_ptr<const PackedTextures> packed;
};

inline double rmsOf(const std::vector<double>& differences)
{
  double sum = 0;
  for (const double d : differences)
  {
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(differences.size()));
}
}

#endif
