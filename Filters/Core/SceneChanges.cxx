// SPDX-License-Identifier: BSD-3-Clause
#include "SceneChanges.h"

#include "OverlapFinder.h"
#include "TextureTable.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace po
{
namespace
{
using Triangle = std::array<Vec3f, 3>;

/// Items of two lists, the same number for equal ones.
template <typename Item>
class Comparison
{
public:
  void addBefore(const Item& item)
  {
    const std::size_t number = numberOf(item);
    ++more_[number];
    firsts_[number] = firsts_[number] < 0 ? before_ : firsts_[number];
    ++before_;
  }

  /// @return place of the first equal one before, or -1
  std::int32_t addNow(const Item& item)
  {
    const std::size_t number = numberOf(item);
    --more_[number];
    return firsts_[number];
  }

  /// Calls visit(item) for those that are there more or less often than before.
  template <typename Visit>
  void forEachChange(const Visit& visit) const
  {
    for (std::size_t i = 0; i < items_.size(); ++i)
    {
      if (more_[i] != 0)
      {
        visit(items_[i]);
      }
    }
  }

private:
  std::size_t numberOf(const Item& item)
  {
    const auto isEqual = [&](std::int32_t known)
    { return std::memcmp(&items_[static_cast<std::size_t>(known)], &item, sizeof(Item)) == 0; };
    const auto count = static_cast<std::int32_t>(items_.size());
    const std::int32_t number = index_.findOrAdd(hashOfBytes(&item, sizeof(Item)), isEqual, count);
    if (number == count)
    {
      items_.push_back(item);
      more_.push_back(0);
      firsts_.push_back(-1);
    }
    return static_cast<std::size_t>(number);
  }

  RowIndex index_;
  std::vector<Item> items_;
  std::vector<std::int32_t> more_;   ///< before than now
  std::vector<std::int32_t> firsts_; ///< places of the first ones before, or -1
  std::int32_t before_ = 0;
};

template <typename Visit>
void forEachTriangle(const OccluderMesh& mesh, const Visit& visit)
{
  for (const auto& [a, b, c] : mesh.triangles)
  {
    visit(Triangle{ mesh.vertices[a], mesh.vertices[b], mesh.vertices[c] });
  }
}

Sphere ballAround(const Triangle& triangle)
{
  const Vec3f middle = (1.0f / 3) * (triangle[0] + triangle[1] + triangle[2]);
  float radius = 0;
  for (const Vec3f corner : triangle)
  {
    radius = std::max(radius, length(corner - middle));
  }
  return { middle.x, middle.y, middle.z, radius };
}

void compareSpheres(
  const std::vector<Sphere>& before, const std::vector<Sphere>& now, SceneChanges& changes)
{
  Comparison<Sphere> comparison;
  for (const Sphere& sphere : before)
  {
    comparison.addBefore(sphere);
  }
  std::int32_t last = -1;
  changes.earlier.reserve(now.size());
  for (const Sphere& sphere : now)
  {
    const std::int32_t place = comparison.addNow(sphere);
    changes.earlier.push_back(place);
    changes.inOrder = changes.inOrder && (place < 0 || place >= last);
    last = std::max(last, place);
  }
  comparison.forEachChange([&](const Sphere& sphere) { changes.balls.push_back(sphere); });
}

void compareTriangles(const OccluderMesh& before, const OccluderMesh& now, SceneChanges& changes)
{
  Comparison<Triangle> comparison;
  forEachTriangle(before, [&](const Triangle& triangle) { comparison.addBefore(triangle); });
  forEachTriangle(now, [&](const Triangle& triangle) { comparison.addNow(triangle); });
  comparison.forEachChange(
    [&](const Triangle& triangle) { changes.balls.push_back(ballAround(triangle)); });
}
}

SceneChanges findChanges(const std::vector<Sphere>& spheresBefore, const OccluderMesh& meshBefore,
  const std::vector<Sphere>& spheres, const OccluderMesh& mesh)
{
  SceneChanges changes;
  compareSpheres(spheresBefore, spheres, changes);
  compareTriangles(meshBefore, mesh, changes);
  return changes;
}

std::vector<std::uint8_t> markWithin(
  const std::vector<Sphere>& spheres, const std::vector<Sphere>& balls, float reach)
{
  std::vector<std::uint8_t> marks(spheres.size(), 0);
  if (balls.empty())
  {
    return marks;
  }
  // Floats of a frame are right to 1/2000 of a mean radius or better (see SphereSet).
  const float wide = reach + 0.001f * (1 + reach);
  const SphereSet set(balls);
  const OverlapFinder finder(set);
  tbb::parallel_for(std::size_t(0), spheres.size(),
    [&](std::size_t i) { marks[i] = finder.hasNear(spheres[i], wide) ? 1 : 0; });
  return marks;
}
}
