// SPDX-License-Identifier: BSD-3-Clause
#include "ComponentPacker.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace po
{
namespace
{
constexpr std::size_t WordBytes = PackedFormat::WordBytes;

/// What coefficients of so many bits leave of a texture's difference from the mean.
double errorLeft(double square, const std::vector<float>& coefficients,
  const std::vector<double>& variances, const std::vector<std::uint8_t>& bits)
{
  for (std::size_t k = 0; k < bits.size(); ++k)
  {
    if (bits[k] > 0)
    {
      const float c = coefficients[k];
      const float rest = c - Quantizer::decode(Quantizer::encode(c, bits[k]), bits[k]);
      square -= variances[k] * static_cast<double>(c * c - rest * rest);
    }
  }
  return std::max(square, 0.0);
}
}

ComponentPacker::ComponentPacker(int resolution, double maximum, double allowed,
  const std::vector<float>& sample, double population)
  : TexturePacker(resolution, maximum)
  , allowed_(allowed)
{
  words_[OneValue] = PackedFormat::sizeWords(1);
  std::copy(PackedFormat::ClassWords.begin(), PackedFormat::ClassWords.end(), words_.begin() + 1);
  words_[AllTexels] = PackedFormat::sizeWords(resolution);
  if (!sample.empty())
  {
    choose(sample, population);
  }
}

ComponentPacker::Projected ComponentPacker::project(
  const TextureProjection& projection, const float* texture) const
{
  Projected projected;
  projected.coefficients.resize(projection.variances().size());
  projected.square = projection.project(texture, projected.coefficients.data());
  projected.oneValue = packSize(texture, 0).squareError;
  projected.allTexels = packSize(texture, sizes() - 1).squareError;
  return projected;
}

ComponentPacker::Errors ComponentPacker::errorsOf(const Projected& texture,
  const std::vector<double>& variances, const std::vector<std::vector<std::uint8_t>>& classBits)
{
  Errors errors;
  errors[OneValue] = texture.oneValue;
  errors[AllTexels] = texture.allTexels;
  for (std::size_t c = 0; c < classBits.size(); ++c)
  {
    errors[1 + c] = errorLeft(texture.square, texture.coefficients, variances, classBits[c]);
  }
  return errors;
}

/// The way with the least error and price together, among those below the largest difference.
std::size_t ComponentPacker::cheapest(const Errors& errors, double pricePerWord) const
{
  const double largest = LargestDifference * LargestDifference * allowed_ * allowed_;
  std::size_t best = AllTexels;
  double least = errors[AllTexels] + pricePerWord * static_cast<double>(words_[AllTexels]);
  for (std::size_t way = 0; way < AllTexels; ++way)
  {
    const double cost = errors[way] + pricePerWord * static_cast<double>(words_[way]);
    if (errors[way] <= largest && cost < least)
    {
      best = way;
      least = cost;
    }
  }
  return best;
}

/// The highest price at which the textures of the sample keep to the allowed RMS: of all ways to
/// choose, that is the one with the fewest words (Lagrange; Shoham & Gersho 1988).
double ComponentPacker::priceFor(const std::vector<Errors>& sample) const
{
  // A sample of some thousands tells the RMS of all to about 1 %.
  constexpr double Margin = 0.97;
  const double aim = Margin * Margin * allowed_ * allowed_ * static_cast<double>(sample.size());
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step)
  {
    const double price = low > 0 ? std::sqrt(low * high) : high * 1e-3;
    double sum = 0;
    for (const Errors& errors : sample)
    {
      sum += errors[cheapest(errors, price)];
    }
    (sum <= aim ? low : high) = price;
    if (high < 1e-15)
    {
      break;
    }
  }
  return low;
}

ComponentPacker::Plan ComponentPacker::planFor(std::size_t components,
  const std::vector<Projected>& sample, const std::vector<double>& variances,
  double population) const
{
  const auto last =
    variances.begin() + static_cast<std::ptrdiff_t>(std::min(components, variances.size()));
  Plan plan;
  std::size_t used = 0;
  for (const std::size_t words : PackedFormat::ClassWords)
  {
    plan.classBits.push_back(
      shareBits({ variances.begin(), last }, PackedFormat::classBitCount(words)));
    used = std::max(used, plan.classBits.back().size());
  }
  std::vector<Errors> errors;
  for (const Projected& texture : sample)
  {
    errors.push_back(errorsOf(texture, variances, plan.classBits));
  }
  plan.pricePerWord = priceFor(errors);
  double words = 0;
  for (const Errors& e : errors)
  {
    words += static_cast<double>(words_[cheapest(e, plan.pricePerWord)]);
  }
  plan.bytes = WordBytes * words * population / static_cast<double>(sample.size()) +
    static_cast<double>(sizeof(std::int16_t) * (1 + used) * format_.basis.texels());
  return plan;
}

void ComponentPacker::choose(const std::vector<float>& sample, double population)
{
  constexpr std::size_t MostComponents = 128;
  format_.basis = principalComponents(format_.resolution, sample, MostComponents);
  const TextureProjection projection(format_.basis);
  const std::size_t texels = format_.basis.texels();
  std::vector<Projected> projected(sample.size() / texels);
  tbb::parallel_for(std::size_t(0), projected.size(),
    [&](std::size_t i) { projected[i] = project(projection, sample.data() + i * texels); });

  Plan best;
  best.bytes = std::numeric_limits<double>::infinity();
  for (std::size_t components = MostComponents; components >= 4; components /= 2)
  {
    Plan plan = planFor(components, projected, projection.variances(), population);
    if (plan.bytes < best.bytes)
    {
      best = std::move(plan);
    }
  }
  format_.classBits = std::move(best.classBits);
  pricePerWord_ = best.pricePerWord;
  std::size_t used = 0;
  for (const auto& bits : format_.classBits)
  {
    used = std::max(used, bits.size());
  }
  format_.basis.numbers.resize((1 + used) * texels);
  projection_.emplace_back(format_.basis);
}

TexturePacker::Code ComponentPacker::pack(const float* texture) const
{
  Code oneValue = packSize(texture, 0);
  const bool isOneValue = std::all_of(
    texture, texture + texelsPerTexture(), [&](float value) { return value == texture[0]; });
  if (projection_.empty() || isOneValue)
  {
    return oneValue;
  }
  const Projected projected = project(projection_.front(), texture);
  const Errors errors = errorsOf(projected, projection_.front().variances(), format_.classBits);
  const std::size_t way = cheapest(errors, pricePerWord_);
  if (way == OneValue)
  {
    return oneValue;
  }
  return way == AllTexels ? packSize(texture, sizes() - 1)
                          : packClass(way - 1, projected.coefficients, errors[way]);
}
}
