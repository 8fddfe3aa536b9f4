// SPDX-License-Identifier: BSD-3-Clause
#include "RimEdges.h"

#include <algorithm>

// Highway compiles this file once for each instruction set and chooses when it runs. There are no
// fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "RimEdges.cxx"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#ifndef po_RimEdges_cxx
#define po_RimEdges_cxx
namespace po
{
/// The blocks and the sphere numbers that edges are listed of.
struct ListedBlock
{
  const EdgeFinder& finder;
  const std::uint32_t* shown;
  std::uint32_t firstSphere, sphereCount; ///< of the layer
  PatchPlace middle;
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using IntegerTag = hn::CappedTag<std::int32_t, EdgeGroup::Size>;
using Tag = hn::RebindToFloat<IntegerTag>;
using Integers = hn::Vec<IntegerTag>;
using Lanes = hn::Mask<IntegerTag>;

inline Integers number(std::int32_t value)
{
  return hn::Set(IntegerTag(), value);
}

/// Lists the edges of one layer.
class EdgeLister
{
public:
  /// @param edges has room for all edges and a vector more
  EdgeLister(const ListedBlock& listed, RimEdges& edges)
    : listed_(listed)
    , block_(listed.finder.block())
    , edges_(edges)
  {
  }

  /// @return how many they are
  std::size_t list()
  {
    for (const EdgeGroup& group : listed_.finder.groups())
    {
      findFronts(group);
    }
    for (const EdgeGroup& group : listed_.finder.groups())
    {
      listGroup(group);
    }
    for (const EdgeGroup& group : listed_.finder.groups())
    {
      hn::StoreU(number(RimEdges::NoEdge), IntegerTag(), frontsOf(group));
    }
    return count_;
  }

private:
  [[nodiscard]] std::int32_t* frontsOf(const EdgeGroup& group) const
  {
    return edges_.fronts.data() + block_.indexOf(group.i, group.j);
  }

  static Lanes edgesOf(const EdgeGroup& group)
  {
    const std::uint8_t bits[8] = { static_cast<std::uint8_t>(group.edges),
      static_cast<std::uint8_t>(group.edges >> 8U) };
    return hn::LoadMaskBits(IntegerTag(), bits);
  }

  /// Sets RimEdges::fronts.
  void findFronts(const EdgeGroup& group) const
  {
    const IntegerTag integers;
    const hn::RebindToUnsigned<IntegerTag> numbers;
    const Integers toFront = hn::LoadU(integers, group.fronts);
    const auto* shown = reinterpret_cast<const std::int32_t*>(listed_.shown);
    Integers front = number(0);
    for (const int k : { 0, 1, 2, 4, 6, 8, 9, 10 })
    {
      const int neighbour = block_.indexOf(group.i + columnsToFront(k), group.j + rowsToFront(k));
      front =
        hn::IfThenElse(hn::Eq(toFront, number(k)), hn::LoadU(integers, shown + neighbour), front);
    }
    const Integers place = hn::Sub(front, number(static_cast<std::int32_t>(listed_.firstSphere)));
    const auto isOfLayer =
      hn::Lt(hn::BitCast(numbers, place), hn::Set(numbers, listed_.sphereCount));
    const Lanes isListed = hn::And(edgesOf(group), hn::RebindMask(integers, isOfLayer));
    hn::StoreU(
      hn::IfThenElse(isListed, place, number(RimEdges::NoEdge)), integers, frontsOf(group));
  }

  void listGroup(const EdgeGroup& group)
  {
    const IntegerTag integers;
    const std::int32_t* fronts = frontsOf(group);
    const Integers place = hn::LoadU(integers, fronts), lane = hn::Iota(integers, 0);
    // Behind the end of a row are edges of the next one.
    const Lanes isEdge = hn::And(edgesOf(group), hn::Ne(place, number(RimEdges::NoEdge)));
    const auto keep = [&](Integers values, std::vector<std::int32_t>& to)
    { hn::StoreU(hn::Compress(values, isEdge), integers, to.data() + count_); };
    keep(hn::Add(lane, number(block_.indexOf(group.i, group.j))), edges_.pixel);
    keep(hn::LoadU(integers, group.fronts), edges_.toFront);
    keep(place, edges_.place);
    keep(directionsFrom(fronts, place), edges_.directions);
    const Integers column = hn::Add(lane, number(block_.x + group.i - listed_.middle.x));
    const auto x = hn::ConvertTo(Tag(), hn::Compress(column, isEdge));
    hn::StoreU(x, Tag(), edges_.x.data() + count_);
    const auto y = static_cast<float>(block_.y + group.j - listed_.middle.y);
    hn::StoreU(hn::Set(Tag(), y), Tag(), edges_.y.data() + count_);
    count_ += hn::CountTrue(integers, isEdge);
  }

  /// RimEdges::directions.
  [[nodiscard]] Integers directionsFrom(const std::int32_t* fronts, Integers place) const
  {
    const int up = block_.stride();
    const auto unless = [&](int offset, std::int32_t directions)
    {
      const Lanes isSame = hn::Eq(hn::LoadU(IntegerTag(), fronts + offset), place);
      return hn::IfThenElseZero(isSame, number(directions));
    };
    const Integers beside = hn::Or(unless(-1, 0b001001001), unless(1, 0b100100100));
    const Integers others = hn::Or(unless(-up, 0b000000111), unless(up, 0b111000000));
    return hn::Not(hn::Or(beside, others));
  }

