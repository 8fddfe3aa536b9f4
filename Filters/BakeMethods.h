// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeMethods_h
#define po_BakeMethods_h

// The methods of the filter: which one to take, and a bake by it.

#include "OcclusionBaker.h"

#include <cstddef>
#include <vector>

namespace po
{
/// What a bake did; numbers are of all processes together.
struct BakeReport
{
  BakeCounters counters;
  int method = 0; ///< vtkSphereAmbientOcclusion::MethodType, the one that was used
  int directions = 0;
  int samplesUsed = 0;
  double estimatedError = 0;
  double storageDifference = 0; ///< RMS of what storing has changed
  double maximum = 0;           ///< scale of the encoded table
  std::size_t refined = 0;
  std::size_t reused = 0; ///< particles whose textures were taken over from an earlier bake
  std::size_t leftOut = 0;
  std::size_t textureBytes = 0;
  std::size_t occluderSpheres = 0;
  std::size_t occluderTriangles = 0;
  bool loaded = false; ///< from a cache, instead of a bake
};

class BakeReuse;

/// What a process bakes.
struct BakeTask
{
  SphereCloud cloud;               ///< particles of all processes, as far as they matter here
  std::vector<unsigned> receivers; ///< of this process, ascending
  Occluders occluders;             ///< of all processes, as far as they matter here
  BakeSettings settings;
  double targetError = 0;
  bool outOfCore = false;      ///< Sweep keeps what it sees in a temporary file
  bool reuseUnchanged = false; ///< see BakeReuse; Automatic then means a method that suits it
};

/// The numbers in ascending order, each once.
[[nodiscard]] std::vector<unsigned> distinct(std::vector<unsigned> numbers);

/// Can textures of an earlier bake be reused (see BakeReuse)? Automatic then stands for Embree.
[[nodiscard]] bool mayReuse(int method, double maximumDistance, double targetError);

/// The method that Automatic stands for: the same on all processes.
/// Throws std::invalid_argument for a method that cannot bake the task.
[[nodiscard]] int chooseMethod(int method, const BakeTask& task, const ProcessGroup& group);

/// Bakes the receivers and fills the report: method, directions, error, samples, refined, and the
/// counters. With Reference and a target error settings.samplesPerTexel becomes what reaches it.
/// The particles of the task are gone then.
/// @param reuse textures of earlier bakes, for tasks that suit it; takes up those of this one
/// Throws like bakeOcclusion, and std::runtime_error where memory would not do.
[[nodiscard]] BakeResult bakeByMethod(int method, BakeTask& task, const ProcessGroup& group,
  Progress& progress, BakeReport& report, BakeReuse& reuse);
}

#endif
