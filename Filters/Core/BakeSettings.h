// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeSettings_h
#define po_BakeSettings_h

#include "Background.h"

#include <cstdint>
#include <optional>

namespace po
{
/// How the texels of a table are stored.
enum class Encoding
{
  UInt8Gamma2 = 0, ///< byte = round(255 sqrt(value / maximum)), maximum = the table's largest value
  Float32Linear = 1, ///< the value itself
};

/// How much of each texture is stored.
enum class Storage
{
  Full = 0,         ///< T x T texels
  VariableSize = 1, ///< the fewest texels that keep to an error, see SizePacker
  Compressed = 2,   ///< coefficients in a common basis, see ComponentPacker
  OneValue = 3,     ///< the particle's mean alone
};

/// One light that is infinitely far away, with hard shadows.
struct DistantLight
{
  Vec3d direction{ 1, -1, -1 }; ///< along which it shines, in the world; any length but zero
  /// What a surface that faces it receives, where an open one receives 1 of the uniform background;
  /// at least 0.
  double intensity = 1;
};

/// What a bake is asked for. Lengths are in the units of the input data.
struct BakeSettings
{
  static constexpr int MaximumTextureResolution = 64;
  static constexpr int MaximumSamplesPerTexel = 1 << 20;

  int textureResolution = 16;    ///< T: a texture has T x T texels, 1 to 64
  int samplesPerTexel = 49;      ///< the quality that this many jittered rays give, 1 to 2^20
  double maximumDistance = 0;    ///< rays end there; 0 = unbounded
  bool dilateInside = true;      ///< fill texels inside other spheres from their neighbours
  double insideThreshold = 0.05; ///< a texel with a smaller outside share is inside, 0 to 1
  Encoding encoding = Encoding::UInt8Gamma2;
  Storage storage = Storage::Full;
  double storageError = 0.01; ///< what VariableSize and Compressed may add to the RMS error, 0 to 1
  std::uint64_t seed = 1;
  Background background = UniformBackground{};
  std::optional<DistantLight> light; ///< is baked too, see BakedLight
};
}

#endif
