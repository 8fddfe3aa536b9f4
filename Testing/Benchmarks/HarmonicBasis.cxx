// SPDX-License-Identifier: BSD-3-Clause
#include "HarmonicBasis.h"

#include "TextureSizes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

namespace po
{
TextureBasis sphericalHarmonics(int resolution, const std::vector<float>& sample, int bands)
{
  const std::vector<float> shares = texelShares(resolution);
  const std::size_t texels = shares.size();
  std::vector<std::vector<double>> rows;
  for (int l = 0; l < bands; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      std::vector<double> row(texels);
      double norm = 0;
      for (std::size_t t = 0; t < texels; ++t)
      {
        const double polar = M_PI * (double(int(t) / resolution) + 0.5) / resolution;
        const double azimuth = 2 * M_PI * (double(int(t) % resolution) + 0.5) / resolution;
        const double legendre = std::assoc_legendre(
          static_cast<unsigned>(l), static_cast<unsigned>(std::abs(m)), std::cos(polar));
        row[t] = legendre * (m < 0 ? std::sin(-m * azimuth) : std::cos(m * azimuth));
        norm += static_cast<double>(shares[t]) * row[t] * row[t];
      }
      double square = 0;
      for (std::size_t i = 0; i < sample.size(); i += texels)
      {
        double c = 0;
        for (std::size_t t = 0; t < texels; ++t)
        {
          c += static_cast<double>(shares[t] * sample[i + t]) * row[t] / std::sqrt(norm);
        }
        square += c * c;
      }
      const double deviation =
        std::sqrt(square * static_cast<double>(texels) / static_cast<double>(sample.size()));
      for (double& value : row)
      {
        value *= deviation / std::sqrt(norm);
      }
      rows.push_back(std::move(row));
    }
  }
  TextureBasis basis;
  basis.resolution = resolution;
  double largest = 0;
  for (const auto& row : rows)
  {
    for (const double value : row)
    {
      largest = std::max(largest, std::abs(value));
    }
  }
  basis.scale = largest / 32767;
  basis.numbers.assign(texels, 0); // no mean: the first harmonic is one
  for (const auto& row : rows)
  {
    std::transform(row.begin(), row.end(), std::back_inserter(basis.numbers),
      [&](double value) { return static_cast<std::int16_t>(std::lround(value / basis.scale)); });
  }
  return basis;
}
}
