// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereSweep_h
#define po_SphereSweep_h

#include "DepthTiles.h"
#include "SweepDivision.h"
#include "TileSweep.h"
#include "VisibilityRecords.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <vector>

namespace po
{
/// What a sweep may leave out. Everything is on but for measurements.
struct SweepSkips
{
  bool closedCells = true; ///< spheres under cells that one occluder closes
  bool neverSeen = true;   ///< spheres that no direction has shown, in seven of eight directions
  bool offsetMasks = true; ///< tests of equal spheres against each other
  bool blackSky = true;    ///< directions that the background makes black
  bool lonely = true;      ///< spheres outside the bounded distance of any other
};

/// What a sweep could leave out.
struct SweepCounters
{
  std::uint64_t visits = 0; ///< spheres that were looked at, in one direction
  std::uint64_t closed = 0; ///< those that were not: hidden by closed cells

  void add(const SweepCounters& other)
  {
    visits += other.visits;
    closed += other.closed;
  }
};

/// Which of the two directions of an axis are swept.
enum class AxisWays
{
  Both,
  Forward ///< the one that the axis names: light comes from there
};

/// Sweeps a scene along given directions and sums what is seen in records.
class SphereSweep
{
public:
  /// @param distance light is blocked within it: local, infinite when unbounded
  /// @param alone flags by sphere: those that take no part
  /// @param group the processes that divide the work where the distance is unbounded: all must have
  /// the same scene. Otherwise each has spheres of its own, and does all of its work.
  SphereSweep(const SweepScene& scene, const Background& background, float distance,
    VisibilityRecords& records, const SweepSkips& skips, const std::vector<std::uint8_t>& alone,
    const ProcessGroup& group, AxisWays ways = AxisWays::Both);
  SphereSweep(const SphereSweep&) = delete;
  SphereSweep& operator=(const SphereSweep&) = delete;

  /// Goes on with more axes: the directions along them and, swept or not, their opposites. A unit
  /// of progress is one sphere in one direction. Returns early when `progress` says so; the other
  /// processes must be told then (see ProcessGroup).
  /// @param subset that they count for, of ErrorSubsets; by default the blocks take turns
  void run(const std::vector<Vec3d>& axes, Progress& progress,
    std::optional<std::size_t> subset = std::nullopt);

  /// Gives back the memory that further directions would need: none may follow.
  void end();

  /// Directions so far, those that the background makes black included.
  [[nodiscard]] int directions() const { return directions_; }
  [[nodiscard]] SweepCounters counters() const
  {
    SweepCounters sum = counters(false);
    sum.add(counters(true));
    return sum;
  }
  /// Those that take part.
  [[nodiscard]] std::size_t spheres() const { return all_; }
  /// Spheres left out since no direction had shown them, summed over the directions swept here.
  [[nodiscard]] std::uint64_t neverSeen() const { return neverSeen_; }
  /// Directions not swept since the background is black there.
  [[nodiscard]] int blackDirections() const { return blackDirections_; }
  [[nodiscard]] unsigned threads() const
  {
    return std::max(threads_, static_cast<unsigned>(tileSweeps_.size()));
  }

private:
  /// Two opposite directions of a block.
  struct AxisJob
  {
    Vec3d axis;
    PlaneBasis basis;
    std::size_t pattern;                    ///< of the points in the texels, for both directions
    bool full;                              ///< all spheres take part
    bool own;                               ///< swept here, not by another process
    std::vector<SweptDirection> directions; ///< without those that are black or not wanted
    bool useClosedCells;
  };

  /// Memory of an axis that is being swept.
  struct Workspace
  {
    SeenMarks seen;
    DepthTiles tiles;
    ClosedCells cells;
    std::vector<OffsetMasks> offsetMasks = std::vector<OffsetMasks>(2);
    std::array<std::uint64_t, 2> closed{}; ///< see TileFiller, by what takes part
  };

  /// Memory of a tile that is being swept.
  struct TileWorkspace
  {
    TileWorkspace(VisibilityRecords& records, SweepDivision* division)
      : sweep(records, division)
    {
    }

    DepthOrder order;
    TileSweep sweep;
  };

  [[nodiscard]] std::size_t blockSize() const;
  void sweepBlock(const std::vector<Vec3d>& axes, std::size_t subset, Progress& progress);
  [[nodiscard]] std::size_t fullAxis(std::size_t axes) const;
  [[nodiscard]] AxisJob makeJob(Vec3d axis, std::size_t index, bool always);
  [[nodiscard]] AxisWeights weightsOf(const AxisJob& job) const;
  void sweepAxis(AxisJob& job, Progress& progress);
  void sweepBand(const SweepScene::Band& band, const AxisJob& job, TileFiller& filler,
    Workspace& work, Progress& progress);
  void sweepTiles(
    const SweepScene::Band& band, const AxisJob& job, Workspace& work, Progress& progress);
  [[nodiscard]] SweepParticipants participants(const AxisJob& job) const;
  void buildOffsetMasks(AxisJob& job, Workspace& work) const;
  void finishBlock();
  void judgeClosedCells(bool full);
  [[nodiscard]] SweepCounters counters(bool full) const;

  const SweepScene& scene_;
  const Background& background_;
  float distance_;
  VisibilityRecords& records_;
  SweepSkips skips_;
  AxisWays ways_;
  std::optional<SweepDivision> division_; ///< none where this process sweeps all axes
  bool useOffsetMasks_;
  std::array<bool, 2> closedCellsPay_; ///< where only spheres ever seen take part, where all do
  std::vector<std::atomic<std::uint8_t>> everSeen_;
  std::vector<BlockBits> allBits_;  ///< by block: the spheres that take part
  std::vector<BlockBits> seenBits_; ///< of these, those that were ever seen, up to the last block
  std::size_t all_ = 0;             ///< their number
  std::size_t seen_ = 0;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  tbb::enumerable_thread_specific<TileWorkspace> tileSweeps_;
  PatternTurns patternTurns_;
  std::size_t blocks_ = 0;
  std::size_t sweptAxes_ = 0; ///< of all processes, those that are black all along left out
  int epoch_ = 0;
  int directions_ = 0; ///< black ones too
  int blackDirections_ = 0;
  std::uint64_t neverSeen_ = 0;
  // Of threads whose memory was given back.
  std::array<SweepCounters, 2> counted_;
  unsigned threads_ = 0;
};
}

#endif
