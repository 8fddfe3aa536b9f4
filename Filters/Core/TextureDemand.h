// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureDemand_h
#define po_TextureDemand_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
class OcclusionTextures;
struct TracedFrame;

/// Tells which textures a frame shows.
class TextureDemand
{
public:
  /// Rows of the textures, those of most pixels first, then by row; valid until the next call.
  /// @param particles of each sphere, see SphereCloud::sourceIds
  /// @param textureCount above all rows
  [[nodiscard]] const std::vector<std::int32_t>& of(const TracedFrame& frame,
    const std::vector<std::int64_t>& particles, const OcclusionTextures& textures,
    std::size_t textureCount);

private:
  struct Seen
  {
    std::int32_t row;
    std::uint32_t pixels;
  };

  [[nodiscard]] Seen& entryOf(std::int32_t row);
  void count(const TracedFrame& frame, const std::vector<std::int64_t>& particles,
    const OcclusionTextures& textures);

  std::vector<Seen> seen_;
  std::vector<std::uint32_t> placeOf_; ///< of each row in seen_, if that is of the same row
  std::vector<std::int32_t> rows_;
};
}

#endif
