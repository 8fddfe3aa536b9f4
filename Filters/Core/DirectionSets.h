// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DirectionSets_h
#define po_DirectionSets_h

#include "SharedDirections.h"
#include "TexelSums.h"
#include "TextureSmoothing.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace po
{
/// A set of directions, and what an open particle sums to after it.
struct DirectionSet
{
  SharedDirections directions;
  OpenSums open;              ///< of all sets up to this one
  TextureSmoothing smoothing; ///< of what they leave
};

/// The sets of directions along which all particles look, one after the other. The first ones are
/// kept, as far as they take little memory; later ones are made again when they are asked for.
class DirectionSets
{
public:
  /// One lattice of `directions` (an odd number is rounded up), cut into sets.
  static std::vector<std::vector<Vec3d>> lattice(int directions, std::uint64_t seed);

  /// Lattices of `first`, `first`, 2 `first`, 4 `first` ... directions up to `total` together, each
  /// turned by itself and cut into sets: one may stop after any set.
  static std::vector<std::vector<Vec3d>> growing(int first, int total, std::uint64_t seed);

  /// @param axes of each set. The first two arguments must outlive this.
  /// @param smooth whether textures are smoothed
  DirectionSets(const SweepTexels& texels, const Background& background, std::uint64_t seed,
    std::vector<std::vector<Vec3d>> axes, bool smooth);

  [[nodiscard]] std::size_t size() const { return axes_.size(); }

  /// Set 0, or the one after the set that was asked for last. The reference is good until then.
  const DirectionSet& get(std::size_t index);

private:
  [[nodiscard]] std::unique_ptr<DirectionSet> make(std::size_t index) const;

  const SweepTexels& texels_;
  const Background& background_;
  std::uint64_t seed_;
  std::vector<std::vector<Vec3d>> axes_;
  bool smooth_;
  std::vector<std::unique_ptr<DirectionSet>> kept_;
  std::unique_ptr<DirectionSet> passing_; ///< the last one that is not kept
  const DirectionSet* last_ = nullptr;
  std::size_t keptTexels_ = 0; ///< slots of all directions in kept_
};
}

#endif
