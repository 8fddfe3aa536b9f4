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
#include <memory>
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
SweepOptions sweepFor(const BakeTask& task)
{
  SweepOptions options;
  options.targetError = task.targetError;
  options.outOfCore = task.outOfCore || memoryOf(task, SweepEstimator(options)) > freeMemory();
  return options;
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
    , particles_(static_cast<double>(task.receivers.size()))
  {
  }

  BakeResult bySweep()
  {
    SweepOptions options = sweepFor(task_);
    requireMemory(memoryOf(task_, SweepEstimator(options)), task_.receivers.size());
    std::vector<unsigned> particles = std::move(task_.receivers);
    if (task_.occluders.spheres.empty())
    {
      sortForSweep(task_.cloud, particles);
    }
    auto scene = makeScene(task_);
    if (!task_.settings.light) // which is mixed in later
    {
      options.afterSweep = [&scene]
      {
        scene.reset();
        returnFreeMemory();
      };
    }
    const SweepEstimator sweep(options);
    BakeResult result = bakeOcclusion(*scene, particles, task_.settings, sweep, progress_);
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
    const auto scene = makeScene(task_);
    const PilotResult pilot = samplesForError(
      *scene, task_.receivers, task_.settings, reference, task_.targetError, progress_);
    task_.settings.samplesPerTexel = pilot.samplesPerTexel;
    BakeResult result =
      bakeOcclusion(*scene, task_.receivers, task_.settings, reference, progress_);
    finish(result, 0, pilot.estimatedError, true);
    return result;
  }

private:
  /// Takes over the particles of a task.
  std::unique_ptr<const BakeScene> makeScene(BakeTask& task)
  {
    auto scene = std::make_unique<const BakeScene>(std::move(task.cloud), task.occluders, group_);
    returnFreeMemory(); // of what has read and sorted the particles
    return scene;
  }

  /// By a method that can reuse textures; in the order of the receivers.
  BakeResult bakeChanges(const OcclusionEstimator& estimator)
  {
    requireMemory(memoryOf(task_, estimator) + (reuses_ ? reuse_.bytesMissing(task_) : 0),
      task_.receivers.size());
    if (!reuses_)
    {
      return bakeOcclusion(
        *makeScene(task_), task_.receivers, task_.settings, estimator, progress_);
    }
    std::optional<BakeTask> changed = reuse_.begin(report_.method, task_);
    BakeTask& part = changed ? *changed : task_;
    BakeResult result = bakeOcclusion(
      *makeScene(part), part.receivers, part.settings, estimator, progress_, reuse_.textures());
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
    report_.estimatedError = errorIsOfAll ? error : errorOfAll(error, particles_, group_);
    report_.storageDifference =
      errorOfAll(result.table.difference, result.table.comparedArea, group_);
    report_.maximum = result.table.maximum;
  }

  BakeTask& task_;
  const ProcessGroup& group_;
  Progress& progress_;
  BakeReport& report_;
  BakeReuse& reuse_;
  bool reuses_;      ///< does the task suit it?
  double particles_; ///< how many
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
  const bool full = group.any(memoryOf(task, SweepEstimator(sweepFor(task))) > freeMemory());
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
