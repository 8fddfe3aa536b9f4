// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SpilledTextures_h
#define po_SpilledTextures_h

#include "ScratchFile.h"
#include "TextureTable.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace po
{
/// The distinct linear textures of a bake in a temporary file, as long as the scale of their bytes
/// is not known: a TextureTable out of core. In memory are 11 to 21 bytes a texture.
///
/// Throws what ScratchFile throws.
class SpilledTextures
{
public:
  /// @param texels of a texture
  explicit SpilledTextures(std::size_t texels)
    : texels_(texels)
  {
  }

  /// The row that holds a texture, added if none with equal values is there.
  std::int32_t insert(const float* texture);

  [[nodiscard]] std::int32_t rows() const { return rows_; }
  /// 0 if there is none.
  [[nodiscard]] double largestValue() const { return largest_; }

  /// Calls visit(texture) for all of them, in the order of the rows.
  void forEach(const std::function<void(const float*)>& visit);

private:
  [[nodiscard]] const float* texture(std::int32_t row);

  std::size_t texels_;
  std::int32_t rows_ = 0;
  double largest_ = 0;
  ScratchFile file_;
  std::int32_t written_ = 0;   ///< rows in the file
  std::vector<float> waiting_; ///< the rows after them
  std::vector<float> read_;    ///< what was read last
  RowIndex index_;
};
}

#endif
