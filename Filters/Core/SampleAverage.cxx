// SPDX-License-Identifier: BSD-3-Clause
#include "SampleAverage.h"

#include <cmath>

namespace po
{
SamplePlace samplePlace(int n)
{
  // 1/g and 1/g^2 with g^3 = g + 1.
  constexpr double A1 = 0.7548776662466927, A2 = 0.5698402909980532;
  const auto fraction = [](double value) { return value - std::floor(value); };
  return { fraction(0.5 + n * A1), fraction(0.5 + n * A2) };
}

void SampleAverage::clear()
{
  count_ = 0;
  sums_.clear();
}

void SampleAverage::add(const std::vector<std::uint8_t>& rgba)
{
  sums_.resize(rgba.size());
  ++count_;
  for (std::size_t i = 0; i < rgba.size(); i += 4)
  {
    const std::uint32_t alpha = rgba[i + 3];
    sums_[i] += alpha * rgba[i];
    sums_[i + 1] += alpha * rgba[i + 1];
    sums_[i + 2] += alpha * rgba[i + 2];
    sums_[i + 3] += alpha;
  }
}

void SampleAverage::write(std::vector<std::uint8_t>& rgba) const
{
  rgba.resize(sums_.size());
  const auto count = static_cast<std::uint32_t>(count_);
  for (std::size_t i = 0; i < sums_.size(); i += 4)
  {
    const std::uint32_t alpha = sums_[i + 3];
    for (std::size_t c = 0; c < 3; ++c)
    {
      rgba[i + c] = alpha == 0 ? 0 : static_cast<std::uint8_t>((sums_[i + c] + alpha / 2) / alpha);
    }
    rgba[i + 3] = static_cast<std::uint8_t>((alpha + count / 2) / count);
  }
}
}
