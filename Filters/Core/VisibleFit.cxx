// SPDX-License-Identifier: BSD-3-Clause
#include "VisibleFit.h"

#include "TexelWeights.h"
#include "TextureSizes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;
using Vector = Eigen::Map<const VectorXf>;
using Matrix = Eigen::Map<const MatrixXf>;

Vector asVector(const std::vector<float>& values)
{
  return { values.data(), static_cast<Index>(values.size()) };
}

Matrix asMatrix(const std::vector<float>& values, std::size_t rows)
{
  return { values.data(), static_cast<Index>(rows), static_cast<Index>(values.size() / rows) };
}

template <typename Values>
std::vector<float> asStandard(const Values& values)
{
  return { values.data(), values.data() + values.size() };
}

float quantized(float value, std::uint8_t bits)
{
  return Quantizer::decode(Quantizer::encode(value, bits), bits);
}

/// Least squares of the first components alone: their part of the root is the root of their part.
VectorXf leastSquares(const VisibleFit::Texture& texture, Index count)
{
  const Matrix all = asMatrix(texture.root, texture.meanProducts.size());
  const auto root = all.topLeftCorner(count, count).triangularView<Eigen::Lower>();
  VectorXf solution = asVector(texture.meanProducts).head(count);
  root.solveInPlace(solution);
  root.transpose().solveInPlace(solution);
  return solution;
}
}

VisibleFit::VisibleFit(const TextureBasis& basis)
  : texels_(basis.texels())
  , floor_(texelShares(basis.resolution))
{
  for (std::size_t texel = 0; texel < texels_; ++texel)
  {
    floor_[texel] /= static_cast<float>(TexelWeights::Whole);
    mean_.push_back(basis.value(0, texel));
    for (std::size_t k = 1; k <= basis.components(); ++k)
    {
      components_.push_back(basis.value(k, texel));
    }
  }
  if (basis.components() > 0)
  {
    const Matrix components = asMatrix(components_, basis.components());
    ofFloor_ =
      asStandard(MatrixXf(components * asVector(floor_).asDiagonal() * components.transpose()));
  }
}

VisibleFit::Texture VisibleFit::prepare(const float* values, const float* weights) const
{
  const auto texels = static_cast<Index>(texels_);
  const std::size_t count = components_.size() / texels_;
  const Vector all(weights, texels);
  const VectorXf difference = Vector(values, texels) - asVector(mean_);
  Texture texture;
  texture.square = static_cast<double>(all.dot(difference.cwiseAbs2()));
  if (count == 0)
  {
    return texture;
  }
  const Matrix components = asMatrix(components_, count);
  // Mostly few texels count for more than the least: only these are summed anew.
  MatrixXf visible(components.rows(), texels);
  Index columns = 0;
  for (Index texel = 0; texel < texels; ++texel)
  {
    const float least = floor_[static_cast<std::size_t>(texel)];
    if (all[texel] > 1.001f * least)
    {
      visible.col(columns++) = std::sqrt(all[texel] - least) * components.col(texel);
    }
  }
  MatrixXf products = asMatrix(ofFloor_, count);
  products.selfadjointView<Eigen::Lower>().rankUpdate(visible.leftCols(columns));
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  texture.root = asStandard(Eigen::LLT<MatrixXf>(products).matrixLLT());
  texture.products = asStandard(products);
  texture.meanProducts = asStandard(VectorXf(components * all.cwiseProduct(difference)));
  return texture;
}

std::vector<float> VisibleFit::fit(const Texture& texture, const std::vector<std::uint8_t>& bits)
{
  constexpr std::size_t Rounds = 2; // five made codes 2 % shorter
  const auto count = static_cast<Index>(bits.size());
  const Matrix all = asMatrix(texture.products, texture.meanProducts.size());
  const auto products = all.topLeftCorner(count, count);
  VectorXf coefficients = leastSquares(texture, count);
  std::transform(
    coefficients.begin(), coefficients.end(), bits.begin(), coefficients.begin(), quantized);
  VectorXf rest = asVector(texture.meanProducts).head(count) - products * coefficients;
  for (std::size_t step = 0; step < Rounds * bits.size(); ++step)
  {
    const std::size_t i = step % bits.size();
    const auto k = static_cast<Index>(i);
    const float wanted = coefficients[k] + rest[k] / products(k, k);
    const float change = quantized(wanted, bits[i]) - coefficients[k];
    if (change != 0)
    {
      coefficients[k] += change;
      rest -= change * products.col(k);
    }
  }
  return asStandard(coefficients);
}

double VisibleFit::squareLeft(const Texture& texture, const std::vector<float>& coefficients)
{
  if (coefficients.empty())
  {
    return texture.square;
  }
  const Vector c = asVector(coefficients);
  const Matrix all = asMatrix(texture.products, texture.meanProducts.size());
  const VectorXf shown = all.topLeftCorner(c.size(), c.size()) * c;
  const float change = c.dot(shown - 2 * asVector(texture.meanProducts).head(c.size()));
  return std::max(texture.square + static_cast<double>(change), 0.0);
}
}
