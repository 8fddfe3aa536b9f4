// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ComponentPacker_h
#define po_ComponentPacker_h

#include "TexturePacker.h"
#include "TextureSample.h"
#include "VisibleFit.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
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

  /// @param sample of the textures, may be empty; as many as there are share the basis, which takes
  /// memory too
  ComponentPacker(int resolution, double maximum, double allowed, const TextureSample& sample);

  [[nodiscard]] Code pack(const WeighedTexture& texture) const override;

private:
  /// Ways to store a texture: one value, each class of coefficients, all texels.
  static constexpr std::size_t Ways = PackedFormat::ClassWords.size() + 2;
  static constexpr std::size_t OneValue = 0;
  static constexpr std::size_t AllTexels = Ways - 1;

  /// What each way leaves of a texture.
  struct Errors
  {
    std::array<double, Ways> squares{}; ///< integrated over what is visible
    double area = 1;                    ///< that is visible, as a share of the sphere
  };

  /// What is known of a texture before its bits are shared out.
  struct Prepared
  {
    std::vector<float> coefficients;         ///< of a whole particle's
    double square = 0;                       ///< its mean square difference from the mean texture
    std::optional<VisibleFit::Texture> part; ///< of one that is not whole
    double oneValue = 0, allTexels = 0;      ///< square errors
    double area = 1;
  };

  /// A basis, ready for textures.
  struct Basis
  {
    explicit Basis(const TextureBasis& basis)
      : projection(basis)
      , fit(basis)
    {
    }

    TextureProjection projection; ///< for those of whole particles
    VisibleFit fit;               ///< for the others
  };

  /// What a number of components comes to.
  struct Plan
  {
    std::vector<std::vector<std::uint8_t>> classBits;
    double pricePerWord = 0;
    double bytes = 0; ///< of all textures and the basis
  };

  using ClassBits = std::vector<std::vector<std::uint8_t>>;

  [[nodiscard]] Prepared prepare(const Basis& basis, const WeighedTexture& texture) const;
  [[nodiscard]] static double squareLeft(
    const Basis& basis, const Prepared& texture, const ClassBits& classBits, std::size_t way);
  [[nodiscard]] static Errors errorsOf(
    const Basis& basis, const Prepared& texture, const ClassBits& classBits);
  using SquareOf = std::function<double(std::size_t way)>;
  [[nodiscard]] std::size_t cheapest(
    const SquareOf& squareOf, double area, double pricePerWord) const;
  [[nodiscard]] std::size_t cheapest(const Errors& errors, double pricePerWord) const
  {
    return cheapest(
      [&](std::size_t way) { return errors.squares[way]; }, errors.area, pricePerWord);
  }
  [[nodiscard]] Plan planFor(std::size_t components, const Basis& basis,
    const std::vector<Prepared>& sample, double population) const;
  [[nodiscard]] double priceFor(const std::vector<Errors>& sample) const;
  void choose(const TextureSample& sample);

  double allowed_;
  std::array<std::size_t, Ways> words_{};
  std::optional<Basis> basis_; ///< none if there was no sample
  double pricePerWord_ = 0;    ///< square error that a word must save
};
}

#endif
