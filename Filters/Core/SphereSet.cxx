// SPDX-License-Identifier: BSD-3-Clause
#include "SphereSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace po
{
namespace
{
struct Box
{
  Vec3d low{ +HUGE_VAL, +HUGE_VAL, +HUGE_VAL };
  Vec3d high{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

  void include(Vec3d p, double reach)
  {
    low = { std::min(low.x, p.x - reach), std::min(low.y, p.y - reach),
      std::min(low.z, p.z - reach) };
    high = { std::max(high.x, p.x + reach), std::max(high.y, p.y + reach),
      std::max(high.z, p.z + reach) };
  }
  [[nodiscard]] Vec3d middle() const { return 0.5 * (low + high); }
  [[nodiscard]] Vec3d extent() const { return high - low; }
};

/// Spheres that may become a brick.
struct Part
{
  std::vector<unsigned> ids;
  Box box; ///< of the centres

  [[nodiscard]] double width() const
  {
    const Vec3d extent = box.extent();
    return std::max({ extent.x, extent.y, extent.z });
  }
};

Part makePart(const std::vector<Vec3d>& centers, std::vector<unsigned> ids)
{
  Part part{ std::move(ids), {} };
  for (const unsigned id : part.ids)
  {
    part.box.include(centers[id], 0);
  }
  return part;
}

/// What a part counts for: the number of its spheres times the error of their places; 0 if it is
/// small enough.
double urgency(const Part& part)
{
  return part.width() > 2 * SphereSet::LargestBrick
    ? static_cast<double>(part.ids.size()) * part.width()
    : 0;
}

/// Halves a part across its longest side; both halves hold spheres.
std::pair<Part, Part> halve(const std::vector<Vec3d>& centers, Part part)
{
  const Vec3d extent = part.box.extent();
  const Vec3d middle = part.box.middle();
  const auto isLow = [&](unsigned id)
  {
    const Vec3d c = centers[id];
    if (extent.x >= extent.y && extent.x >= extent.z)
    {
      return c.x < middle.x;
    }
    return extent.y >= extent.z ? c.y < middle.y : c.z < middle.z;
  };
  const auto cut = std::stable_partition(part.ids.begin(), part.ids.end(), isLow);
  return { makePart(centers, { part.ids.begin(), cut }),
    makePart(centers, { cut, part.ids.end() }) };
}
}

SphereSet::SphereSet(std::vector<Sphere> spheres, std::vector<Vec3d> centers)
  : spheres_(std::move(spheres))
  , centers_(std::move(centers))
{
  if (!centers_.empty())
  {
    cut();
    return;
  }
  Box box;
  for (const Sphere& s : spheres_)
  {
    box.include(s.center().as<double>(), s.radius);
  }
  bricks_.push_back({ {}, box.low, box.high, spheres_.data(), spheres_.size(), nullptr });
}

void SphereSet::cut()
{
  std::vector<unsigned> all(spheres_.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<Part> parts{ makePart(centers_, std::move(all)) };
  while (parts.size() < MostBricks)
  {
    const auto most = std::max_element(parts.begin(), parts.end(),
      [](const Part& a, const Part& b) { return urgency(a) < urgency(b); });
    if (urgency(*most) == 0)
    {
      break;
    }
    auto [low, high] = halve(centers_, std::move(*most));
    *most = std::move(low);
    parts.push_back(std::move(high));
  }
  brickOf_.resize(spheres_.size());
  relative_.reserve(spheres_.size());
  ids_.reserve(spheres_.size());
  for (const Part& part : parts)
  {
    addBrick(part.ids);
  }
}

void SphereSet::addBrick(const std::vector<unsigned>& ids)
{
  Box centers;
  Box whole;
  for (const unsigned id : ids)
  {
    centers.include(centers_[id], 0);
    whole.include(centers_[id], spheres_[id].radius);
  }
  const Vec3d origin = centers.middle();
  const std::size_t first = relative_.size();
  for (const unsigned id : ids)
  {
    brickOf_[id] = static_cast<unsigned char>(bricks_.size());
    const Vec3f c = (centers_[id] - origin).as<float>();
    relative_.push_back({ c.x, c.y, c.z, spheres_[id].radius });
    ids_.push_back(id);
  }
  bricks_.push_back(
    { origin, whole.low, whole.high, relative_.data() + first, ids.size(), ids_.data() + first });
}

Sphere SphereSet::inBrick(unsigned id) const
{
  if (brickOf_.empty())
  {
    return spheres_[id];
  }
  const Vec3f c = (centers_[id] - bricks_[brickOf_[id]].origin).as<float>();
  return { c.x, c.y, c.z, spheres_[id].radius };
}
}
