// SPDX-License-Identifier: BSD-3-Clause
#include "TextureRecorder.h"

#include "TexelMap.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace po
{
TextureComparison::TextureComparison(const std::string& file, int resolution)
  : file_(file, std::ios::binary)
  , resolution_(resolution)
{
}

void TextureComparison::add(const RawTextures& raw)
{
  const auto side = static_cast<std::size_t>(resolution_);
  std::vector<float> others(raw.count * side * side);
  file_.read(reinterpret_cast<char*>(others.data()),
    static_cast<std::streamsize>(others.size() * sizeof(float)));
  if (!file_)
  {
    throw std::runtime_error("The values to compare with are too few, or cannot be read");
  }
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    const double weight = static_cast<double>(raw.outsideShares[i]) *
      texelArea(resolution_, static_cast<int>(i / side % side));
    const double difference = static_cast<double>(raw.values[i]) - others[i];
    squares_ += weight * difference * difference;
    area_ += weight;
  }
}

double TextureComparison::rms() const
{
  return area_ > 0 ? std::sqrt(squares_ / area_) : 0;
}

TextureRecorder::TextureRecorder(const OcclusionEstimator& estimator,
  const std::vector<std::size_t>& positions, std::size_t texels, TextureObserver observer)
  : estimator_(estimator)
  , texels_(texels)
  , observer_(std::move(observer))
{
  for (std::size_t slot = 0; slot < positions.size(); ++slot)
  {
    slots_[positions[slot]] = slot;
  }
  kept_.values.resize(positions.size() * texels);
  kept_.shares.resize(positions.size() * texels);
}

void TextureRecorder::estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  estimator_.estimate(
    scene, particles, settings, progress,
    [&](const RawTextures& raw)
    {
      keep(raw);
      sink(raw);
    },
    counters);
}

void TextureRecorder::keep(const RawTextures& raw) const
{
  const auto end = slots_.lower_bound(raw.firstParticle + raw.count);
  for (auto slot = slots_.lower_bound(raw.firstParticle); slot != end; ++slot)
  {
    const std::size_t from = (slot->first - raw.firstParticle) * texels_;
    const std::size_t to = slot->second * texels_;
    std::copy_n(raw.values + from, texels_, kept_.values.begin() + to);
    std::copy_n(raw.outsideShares + from, texels_, kept_.shares.begin() + to);
  }
  if (observer_)
  {
    observer_(raw);
  }
}
}
