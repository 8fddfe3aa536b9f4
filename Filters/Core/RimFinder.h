// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimFinder_h
#define po_RimFinder_h

#include "OverlapFinder.h"
#include "TexelRims.h"

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace po
{
/// A cap in single precision, as points are tested against it.
[[nodiscard]] RimCap rimCapOf(const BuriedCap& cap);

/// Finds the texels that caps cover and those that their rims cross, for particle after particle.
class RimFinder
{
public:
  /// @return valid until the next call
  TexelRims find(const SweepTexels& texels, const std::vector<BuriedCap>& caps);

  /// Of the caps that find() was given, those that are among its result, by their places.
  [[nodiscard]] const std::vector<std::uint32_t>& capsUsed() const { return used_; }

private:
  /// Some of the caps, and the discs of a group that each may cover in part.
  struct Candidates
  {
    std::size_t count = 0;
    std::vector<std::uint32_t> caps; ///< by their places in all_
    std::vector<GroupMask> parts;    ///< by these

    void resize(std::size_t most);
    /// Takes those that may cover a part of some discs.
    /// @return the discs of which any of them may
    unsigned select(const Candidates& others, unsigned discs);
  };

  void begin(const SweepTexels& texels, const std::vector<BuriedCap>& caps);
  [[nodiscard]] unsigned classify(
    const TexelDiscs& discs, std::size_t group, Candidates& candidates) const;
  void findInBlock(const SweepTexels& texels, std::size_t block);
  void findInGroup(const SweepTexels& texels, std::size_t group);
  [[nodiscard]] std::uint32_t placeOf(std::uint32_t cap);

  std::vector<RimCap> all_;
  std::vector<float> sines_;          ///< of their half angles
  Candidates every_;                  ///< all caps, for a block of GroupSize groups
  Candidates near_;                   ///< those that may cover parts of a group
  Candidates crossing_;               ///< those whose rims may cross its texels that are not inside
  std::vector<std::uint32_t> places_; ///< of all caps in caps_
  std::vector<std::uint32_t> used_;   ///< places of caps_ in all_
  std::vector<GroupMask> outside_;
  std::vector<RimGroup> rims_;
  std::vector<std::uint32_t> capOf_;
  std::vector<RimCap> caps_; ///< of these
};

/// A copy that lives as long as the memory does; nothing needs to be freed one by one.
[[nodiscard]] const TexelRims* copyTo(
  std::pmr::memory_resource& memory, const TexelRims& rims, std::size_t groups);
}

#endif
