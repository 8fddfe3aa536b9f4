// SPDX-License-Identifier: BSD-3-Clause
#include "BakeMethods.h"

#include "BakeReuse.h"
#include "EmbreeEstimator.h"
#include "ErrorPilot.h"
#include "FreeMemory.h"
#include "HeapMemory.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "SweepOrder.h"
#include "vtkSphereAmbientOcclusion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace po
{
namespace
{
double memoryOf(const BakeTask& task, const OcclusionEstimator& estimator)
{
  const std::size_t foreign = task.cloud.spheres.size() - task.receivers.size();
  return bakeMemory(task.receivers.size(), task.settings, estimator) +
    occluderMemory(foreign + task.occluders.spheres.size(), task.occluders.mesh.triangles.size());
}

/// A sweep in memory, or out of core where the user wants that or memory would not do.
SweepEstimator sweepFor(const BakeTask& task)
{
  SweepOptions options;
  options.targetError = task.targetError;
  options.outOfCore = task.outOfCore || memoryOf(task, SweepEstimator(options)) > freeMemory();
  return SweepEstimator(options);
}

/// The RMS of what all processes have, each with a weight.
double errorOfAll(double own, double weight, const ProcessGroup& group)
{
  const double squares = group.sum(weight * own * own);
  const double weights = group.sum(weight);
  return weights > 0 ? std::sqrt(squares / weights) : 0;
}

/// One bake by any method.
class MethodBake
{
public:
  MethodBake(BakeTask& task, const ProcessGroup& group, Progress& progress, BakeReport& report,
    BakeReuse& reuse)
    : task_(task)
    , group_(group)
    , progress_(progress)
    , report_(report)
    , reuse_(reuse)
    , reuses_(BakeReuse::suits(report.method, task))
  {
  }

  BakeResult bySweep()
  {
    const SweepEstimator sweep = sweepFor(task_);
    requireMemory(memoryOf(task_, sweep), task_.receivers.size());
    std::vector<unsigned> particles = task_.receivers;
    if (task_.occluders.spheres.empty())
    {
      sortForSweep(task_.cloud, particles);
    }
    BakeResult result = bake(sweep, particles);
    finish(result, sweep.report().directions, sweep.report().estimatedError, task_.targetError > 0);
    report_.refined = result.aborted ? 0 : group_.sum(std::uint64_t(sweep.report().refined));
    return result;
  }

  BakeResult byEmbree()
  {
    EmbreeOptions options;
    options.targetError = task_.targetError;
    const EmbreeEstimator embree(options);
    BakeResult result = bakeChanges(embree);
    const auto& [directions, error, reached, above] = embree.report();
    if (reuses_)
    {
      finish(result, reuse_.mostDirections(directions), reuse_.textures().estimatedError(), false);
    }
    else
    {
      finish(result, directions, error, false);
    }
    return result;
  }

  BakeResult byReference()
  {
    const ReferenceEstimator reference;
    if (task_.targetError == 0)
    {
      BakeResult result = bakeChanges(reference);
      finish(result, 0, 0, true);
      return result;
    }
    requireMemory(memoryOf(task_, reference), task_.receivers.size());
    const BakeScene scene(std::move(task_.cloud), task_.occluders, group_);
    const PilotResult pilot = samplesForError(
      scene, task_.receivers, task_.settings, reference, task_.targetError, progress_);
    task_.settings.samplesPerTexel = pilot.samplesPerTexel;
    BakeResult result = bakeOcclusion(scene, task_.receivers, task_.settings, reference, progress_);
    finish(result, 0, pilot.estimatedError, true);
    return result;
  }

private:
  BakeResult bake(const OcclusionEstimator& estimator, const std::vector<unsigned>& particles)
  {
    const BakeScene scene(std::move(task_.cloud), task_.occluders, group_);
    returnFreeMemory(); // of what has read and sorted the particles
    return bakeOcclusion(scene, particles, task_.settings, estimator, progress_);
  }

  /// By a method that can reuse textures; in the order of the receivers.
  BakeResult bakeChanges(const OcclusionEstimator& estimator)
  {
    requireMemory(memoryOf(task_, estimator) + (reuses_ ? reuse_.bytesMissing(task_) : 0),
      task_.receivers.size());
    if (!reuses_)
    {
      return bake(estimator, task_.receivers);
    }
    std::optional<BakeTask> changed = reuse_.begin(report_.method, task_);
    BakeTask& part = changed ? *changed : task_;
    const BakeScene scene(std::move(part.cloud), part.occluders, group_);
    BakeResult result =
      bakeOcclusion(scene, part.receivers, part.settings, estimator, progress_, reuse_.textures());
    if (!result.aborted)
    {
      reuse_.commit();
      report_.reused = group_.sum(std::uint64_t(reuse_.textures().reused()));
    }
    return result;
  }

  /// @param errorIsOfAll whether the estimator has found it over all processes
  void finish(const BakeResult& result, int directions, double error, bool errorIsOfAll)
  {
    if (result.aborted)
    {
      return; // the others are told elsewhere, and exchange nothing any more
    }
    report_.counters = result.counters.summed(group_);
    report_.directions = static_cast<int>(group_.largest(directions));
    report_.samplesUsed = task_.settings.samplesPerTexel;
    report_.estimatedError =
      errorIsOfAll ? error : errorOfAll(error, double(task_.receivers.size()), group_);
    report_.storageDifference =
      errorOfAll(result.table.difference, result.table.comparedArea, group_);
    report_.maximum = result.table.maximum;
  }

  BakeTask& task_;
  const ProcessGroup& group_;
  Progress& progress_;
  BakeReport& report_;
  BakeReuse& reuse_;
  bool reuses_; ///< does the task suit it?
};
}

std::vector<unsigned> distinct(std::vector<unsigned> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

bool mayReuse(int method, double maximumDistance, double targetError)
{
  using Filter = vtkSphereAmbientOcclusion;
  // Sweep leaves out spheres for what others hide, and Reference with a target takes as many rays
  // as the whole set needs.
  const bool isLocal = method != Filter::Sweep && !(method == Filter::Reference && targetError > 0);
  return isLocal && maximumDistance > 0;
}

int chooseMethod(int method, const BakeTask& task, const ProcessGroup& group)
{
  const bool triangles = group.any(!task.occluders.mesh.triangles.empty());
  if (method == vtkSphereAmbientOcclusion::Sweep && triangles)
  {
    throw std::invalid_argument("Method Sweep does not see the triangles of the input Occluders: "
                                "choose the Method Automatic or Embree.");
  }
  if (method != vtkSphereAmbientOcclusion::Automatic)
  {
    return method;
  }
  // Sweep is the fastest one for whole sets, wherever its memory is there, but knows spheres only.
  // Within about two radii the near spheres, which Embree's method tests without rays, are all
  // there is: it was 1.1 to 1.8 times as fast up to that, and half as fast or less at five.
  const double distance = task.settings.maximumDistance;
  // Where textures are to be reused, parts of the set are baked.
  const bool close = distance > 0 && (task.reuseUnchanged || distance <= 2 * task.cloud.scale);
  const bool full = group.any(memoryOf(task, sweepFor(task)) > freeMemory());
  return triangles || close || full ? vtkSphereAmbientOcclusion::Embree
                                    : vtkSphereAmbientOcclusion::Sweep;
}

BakeResult bakeByMethod(int method, BakeTask& task, const ProcessGroup& group, Progress& progress,
  BakeReport& report, BakeReuse& reuse)
{
  report.method = method;
  MethodBake bake(task, group, progress, report, reuse);
  switch (method)
  {
    case vtkSphereAmbientOcclusion::Sweep:
      return bake.bySweep();
    case vtkSphereAmbientOcclusion::Embree:
      return bake.byEmbree();
    default:
      return bake.byReference();
  }
}
}
