// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepDivision_h
#define po_SweepDivision_h

#include "MaskCode.h"
#include "ProcessGroup.h"
#include "VisibilityRecords.h"

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace po
{
/// How processes that have the same spheres divide a sweep: axes take turns. The process that
/// sweeps one finds what all particles see along it, and sends that to those who have listed them.
/// What decides how the sweep goes on is exchanged too, so that its result has the same bits for
/// any number of processes.
///
/// All must call the functions other than keep() in the same order, on one thread; they throw
/// WorkStopped when another process does not go on.
class SweepDivision
{
public:
  /// @param group of more than one process
  /// @param records of this process: what it has listed, and where what the others send is kept
  SweepDivision(const ProcessGroup& group, VisibilityRecords& records);

  /// Does this process sweep the axis that has this number among all axes of the sweep?
  [[nodiscard]] bool isOwn(std::size_t axis) const
  {
    return axis % static_cast<std::size_t>(group_.size()) ==
      static_cast<std::size_t>(group_.rank());
  }

  /// Takes what a direction of axis `axis` of the block sees of a sphere, for the processes that
  /// have listed it. Threads may call this at once.
  /// @param facing [groups] the texels that face it; `mask` has no others
  void keep(
    unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing, const GroupMask* mask);

  /// Hands over what keep() took of a block, and what was found out about spheres.
  /// @param axes of the block
  /// @param everSeen marks by sphere; those that any process has set are set
  void deliver(
    const std::vector<AxisWeights>& axes, std::vector<std::atomic<std::uint8_t>>& everSeen);

  [[nodiscard]] std::uint64_t sum(std::uint64_t own) const { return group_.sum(own); }

private:
  static constexpr int Nobody = -1;

  /// Codes of masks by axis of the block and process.
  using Outbox = std::vector<MaskWords>;

  void findReaders();
  void write(int reader, unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing,
    const GroupMask* mask);
  void deliverMasks(const std::vector<AxisWeights>& axes);
  [[nodiscard]] ProcessGroup::Words letterTo(int reader);
  void read(const ProcessGroup::Words& letters, const std::vector<AxisWeights>& axes);
  void readMasks(std::size_t axis, const AxisWeights& weights, const MaskWords& codes);

  const ProcessGroup& group_;
  std::size_t groups_;
  VisibilityRecords& records_;
  std::vector<std::int32_t> reader_; ///< by sphere: another process that has listed it, or Nobody
  std::unordered_map<unsigned, std::vector<int>> furtherReaders_; ///< by sphere
  tbb::enumerable_thread_specific<Outbox> outboxes_;
};
}

#endif
