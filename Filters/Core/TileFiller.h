// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TileFiller_h
#define po_TileFiller_h

#include "BlockProjection.h"
#include "ClosedCells.h"
#include "DepthTiles.h"
#include "SweepScene.h"

#include <cstdint>
#include <vector>

namespace po
{
/// Marks of what each direction of a pair has seen, by sphere: the sum of their bits.
using SeenMarks = std::vector<std::uint8_t>;

/// What takes part along an axis.
struct SweepParticipants
{
  const std::vector<BlockBits>& spheres; ///< by block
  const std::vector<BlockBits>& shown;   ///< of these, those that earlier axes have shown
  std::uint8_t directions;               ///< bits of those that are swept
  bool bounded;                          ///< light is blocked within a distance only
  bool useClosedCells;
};

/// Fills the tiles of an axis with the spheres that matter to them. Receivers that lie behind
/// closed cells are left out before anything else is done with them: in dense sets most are.
class TileFiller
{
public:
  /// All must outlive this.
  TileFiller(const SweepScene& scene, const BlockProjection& projection,
    const SweepParticipants& participants, ClosedCells& cells);

  /// Of the spheres of a band that take part.
  [[nodiscard]] ReceiverExtent extentOf(const SweepScene::Band& band) const;

  /// Adds what matters to the patch at hand.
  /// @param band of the receivers
  /// @param seen of the bands before: of these, those that were not seen hide nothing
  void fill(const SweepScene::Band& band, const SeenMarks& seen, DepthTiles& tiles);

  /// Receivers that were left out, in each direction that is swept.
  [[nodiscard]] std::uint64_t closed() const { return closed_; }

private:
  /// A block near the patch.
  struct NearBlock
  {
    unsigned place; ///< in the SweepScene
    bool isBefore;  ///< of a band before that of the receivers
    bool receives;
    BlockBits spheres; ///< those that may matter
  };

  void findBlocks(const SweepScene::Band& band, const DepthTiles& tiles);
  void closeCells(const SweepScene::Band& band, const DepthTiles& tiles);
  [[nodiscard]] BlockBits shownOf(const NearBlock& block) const;
  template <typename Choose>
  void closeBy(const SweepScene::Band& band, const Choose& choose);
  void dropHidden(const SweepScene::Band& band);
  void add(
    const NearBlock& block, const SweepScene::Band& band, const SeenMarks& seen, DepthTiles& tiles);
  void project(const NearBlock& block, BlockBits spheres, const SweepScene::Band& band);
  [[nodiscard]] HiddenSpheres findHidden() const;
  void count(const HiddenSpheres& hidden);

  const SweepScene& scene_;
  const BlockProjection& projection_;
  SweepParticipants participants_;
  ClosedCells& cells_;
  std::vector<NearBlock> blocks_;
  ProjectedBlock projected_; ///< the block at hand
  std::uint64_t closed_ = 0;
};
}

#endif
