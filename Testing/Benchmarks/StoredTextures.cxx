// SPDX-License-Identifier: BSD-3-Clause
#include "StoredTextures.h"

namespace po
{
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
}
