// SPDX-License-Identifier: BSD-3-Clause
#include "ComponentPacker.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

ComponentPacker::ComponentPacker(
  int resolution, double maximum, double allowed, const TextureSample& sample)
  : TexturePacker(resolution, maximum)
  , allowed_(allowed)
{
  words_[OneValue] = PackedFormat::sizeWords(1);
  std::copy(PackedFormat::ClassWords.begin(), PackedFormat::ClassWords.end(), words_.begin() + 1);
  words_[AllTexels] = PackedFormat::sizeWords(resolution);
  if (!sample.values.empty())
  {
    choose(sample);
  }
}

ComponentPacker::Prepared ComponentPacker::prepare(
  const Basis& basis, const WeighedTexture& texture) const
{
  std::vector<float> weights;
  const Area area = areaOf(texture, weights);
  Prepared prepared;
  prepared.area = area.sum;
  prepared.oneValue = packSize(texture.values, area, 0).squareError;
  prepared.allTexels = packSize(texture.values, area, sizes() - 1).squareError;
  if (texture.weights)
  {
    prepared.part = basis.fit.prepare(texture.values, area.weights);
    return prepared;
  }
  prepared.coefficients.resize(basis.projection.variances().size());
  prepared.square = basis.projection.project(texture.values, prepared.coefficients.data());
  return prepared;
}

double ComponentPacker::squareLeft(
  const Basis& basis, const Prepared& texture, const ClassBits& classBits, std::size_t way)
{
  if (way == OneValue || way == AllTexels)
  {
    return way == OneValue ? texture.oneValue : texture.allTexels;
  }
  const std::vector<std::uint8_t>& bits = classBits[way - 1];
  return texture.part
    ? VisibleFit::squareLeft(*texture.part, VisibleFit::fit(*texture.part, bits))
    : errorLeft(texture.square, texture.coefficients, basis.projection.variances(), bits);
}

ComponentPacker::Errors ComponentPacker::errorsOf(
  const Basis& basis, const Prepared& texture, const ClassBits& classBits)
{
  Errors errors;
  errors.area = texture.area;
  for (std::size_t way = 0; way < Ways; ++way)
  {
    errors.squares[way] = squareLeft(basis, texture, classBits, way);
  }
  return errors;
}

/// The way with the least error and price together, among those below the largest difference.
std::size_t ComponentPacker::cheapest(
  const SquareOf& squareOf, double area, double pricePerWord) const
{
  const double largest = LargestDifference * LargestDifference * allowed_ * allowed_ * area;
  const auto priceOf = [&](std::size_t way)
  { return pricePerWord * static_cast<double>(words_[way]); };
  std::size_t best = AllTexels;
  double least = squareOf(AllTexels) + priceOf(AllTexels);
  // Ways get longer and longer.
  for (std::size_t way = 0; way < AllTexels && priceOf(way) < least; ++way)
  {
    const double square = squareOf(way);
    if (square <= largest && square + priceOf(way) < least)
    {
      best = way;
      least = square + priceOf(way);
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
  const double area = std::accumulate(sample.begin(), sample.end(), 0.0,
    [](double sum, const Errors& errors) { return sum + errors.area; });
  const double aim = Margin * Margin * allowed_ * allowed_ * area;
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step)
  {
    const double price = low > 0 ? std::sqrt(low * high) : high * 1e-3;
    double sum = 0;
    for (const Errors& errors : sample)
    {
      sum += errors.squares[cheapest(errors, price)];
    }
    (sum <= aim ? low : high) = price;
    if (high < 1e-15)
    {
      break;
    }
  }
  return low;
}

ComponentPacker::Plan ComponentPacker::planFor(std::size_t components, const Basis& basis,
  const std::vector<Prepared>& sample, double population) const
{
  const std::vector<double>& variances = basis.projection.variances();
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
  std::vector<Errors> errors(sample.size());
  tbb::parallel_for(std::size_t(0), sample.size(),
    [&](std::size_t i) { errors[i] = errorsOf(basis, sample[i], plan.classBits); });
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

void ComponentPacker::choose(const TextureSample& sample)
{
  const std::size_t texels = texelsPerTexture();
  // Fits to a part take time with the square of the components.
  constexpr std::size_t MostComponents = 128, MostFitted = 64, MostPlanned = 1024;
  const bool areWhole = sample.isWhole();
  const std::size_t most = areWhole ? MostComponents : MostFitted;
  format_.basis = principalComponents(format_.resolution, sample.values, most);
  const Basis basis(format_.basis);
  // Of a sample that is random any part is random.
  const std::size_t count = sample.size(texels);
  std::vector<Prepared> prepared(areWhole ? count : std::min(count, MostPlanned));
  tbb::parallel_for(std::size_t(0), prepared.size(),
    [&](std::size_t i) { prepared[i] = prepare(basis, sample.texture(i, texels)); });

  Plan best;
  best.bytes = std::numeric_limits<double>::infinity();
  for (std::size_t components = most; components >= 4; components /= 2)
  {
    Plan plan = planFor(components, basis, prepared, sample.population);
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
  basis_.emplace(format_.basis);
}

TexturePacker::Code ComponentPacker::pack(const WeighedTexture& texture) const
{
  std::vector<float> weights;
  const Area area = areaOf(texture, weights);
  if (!basis_ || hasOneValue(texture.values, texelsPerTexture()))
  {
    return packSize(texture.values, area, 0);
  }
  Prepared prepared = prepare(*basis_, texture);
  const auto squareOf = [&](std::size_t way)
  { return squareLeft(*basis_, prepared, format_.classBits, way); };
  const std::size_t way = cheapest(squareOf, prepared.area, pricePerWord_);
  if (way == OneValue || way == AllTexels)
  {
    return packSize(texture.values, area, way == OneValue ? 0 : sizes() - 1);
  }
  if (prepared.part)
  {
    prepared.coefficients = VisibleFit::fit(*prepared.part, format_.classBits[way - 1]);
  }
  Code code = packClass(way - 1, prepared.coefficients);
  code.squareError = squareOf(way);
  code.area = prepared.area;
  return code;
}
}
