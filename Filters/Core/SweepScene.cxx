// SPDX-License-Identifier: BSD-3-Clause
#include "SweepScene.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace po
{
namespace
{
/// Place of a sphere in the order; the source makes it unique.
struct Place
{
  int octave;
  std::uint64_t morton;
  unsigned source;

  bool operator<(const Place& other) const
  {
    if (octave != other.octave)
    {
      return octave < other.octave;
    }
    return morton != other.morton ? morton < other.morton : source < other.source;
  }
};

/// Moves bit i of a number of 21 bits to bit 3 i.
std::uint64_t spread(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x001F00000000FFFFu;
  bits = (bits | bits << 16) & 0x001F0000FF0000FFu;
  bits = (bits | bits << 8) & 0x100F00F00F00F00Fu;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

/// Maps positions to places along a Morton curve through their bounding box.
class MortonCurve
{
public:
  explicit MortonCurve(const std::vector<Sphere>& spheres)
    : low_(spheres.front().center())
  {
    Vec3f high = low_;
    for (const Sphere& s : spheres)
    {
      low_ = { std::min(low_.x, s.x), std::min(low_.y, s.y), std::min(low_.z, s.z) };
      high = { std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z) };
    }
    const float extent = std::max({ high.x - low_.x, high.y - low_.y, high.z - low_.z });
    scale_ = extent > 0 ? static_cast<float>((1 << 20) - 1) / extent : 0.0f;
  }

  [[nodiscard]] std::uint64_t operator()(Vec3f p) const
  {
    const auto cell = [this](float offset)
    { return spread(static_cast<std::uint64_t>(offset * scale_)); };
    return cell(p.x - low_.x) | cell(p.y - low_.y) << 1 | cell(p.z - low_.z) << 2;
  }

private:
  Vec3f low_;
  float scale_;
};

std::vector<Place> sortedPlaces(const std::vector<Sphere>& spheres)
{
  float largest = 0;
  for (const Sphere& s : spheres)
  {
    largest = std::max(largest, s.radius);
  }
  const MortonCurve morton(spheres);
  std::vector<Place> places(spheres.size());
  for (unsigned i = 0; i < places.size(); ++i)
  {
    // Counted down from the largest sphere: equal radii must never fall on both sides of an edge.
    const int below =
      static_cast<int>(std::min(255.0f, std::floor(std::log2(largest / spheres[i].radius))));
    places[i] = { -below, morton(spheres[i].center()), i };
  }
  tbb::parallel_sort(places.begin(), places.end());
  return places;
}
}

SweepScene::SweepScene(const std::vector<Sphere>& spheres)
  : indexOf_(spheres.size())
{
  if (spheres.empty())
  {
    return;
  }
  const std::vector<Place> places = sortedPlaces(spheres);
  spheres_.reserve(places.size());
  source_.reserve(places.size());
  for (unsigned i = 0; i < places.size(); ++i)
  {
    const Sphere& s = spheres[places[i].source];
    spheres_.push_back(s);
    source_.push_back(places[i].source);
    indexOf_[places[i].source] = i;
    if (i == 0 || places[i].octave != places[i - 1].octave)
    {
      octaves_.push_back({ i, i, s.radius, s.radius });
    }
    Octave& octave = octaves_.back();
    octave.last = i + 1;
    octave.smallestRadius = std::min(octave.smallestRadius, s.radius);
    octave.largestRadius = std::max(octave.largestRadius, s.radius);
  }
}
}
