// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureMemory_h
#define po_TextureMemory_h

#include "OcclusionEstimator.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace po
{
/// Keeps the textures of a bake, as they are before dilation and encoding, so that the next bake
/// need not find all of them anew.
///
/// A bake begins with what it takes over, hands over what it has baked in the order of its list,
/// and gets all textures in order. Textures and outside shares that are not one value throughout
/// take 4 bytes a texel each.
class TextureMemory
{
public:
  using Sink = OcclusionEstimator::Sink;

  /// Upper bound.
  static constexpr double BytesPerTexel = 2 * sizeof(float);

  explicit TextureMemory(int resolution = 0);

  /// @param earlier for each texture of the bake that begins its number in the one before, none
  /// twice, or -1: it will be baked. Those that nobody takes over are forgotten.
  void begin(const std::vector<std::int32_t>& earlier);

  /// Hands `baked` on, with those that were kept and come before.
  void add(const RawTextures& baked, const Sink& sink);

  /// Hands on what was kept and comes after all that is baked.
  /// @param bakedError estimated error of what was baked
  void finish(double bakedError, const Sink& sink);

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] std::size_t reused() const { return reused_; } ///< of the last bake
  [[nodiscard]] double bytes() const;                          ///< of all textures

  /// Of all textures: the RMS of the errors of the bakes that they are from.
  [[nodiscard]] double estimatedError() const { return error_; }

private:
  /// Texels of a texture: in a slot, or all one value.
  struct Texels
  {
    std::int32_t slot = -1;
    float value = 0;
  };

  struct Entry
  {
    Texels values, shares;
    bool isKept = false;
  };

  [[nodiscard]] Texels keep(const float* texels);
  void release(const Texels& texels);
  [[nodiscard]] float* slot(std::int32_t number);
  [[nodiscard]] const float* expand(const Texels& texels, std::vector<float>& buffer);
  void handKept(const Sink& sink);

  std::size_t texels_;
  std::vector<Entry> entries_;
  std::vector<std::unique_ptr<float[]>> blocks_; ///< of slots
  std::vector<std::int32_t> free_;               ///< slots
  std::vector<float> values_, shares_;           ///< of one texture
  std::size_t next_ = 0;                         ///< to be handed on
  std::size_t reused_ = 0;
  double error_ = 0;
};
}

#endif
