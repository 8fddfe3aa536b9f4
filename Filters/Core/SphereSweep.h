// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereSweep_h
#define po_SphereSweep_h

#include "DepthTiles.h"
#include "TileSweep.h"
#include "VisibilityRecords.h"

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <vector>

namespace po
{
/// Sweeps a scene along given directions and sums what is seen in records.
class SphereSweep
{
public:
  /// @param distance light is blocked within it: local, infinite when unbounded
  SphereSweep(const BakeScene& scene, const Background& background, float distance,
    VisibilityRecords& records);

  /// Goes on with more directions, skipping those that the background makes black. Returns early
  /// when `progress` says so. A unit of progress is one sphere in one direction.
  void run(const std::vector<Vec3d>& directions, Progress& progress);

  [[nodiscard]] int directions() const { return directions_; }
  [[nodiscard]] std::uint64_t spheresSkipped() const { return spheresSkipped_; }
  [[nodiscard]] unsigned threads() const { return static_cast<unsigned>(workspaces_.size()); }

private:
  /// Memory of a thread.
  struct Workspace
  {
    explicit Workspace(VisibilityRecords& records)
      : tileSweep(records)
    {
    }

    std::vector<ProjectedSphere> projected;
    std::vector<std::uint8_t> hidden;
    DepthTiles tiles;
    TileSweep tileSweep;
  };

  struct Direction
  {
    Vec3d towardsLight;
    double luminance;
  };

  void sweepBlock(const std::vector<Direction>& block, Progress& progress);
  void sweepDirection(
    Vec3d towardsLight, const SweptDirection& direction, bool full, Progress& progress);
  void project(Vec3d towardsLight, bool full, Workspace& work);

  const BakeScene& scene_;
  const Background& background_;
  float distance_;
  VisibilityRecords& records_;
  RadiusOctaves octaves_;
  std::vector<std::atomic<std::uint8_t>> everVisible_;
  std::vector<unsigned> visible_; ///< the spheres that were ever visible, up to the last block
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  int directions_ = 0;
  std::uint64_t spheresSkipped_ = 0;
};
}

#endif
