// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepScene_h
#define po_SweepScene_h

#include "SphereSet.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
class SweepOrder;

/// The spheres of a scene in the order in which a sweep works: sorted into bands of their radii,
/// so that a few large ones do not make the tiles and cells of the many small ones large, and
/// within a band along a Morton curve, so that spheres that are near in space are near in
/// memory. Spheres of different bricks (see SphereSet) are in different bands. Of equal spheres at
/// one place, which see the same, one stands for all: thousands of them would all look at each
/// other. A set that has this order already (see sortForSweep) and no repetitions is used as it is;
/// of others there is a copy.
class SweepScene
{
public:
  /// Spheres [first, last), none more than four times as large as another, but for a few small ones
  /// that are not worth a band of their own. Bands are numbered upward; each holds a sphere.
  struct Band
  {
    unsigned first, last;
    float smallestRadius, largestRadius;
    Vec3d origin; ///< of the brick: what is near to these spheres is projected relative to it
    unsigned firstBlock, lastBlock; ///< its blocks [firstBlock, lastBlock)
  };

  /// Spheres [first, last) of a band, at most BlockSize: mostly near each other.
  struct Block
  {
    unsigned first, last;
    Vec3d middle;   ///< of the box that holds their centres
    Vec3f half;     ///< its size to each side, rounded up
    float distance; ///< of its corners from the middle, rounded up
    float radius;   ///< the largest one
  };
  static constexpr unsigned BlockSize = 64;

  /// The set must outlive this.
  explicit SweepScene(const SphereSet& set);
  SweepScene(const SweepScene&) = delete;
  SweepScene& operator=(const SweepScene&) = delete;

  /// Without repetitions.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Sphere& sphere(unsigned index) const { return spheres_[index]; }
  /// In full, relative to the origin of the set.
  [[nodiscard]] Vec3d center(unsigned index) const
  {
    return set_.bricks().size() == 1 ? spheres_[index].center().as<double>()
                                     : set_.center(source(index));
  }
  [[nodiscard]] const std::vector<Band>& bands() const { return bands_; }
  /// In the order of their spheres.
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

  /// The place of a sphere in the set that this was made from, and back.
  [[nodiscard]] unsigned source(unsigned index) const
  {
    return source_.empty() ? index : source_[index];
  }
  [[nodiscard]] unsigned indexOf(unsigned source) const
  {
    return indexOf_.empty() ? source : indexOf_[source];
  }

  /// The same of several.
  [[nodiscard]] std::vector<unsigned> indicesOf(std::vector<unsigned> sources) const;

  /// [size()] 1 for the spheres that are listed by their places in that set, 0 for others.
  [[nodiscard]] std::vector<std::uint8_t> flagsOf(const std::vector<unsigned>& sources) const;

private:
  bool takeAsTheyAre(const SweepOrder& order);
  void takeInOrder(const SweepOrder& order);
  void addToBands(unsigned index, bool begins);
  void addBlocks(Band& band);
  [[nodiscard]] Block makeBlock(unsigned first, unsigned last) const;

  const SphereSet& set_;
  const Sphere* spheres_ = nullptr; ///< those of the set or the ordered ones
  std::size_t size_ = 0;
  std::vector<Band> bands_;
  std::vector<Block> blocks_;
  // Empty where the set has this order.
  std::vector<Sphere> ordered_;
  std::vector<unsigned> source_;
  std::vector<unsigned> indexOf_;
};
}

#endif
