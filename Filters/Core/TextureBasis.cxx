// SPDX-License-Identifier: BSD-3-Clause
#include "TextureBasis.h"

#include "TextureSizes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace po
{
namespace
{
using Matrix = Eigen::MatrixXd;

/// One texture a column, times the roots of the texels' shares, so that plain products are
/// area-weighted.
Matrix weightedSamples(const std::vector<float>& shares, const std::vector<float>& samples)
{
  const auto texels = static_cast<Eigen::Index>(shares.size());
  const auto count = static_cast<Eigen::Index>(samples.size()) / texels;
  const Eigen::VectorXd roots =
    Eigen::Map<const Eigen::VectorXf>(shares.data(), texels).cast<double>().cwiseSqrt();
  return roots.asDiagonal() *
    Eigen::Map<const Eigen::MatrixXf>(samples.data(), texels, count).cast<double>();
}

/// The principal components of centred columns, times their standard deviations, by falling
/// variance.
Matrix scaledComponents(const Matrix& centred, Eigen::Index most)
{
  const auto count = static_cast<double>(centred.cols());
  const bool bySamples = centred.cols() < centred.rows();
  // With fewer samples than texels, of the samples' products among each other ("method of
  // snapshots", Sirovich 1987).
  const Matrix products =
    bySamples ? Matrix(centred.transpose() * centred) : Matrix(centred * centred.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(products / count);
  const Eigen::VectorXd variances = solver.eigenvalues().reverse().cwiseMax(0.0);
  const double least = 1e-12 * variances.sum();
  most = std::min(most, (variances.array() > least).count());
  const Matrix vectors = solver.eigenvectors().rowwise().reverse().leftCols(most);
  return bySamples ? Matrix(centred * vectors / std::sqrt(count))
                   : Matrix(vectors * variances.head(most).cwiseSqrt().asDiagonal());
}
}

TextureBasis principalComponents(
  int resolution, const std::vector<float>& samples, std::size_t most)
{
  const std::vector<float> shares = texelShares(resolution);
  Matrix textures = weightedSamples(shares, samples);
  const Eigen::VectorXd mean = textures.rowwise().mean();
  textures.colwise() -= mean;
  Matrix rows(textures.rows(), 1);
  rows.col(0) = mean;
  const Matrix components = scaledComponents(textures, static_cast<Eigen::Index>(most));
  rows.conservativeResize(Eigen::NoChange, 1 + components.cols());
  rows.rightCols(components.cols()) = components;
  const auto texels = static_cast<Eigen::Index>(shares.size());
  rows = Eigen::Map<const Eigen::VectorXf>(shares.data(), texels)
           .cast<double>()
           .cwiseSqrt()
           .cwiseInverse()
           .asDiagonal() *
    rows;

  TextureBasis basis;
  basis.resolution = resolution;
  basis.scale = std::max(rows.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min()) /
    std::numeric_limits<std::int16_t>::max();
  basis.numbers.resize(static_cast<std::size_t>(rows.size()));
  std::transform(rows.data(), rows.data() + rows.size(), basis.numbers.begin(),
    [&](double value) { return static_cast<std::int16_t>(std::lround(value / basis.scale)); });
  return basis;
}

TextureProjection::TextureProjection(const TextureBasis& basis)
  : components_(basis.components())
  , mean_(basis.texels())
  , shares_(texelShares(basis.resolution))
  , weights_(basis.texels() * components_)
  , variances_(components_, 0.0)
{
  for (std::size_t texel = 0; texel < basis.texels(); ++texel)
  {
    mean_[texel] = basis.value(0, texel);
    for (std::size_t k = 0; k < components_; ++k)
    {
      const float value = basis.value(1 + k, texel);
      weights_[texel * components_ + k] = shares_[texel] * value;
      variances_[k] += static_cast<double>(shares_[texel]) * value * value;
    }
  }
  for (std::size_t i = 0; i < weights_.size(); ++i)
  {
    const double variance = variances_[i % components_];
    weights_[i] = variance > 0 ? static_cast<float>(weights_[i] / variance) : 0.0f;
  }
}

double TextureProjection::project(const float* texture, float* coefficients) const
{
  std::fill_n(coefficients, components_, 0.0f);
  double square = 0;
  for (std::size_t texel = 0; texel < mean_.size(); ++texel)
  {
    const float difference = texture[texel] - mean_[texel];
    square += static_cast<double>(shares_[texel] * difference * difference);
    const float* weights = weights_.data() + texel * components_;
    for (std::size_t k = 0; k < components_; ++k)
    {
      coefficients[k] += difference * weights[k];
    }
  }
  return square;
}

std::uint32_t Quantizer::encode(float value, int bits)
{
  if (bits == 0)
  {
    return 0;
  }
  const double levels = 1u << bits;
  const double code =
    std::floor(static_cast<double>(value) / Steps[static_cast<std::size_t>(bits)] + levels / 2);
  return static_cast<std::uint32_t>(std::clamp(code, 0.0, levels - 1));
}

float Quantizer::decode(std::uint32_t code, int bits)
{
  const double middle = bits == 0 ? 0.0 : 0.5 * (1u << bits) - 0.5;
  return static_cast<float>((code - middle) * Steps[static_cast<std::size_t>(bits)]);
}

std::vector<std::uint8_t> shareBits(const std::vector<double>& variances, int bits)
{
  std::vector<std::uint8_t> shares(variances.size(), 0);
  const auto gain = [&](std::size_t k)
  {
    const std::size_t b = shares[k];
    return b < Quantizer::MaximumBits
      ? variances[k] * (Quantizer::Errors[b] - Quantizer::Errors[b + 1])
      : 0.0;
  };
  std::vector<double> gains(variances.size());
  for (std::size_t k = 0; k < gains.size(); ++k)
  {
    gains[k] = gain(k);
  }
  for (; bits > 0 && !gains.empty(); --bits)
  {
    const auto best =
      static_cast<std::size_t>(std::max_element(gains.begin(), gains.end()) - gains.begin());
    if (!(gains[best] > 0))
    {
      break;
    }
    ++shares[best];
    gains[best] = gain(best);
  }
  while (!shares.empty() && shares.back() == 0)
  {
    shares.pop_back();
  }
  return shares;
}
}
