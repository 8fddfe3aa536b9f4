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
  void classify(const SweepTexels& texels);
  void listByGroup();

  std::vector<RimCap> all_;
  std::vector<GroupMask> covered_; ///< by one cap
  std::vector<GroupMask> outside_;
  std::vector<GroupMask> parts_;      ///< [caps][groups] those of which a cap may cover a part
  std::vector<std::uint32_t> places_; ///< of all caps in caps_
  std::vector<std::uint32_t> used_;   ///< places of these in all_
  std::vector<RimGroup> rims_;
  std::vector<std::uint32_t> capOf_;
  std::vector<RimCap> caps_; ///< of these
};

/// A copy that lives as long as the memory does; nothing needs to be freed one by one.
[[nodiscard]] const TexelRims* copyTo(
  std::pmr::memory_resource& memory, const TexelRims& rims, std::size_t groups);
}

#endif
