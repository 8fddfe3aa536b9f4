// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SampleAverage_h
#define po_SampleAverage_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// A place in a pixel, each coordinate from 0 to 1.
struct SamplePlace
{
  double x = 0.5, y = 0.5;
};

/// Place of the n-th ray of every pixel. The first is the centre; any number of them is spread
/// evenly (the additive sequence of the plastic number, Roberts 2018: "The unreasonable
/// effectiveness of quasirandom sequences").
[[nodiscard]] SamplePlace samplePlace(int n);

/// The mean of pictures of the same view whose rays go through other places of the pixels. What a
/// pixel's rays miss makes it transparent: alpha is its covered share.
class SampleAverage
{
public:
  /// Forgets all pictures.
  void clear();

  /// RGBA bytes as shadeFrame() makes them, all of one size.
  void add(const std::vector<std::uint8_t>& rgba);

  [[nodiscard]] int count() const { return count_; }

  /// The mean, colour not multiplied by alpha.
  void write(std::vector<std::uint8_t>& rgba) const;

private:
  int count_ = 0;
  std::vector<std::uint32_t> sums_; ///< of colours times alpha, and of alphas
};
}

#endif