  const ListedBlock& listed_;
  const SampleBlock& block_;
  RimEdges& edges_;
  std::size_t count_ = 0;
};

std::size_t listEdges(const ListedBlock& listed, RimEdges& edges)
{
  return EdgeLister(listed, edges).list();
}

/// Places the rims of some edges, as many as vectors of doubles hold.
template <bool IsPerspective>
inline void placeSome(const RayPatch& patch, double depthOrigin, std::size_t at, RimEdges& edges)
{
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> f;
  using Doubles = hn::Vec<decltype(d)>;
  const auto set = [d](double value) { return hn::Set(d, value); };
  const auto sum = [](Doubles a, Doubles b, Doubles c) { return hn::Add(hn::Add(a, b), c); };
  const auto store = [&](Doubles values, std::vector<float>& to)
  { hn::StoreU(hn::DemoteTo(f, values), f, to.data() + at); };

  hn::Vec<decltype(f)> centerX, centerY, centerZ, radii;
  hn::LoadInterleaved4(f, &edges.spheres[at].x, centerX, centerY, centerZ, radii);
  const Doubles x = hn::Sub(hn::PromoteTo(d, centerX), set(patch.origin.x));
  const Doubles y = hn::Sub(hn::PromoteTo(d, centerY), set(patch.origin.y));
  const Doubles z = hn::Sub(hn::PromoteTo(d, centerZ), set(patch.origin.z));
  const auto along = [&](const Vec3d& axis)
  { return sum(hn::Mul(x, set(axis.x)), hn::Mul(y, set(axis.y)), hn::Mul(z, set(axis.z))); };
  const Doubles radius = hn::PromoteTo(d, radii), perRadius = hn::Div(set(1), radius);
  const Doubles middle = along(patch.depth);
  Doubles touched = middle, w = perRadius;
  if constexpr (IsPerspective)
  {
    const Doubles square = sum(hn::Mul(x, x), hn::Mul(y, y), hn::Mul(z, z));
    touched = hn::Sqrt(hn::Max(hn::Sub(square, hn::Mul(radius, radius)), set(0)));
    w = hn::Mul(middle, perRadius);
  }
  store(w, edges.w);
  store(hn::Mul(along(patch.column), perRadius), edges.u);
  store(hn::Mul(along(patch.row), perRadius), edges.v);
  store(hn::Sub(hn::Mul(touched, set(patch.worldPerLocal)), set(depthOrigin)), edges.depth);
}

/// @param count filled up to a whole vector
void placeRims(const RayPatch& patch, double depthOrigin, std::size_t count, RimEdges& edges)
{
  const std::size_t lanes = hn::Lanes(hn::CappedTag<double, 8>());
  for (std::size_t at = 0; at < count; at += lanes)
  {
    patch.perspective ? placeSome<true>(patch, depthOrigin, at, edges)
                      : placeSome<false>(patch, depthOrigin, at, edges);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(listEdges);
HWY_EXPORT(placeRims);

namespace
{
/// Of the longest vectors.
constexpr std::size_t MostLanes = EdgeGroup::Size;

/// Spheres that are asked for before they are needed.
constexpr std::size_t Ahead = 16;

/// Copies the last of `count` so often that vectors of them are full.
template <typename T>
void fillVector(std::vector<T>& values, std::size_t count)
{
  std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(count), MostLanes, values[count - 1]);
}
}

void RimEdges::reserve(std::size_t edges)
{
  if (pixel.size() < edges)
  {
    for (std::vector<std::int32_t>* some : { &pixel, &toFront, &directions, &place })
    {
      some->resize(edges);
    }
    for (std::vector<float>* some : { &x, &y, &w, &u, &v, &depth })
    {
      some->resize(edges);
    }
    spheres.resize(edges);
  }
}

void RimEdges::list(const EdgeFinder& finder, const std::vector<std::uint32_t>& shown,
  const SphereLayer& layer, PatchPlace middle)
{
  const EdgeGroups groups = finder.groups();
  reserve(static_cast<std::size_t>(groups.last - groups.first + 1) * EdgeGroup::Size + MostLanes);
  fronts.resize(std::max(fronts.size(), finder.block().depth.size()), NoEdge);
  count_ = HWY_DYNAMIC_DISPATCH(listEdges)(
    { finder, shown.data(), layer.firstNumber, layer.count, middle }, *this);
  if (count_ > 0)
  {
    fillVector(pixel, count_);
    fillVector(toFront, count_);
    fillVector(directions, count_);
    fillVector(place, count_);
    fillVector(x, count_);
    fillVector(y, count_);
  }
}

void RimEdges::placeRims(const SphereLayer& layer, const RayPatch& patch, double depthOrigin)
{
  if (count_ == 0)
  {
    return;
  }
  for (std::size_t edge = 0; edge < count_; ++edge)
  {
    hwy::Prefetch(layer.spheres + place[std::min(edge + Ahead, count_ - 1)]);
    spheres[edge] = layer.spheres[place[edge]];
  }
  fillVector(spheres, count_);
  const std::size_t whole = (count_ + MostLanes - 1) / MostLanes * MostLanes;
  HWY_DYNAMIC_DISPATCH(placeRims)(patch, depthOrigin, whole, *this);
}
}
#endif
