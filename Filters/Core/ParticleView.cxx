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
constexpr float NearReach = 3;

/// So many spheres are listed, the nearest ones. Where the list ends nearer than CloseReach, rays
/// that stand for groups would blur what is in contact.
constexpr std::size_t NearLimit = 128;
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

/// The place of one of the bits that are set, each with a probability in proportion to its
/// importance. Without branches: they would be hard to foresee.
std::size_t choosePlace(const float* importance, unsigned bits, Random& random)
{
  std::array<float, GroupSize> sums; // of all places up to this one
  float total = 0;
  for (std::size_t place = 0; place < GroupSize; ++place)
  {
    total += (bits >> place & 1) != 0 ? importance[place] : 0.0f;
    sums[place] = total;
  }
  const float mark = static_cast<float>(random.next() >> 8) * 0x1p-24f * total;
  std::size_t chosen = 0;
  for (const float sum : sums)
  {
    chosen += sum <= mark ? 1 : 0;
  }
  return std::min(chosen, GroupSize - 1); // beyond only where all importance is 0
}

/// The squares of a group of 4 x 4 texels that rays stand for.
struct Squares
{
  std::size_t count;
  std::array<unsigned, GroupSize> masks;
};

constexpr Squares makeSquares(unsigned first, unsigned side)
{
  Squares squares{ 0, {} };
  for (unsigned row = 0; row < 4; row += side)
  {
    for (unsigned column = 0; column < 4; column += side)
    {
      squares.masks[squares.count++] = first << (4 * row + column);
    }
  }
  return squares;
}

const Squares& squaresOf(RayShare share)
{
  static constexpr Squares sixteen = makeSquares(0xFFFF, 4);
  static constexpr Squares four = makeSquares(0x0033, 2);
  static constexpr Squares one = makeSquares(0x0001, 1);
  switch (share)
  {
    case RayShare::Sixteen:
      return sixteen;
    case RayShare::Four:
      return four;
    default:
      return one;
  }
}

/// Parallel rays of one particle, traced sixteen at a time. Each clears bits where it is stopped.
class RayPacket
{
public:
  RayPacket(const SphereScene& scene, Vec3f direction, float distance, unsigned own)
    : scene_(scene)
    , direction_(direction)
    , distance_(distance)
    , own_(own)
  {
  }

  void add(Vec3f origin, GroupMask& mask, unsigned bits)
  {
    origins_[count_] = origin;
    targets_[count_] = { &mask, bits };
    if (++count_ == SphereScene::PacketSize)
    {
      trace();
    }
  }

  void trace()
  {
    if (count_ == 0)
    {
      return;
    }
    const unsigned stopped =
      scene_.occludedFrom(origins_.data(), count_, direction_, distance_, own_);
    forEachBit(stopped,
      [&](unsigned ray)
      {
        GroupMask& mask = *targets_[ray].mask;
        mask = static_cast<GroupMask>(mask & ~targets_[ray].bits);
      });
    count_ = 0;
  }

private:
  struct Target
  {
    GroupMask* mask;
    unsigned bits;
  };

  const SphereScene& scene_;
  Vec3f direction_;
  float distance_;
  unsigned own_;
  unsigned count_ = 0;
  std::array<Vec3f, SphereScene::PacketSize> origins_;
  std::array<Target, SphereScene::PacketSize> targets_;
};
}

ParticleView::ParticleView(const BakeScene& scene, float distance, RayShare share)
  : scene_(scene)
  , distance_(distance)
  , share_(share)
  , shareHere_(share)
{
}

void ParticleView::begin(unsigned id)
{
  id_ = id;
  const SphereSet& set = scene_.set();
  self_ = set.inBrick(id);
  reach_ = distance_ / self_.radius;
  const float near = std::min(NearReach, reach_);
  scene_.overlaps.findNear(id, near * self_.radius, NearLimit, found_);
  near_.clear();
  for (const Neighbour& neighbour : found_)
  {
    const Vec3f offset = (set.center(neighbour.id) - set.center(id)).as<float>();
    const float radius = set.spheres()[neighbour.id].radius;
    near_.add((1 / self_.radius) * offset, radius / self_.radius);
  }
  const bool full = found_.size() == NearLimit;
  const bool nearMesh =
    scene_.rays().isMeshWithin(set.spheres()[id].center(), (1 + near) * self_.radius);
  needsRays_ = full || nearMesh || near < reach_;
  const bool crowded = full && found_.back().gap < CloseReach * self_.radius;
  shareHere_ = nearMesh || crowded ? RayShare::One : share_;
}

void ParticleView::hide(const SharedDirection& direction, Random& random, GroupMask* mask)
{
  if (hideBehindNear(direction, mask) && needsRays_)
  {
    trace(direction, random, mask);
  }
}

bool ParticleView::hideBehindNear(const SharedDirection& direction, GroupMask* mask)
{
  const bool bounded = std::isfinite(reach_);
  NearSpheres::Projection projected;
  for (std::size_t block = 0; block < near_.blocks(); ++block)
  {
    near_.project(block, direction, projected);
    OccluderBatch occluders;
    for (std::size_t i = 0; i < NearSpheres::BlockSize; ++i)
    {
      if (projected.meets[i] != 0)
      {
        occluders.add(
          { projected.a[i], projected.b[i], projected.height[i], near_.squaredRadius(block, i) });
      }
    }
    const bool open = bounded ? hideTexelsWithin(direction.facing, occluders, reach_, mask)
                              : hideTexels(direction.facing, occluders, mask);
    if (!open)
    {
      return false;
    }
  }
  return true;
}

void ParticleView::trace(const SharedDirection& direction, Random& random, GroupMask* mask)
{
  const Squares& squares = squaresOf(shareHere_);
  RayPacket packet(scene_.rays(), direction.towardsLight.as<float>(), distance_, id_);
  for (const std::uint32_t group : direction.facing.facingGroups)
  {
    const std::size_t first = group * GroupSize;
    const unsigned open = mask[group];
    for (std::size_t i = 0; i < squares.count && open != 0; ++i)
    {
      const unsigned bits = open & squares.masks[i];
      if (bits != 0)
      {
        const std::size_t slot =
          first + choosePlace(direction.importance.data() + first, bits, random);
        packet.add(self_.center() + self_.radius * direction.normals[slot], mask[group], bits);
        ++rays_;
      }
    }
  }
  packet.trace();
}
}
