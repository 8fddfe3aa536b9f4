// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleView.h"

#include "TexelMask.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace po
{
namespace
{
/// What comes this near to a particle's surface, in its radii, is near.
constexpr float NearReach = 2;

/// So many spheres are listed, the nearest ones. Where the list ends nearer than CloseReach, rays
/// that stand for groups would blur what is in contact.
constexpr std::size_t NearLimit = 64;
constexpr float CloseReach = 0.5f;

/// Calls visit(place) for the bits that are set, lowest first.
template <typename Visit>
void forEachBit(unsigned bits, const Visit& visit)
{
  for (unsigned place = 0; bits != 0; ++place, bits >>= 1)
  {
    if ((bits & 1) != 0)
    {
      visit(place);
    }
  }
}

/// One of the slots of a group that are set, each with a probability in proportion to its
/// importance.
std::size_t chooseSlot(const float* importance, unsigned mask, double random)
{
  float total = 0;
  forEachBit(mask, [&](unsigned place) { total += importance[place]; });
  float left = static_cast<float>(random) * total;
  std::size_t chosen = GroupSize;
  forEachBit(mask,
    [&](unsigned place)
    {
      if (left >= 0)
      {
        chosen = place;
        left -= importance[place];
      }
    });
  return chosen;
}

GroupMask without(GroupMask mask, unsigned bits)
{
  return static_cast<GroupMask>(mask & ~bits);
}
}

ParticleView::ParticleView(const BakeScene& scene, float distance)
  : scene_(scene)
  , distance_(distance)
{
}

void ParticleView::begin(unsigned id)
{
  id_ = id;
  self_ = scene_.rays.spheres()[id];
  reach_ = distance_ / self_.radius;
  const float near = std::min(NearReach, reach_);
  scene_.overlaps.findNear(id, near * self_.radius, NearLimit, found_);
  near_.clear();
  for (const Neighbour& neighbour : found_)
  {
    const Sphere& other = scene_.rays.spheres()[neighbour.id];
    near_.push_back(
      { (1 / self_.radius) * (other.center() - self_.center()), other.radius / self_.radius });
  }
  const bool full = found_.size() == NearLimit;
  const bool nearMesh = scene_.rays.isMeshWithin(self_.center(), (1 + near) * self_.radius);
  needsRays_ = full || nearMesh || near < reach_;
  raysOfTexels_ = nearMesh || (full && found_.back().gap < CloseReach * self_.radius);
}

void ParticleView::hide(const SharedDirection& direction, Random& random, GroupMask* mask)
{
  if (!hideBehindNear(direction, mask) || !needsRays_)
  {
    return;
  }
  if (raysOfTexels_)
  {
    traceTexels(direction, mask);
  }
  else
  {
    traceGroups(direction, random, mask);
  }
}

/// Spheres whose centre lies ahead of the particle's, and whose disc meets its disc, may hide
/// texels.
bool ParticleView::hideBehindNear(const SharedDirection& direction, GroupMask* mask)
{
  const Vec3f x = direction.basis.x.as<float>();
  const Vec3f y = direction.basis.y.as<float>();
  const Vec3f towardsLight = direction.towardsLight.as<float>();
  const bool bounded = std::isfinite(reach_);
  for (const NearSphere& sphere : near_)
  {
    const float a = dot(sphere.center, x);
    const float b = dot(sphere.center, y);
    const float height = dot(sphere.center, towardsLight);
    const float touch = 1 + sphere.radius;
    if (height <= 0 || a * a + b * b >= touch * touch)
    {
      continue;
    }
    const Occluder occluder{ a, b, height, sphere.radius * sphere.radius };
    const bool open = bounded ? hideTexelsWithin(direction.facing, occluder, reach_, mask)
                              : hideTexels(direction.facing, occluder, mask);
    if (!open)
    {
      return false;
    }
  }
  return true;
}

Vec3f ParticleView::pointOf(const SharedDirection& direction, std::size_t slot) const
{
  return self_.center() + self_.radius * direction.normals[slot];
}

void ParticleView::traceGroups(const SharedDirection& direction, Random& random, GroupMask* mask)
{
  const Vec3f towardsLight = direction.towardsLight.as<float>();
  std::array<Vec3f, SphereScene::PacketSize> origins;
  std::array<std::uint32_t, SphereScene::PacketSize> groups;
  unsigned count = 0;
  const auto trace = [&]
  {
    const unsigned stopped =
      scene_.rays.occludedFrom(origins.data(), count, towardsLight, distance_, id_);
    forEachBit(stopped, [&](unsigned i) { mask[groups[i]] = 0; });
    rays_ += count;
    count = 0;
  };
  for (const std::uint32_t group : direction.facing.facingGroups)
  {
    if (mask[group] == 0)
    {
      continue;
    }
    const std::size_t first = group * GroupSize;
    const std::size_t slot =
      first + chooseSlot(direction.importance.data() + first, mask[group], random.uniform());
    origins[count] = pointOf(direction, slot);
    groups[count] = group;
    if (++count == SphereScene::PacketSize)
    {
      trace();
    }
  }
  if (count > 0)
  {
    trace();
  }
}

void ParticleView::traceTexels(const SharedDirection& direction, GroupMask* mask)
{
  static_assert(SphereScene::PacketSize == GroupSize);
  const Vec3f towardsLight = direction.towardsLight.as<float>();
  std::array<Vec3f, GroupSize> origins;
  std::array<unsigned, GroupSize> places;
  for (const std::uint32_t group : direction.facing.facingGroups)
  {
    unsigned count = 0;
    forEachBit(mask[group],
      [&](unsigned place)
      {
        origins[count] = pointOf(direction, group * GroupSize + place);
        places[count++] = place;
      });
    if (count == 0)
    {
      continue;
    }
    const unsigned stopped =
      scene_.rays.occludedFrom(origins.data(), count, towardsLight, distance_, id_);
    forEachBit(stopped, [&](unsigned i) { mask[group] = without(mask[group], 1u << places[i]); });
    rays_ += count;
  }
}
}
