// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ComponentPacker_h
#define po_ComponentPacker_h

#include "TexturePacker.h"

#include <array>
#include <cstddef>
#include <vector>

namespace po
{
/// Each texture as coefficients of a basis, as one value, or as it is: so that the differences of
/// all have the allowed RMS at the fewest bytes, and none is above LargestDifference times that.
///
/// A packer is made from a sample of the textures, and then packs each by itself.
class ComponentPacker : public TexturePacker
{
public:
  static constexpr double LargestDifference = 3;

  /// @param sample textures of T * T values, may be empty
  /// @param population how many textures will share the basis, which takes memory too
  ComponentPacker(int resolution, double maximum, double allowed, const std::vector<float>& sample,
    double population);

  [[nodiscard]] Code pack(const float* texture) const override;

private:
  /// Ways to store a texture: one value, each class of coefficients, all texels.
  static constexpr std::size_t Ways = PackedFormat::ClassWords.size() + 2;
  static constexpr std::size_t OneValue = 0;
  static constexpr std::size_t AllTexels = Ways - 1;
  using Errors = std::array<double, Ways>; ///< mean square over the sphere

  /// What is known of a texture before its bits are shared out.
  struct Projected
  {
    std::vector<float> coefficients;
    double square = 0;                  ///< mean square difference from the mean texture
    double oneValue = 0, allTexels = 0; ///< mean square errors
  };

  /// What a number of components comes to.
  struct Plan
  {
    std::vector<std::vector<std::uint8_t>> classBits;
    double pricePerWord = 0;
    double bytes = 0; ///< of all textures and the basis
  };

  [[nodiscard]] Projected project(const TextureProjection& projection, const float* texture) const;
  [[nodiscard]] static Errors errorsOf(const Projected& texture,
    const std::vector<double>& variances, const std::vector<std::vector<std::uint8_t>>& classBits);
  [[nodiscard]] std::size_t cheapest(const Errors& errors, double pricePerWord) const;
  [[nodiscard]] Plan planFor(std::size_t components, const std::vector<Projected>& sample,
    const std::vector<double>& variances, double population) const;
  [[nodiscard]] double priceFor(const std::vector<Errors>& sample) const;
  void choose(const std::vector<float>& sample, double population);

  double allowed_;
  std::array<std::size_t, Ways> words_{};
  std::vector<TextureProjection> projection_; ///< one; none if there was no sample
  double pricePerWord_ = 0;                   ///< mean square error that a word must save
};
}

#endif
