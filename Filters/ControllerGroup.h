// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ControllerGroup_h
#define po_ControllerGroup_h

#include "ParticleOcclusionFiltersModule.h"
#include "ProcessGroup.h"

#include <functional>
#include <string>

class vtkMultiProcessController;

namespace po
{
/// The processes of a VTK controller, which usually speak MPI.
class PARTICLEOCCLUSIONFILTERS_EXPORT ControllerGroup : public ProcessGroup
{
public:
  /// @param controller borrowed; null for a process alone
  explicit ControllerGroup(vtkMultiProcessController* controller);

  [[nodiscard]] int size() const override { return size_; }
  [[nodiscard]] int rank() const override { return rank_; }

protected:
  [[nodiscard]] std::vector<std::int64_t> exchange(std::int64_t own) const override;
  void transfer(int destination, const Words& own, const std::vector<std::int64_t>& lengths,
    Words& all) const override;

private:
  vtkMultiProcessController* controller_;
  int size_;
  int rank_;
};

/// Runs the part of this process in what the group does together. An exception here stops the work
/// of all; work that was aborted ends without error. What was done is then incomplete.
///
/// @param error what went wrong, empty if nothing did: the same on all processes. With several it
/// says which process it was.
/// @return whether nothing went wrong anywhere
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT bool runTogether(
  const ProcessGroup& group, const std::function<void()>& work, std::string& error);
}

#endif
