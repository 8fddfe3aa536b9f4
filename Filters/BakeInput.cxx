// SPDX-License-Identifier: BSD-3-Clause
#include "BakeInput.h"

#include "BakeParameters.h"
#include "BakedData.h"
#include "CropSettings.h"
#include "OccluderInput.h"
#include "ParticleIds.h"
#include "SharedSpheres.h"
#include "vtkSphereAmbientOcclusion.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace po
{
namespace
{
SphereCloud readParticles(BakeInput& input, const RadiusSettings& radii,
  const std::vector<vtkPointSet*>& blocks, FrameFit fit, const ProcessGroup& group)
{
  std::string error;
  std::optional<ParticleInput> particles =
    readBlocks(blocks, radii, error, { nullptr, fit }, group);
  if (!particles)
  {
    throw std::invalid_argument(error);
  }
  input.radiusUsed = describe(radii, particles->radii);
  return std::move(particles->cloud);
}

/// Takes the spheres that are hidden out of a cloud.
void removeHidden(SphereCloud& cloud, const std::vector<std::uint8_t>& hidden)
{
  const auto keep = [&](auto& list)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      if (hidden[i] == 0)
      {
        list[kept++] = list[i];
      }
    }
    list.resize(kept);
  };
  keep(cloud.spheres);
  keep(cloud.centers);
  keep(cloud.sourceIds);
  keep(cloud.ghosts);
}

/// Leaves out what the user crops. The frame of the cloud stays that of all particles.
/// @return how many particles of all processes these are, ghosts aside
std::uint64_t cropParticles(SphereCloud& own, const CropSettings& settings,
  const std::vector<vtkPointSet*>& blocks, const ProcessGroup& group)
{
  std::string warning;
  Cropping cropping;
  cropping.ranges = valueRangesOf(blocks, rangesOf(settings), warning);
  if (!warning.empty())
  {
    throw std::invalid_argument("CropArray: " + warning);
  }
  for (const CropPlane& plane : planesOf(settings))
  {
    cropping.halfSpaces.push_back({ plane.normal, -dot(plane.normal, plane.origin) });
  }
  if (cropping.empty())
  {
    return 0;
  }
  const std::vector<std::uint8_t> hidden = hideSpheres(own, cropping);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < hidden.size(); ++i)
  {
    count += hidden[i] != 0 && (own.ghosts.empty() || own.ghosts[i] == 0);
  }
  removeHidden(own, hidden);
  if (group.sum(std::uint64_t(own.spheres.size())) == 0)
  {
    throw std::invalid_argument("The crop leaves no particle to bake: choose other values of "
                                "CropRange, CropPlane or CropBox.");
  }
  return group.sum(count);
}

/// Numbers of the particles in the order of the task's cloud, any for those of other processes;
/// empty without ids. Of particles that share a place the smallest counts, whatever their order.
std::vector<std::uint64_t> idsByPlace(const std::vector<std::uint64_t>& idOfPoint,
  const SphereCloud& own, const std::vector<unsigned>& places, std::size_t spheres)
{
  constexpr std::uint64_t None = std::numeric_limits<std::uint64_t>::max();
  if (idOfPoint.empty())
  {
    return {};
  }
  std::vector<std::uint64_t> ids(spheres, None);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    std::uint64_t& id = ids[places[i]];
    id = std::min(id, idOfPoint[static_cast<std::size_t>(own.sourceIds[i])]);
  }
  return ids;
}

/// Tells which receivers the points are.
/// @param places of the particles in the cloud of the task, among which the receivers are
void findPoints(BakeInput& input, const SphereCloud& own, const std::vector<unsigned>& places,
  const std::vector<vtkPointSet*>& blocks)
{
  std::size_t points = 0;
  for (vtkPointSet* block : blocks)
  {
    points += static_cast<std::size_t>(block->GetNumberOfPoints());
  }
  input.points.assign(points, NoReceiver);
  input.ghosts.assign(own.ghosts.empty() ? 0 : points, 0);
  const std::vector<unsigned>& receivers = input.task.receivers;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const auto point = static_cast<std::size_t>(own.sourceIds[i]);
    const auto receiver = std::lower_bound(receivers.begin(), receivers.end(), places[i]);
    input.points[point] = static_cast<std::uint32_t>(receiver - receivers.begin());
    if (!own.ghosts.empty())
    {
      input.ghosts[point] = own.ghosts[i];
    }
  }
}

/// Exchanges particles and occluders with the other processes.
void makeTask(BakeInput& input, SphereCloud own, Occluders occluders,
  const std::vector<std::uint64_t>& idOfPoint, const BakeSettings& settings,
  const std::vector<vtkPointSet*>& blocks, FrameFit fit, const ProcessGroup& group)
{
  const Neighbourhood neighbourhood(own.spheres, own.toLocalReach(settings.maximumDistance), group);
  SharedSpheres shared =
    shareSpheres(std::move(own.spheres), own.ghosts, neighbourhood, group, own.centers, fit);
  own.centers = {};

  BakeTask& task = input.task;
  task.cloud.origin = own.origin;
  task.cloud.scale = own.scale;
  task.cloud.spheres = std::move(shared.spheres);
  task.cloud.centers = std::move(shared.centers);
  task.cloud.ids = idsByPlace(idOfPoint, own, shared.places, task.cloud.spheres.size());
  task.receivers = distinct(shared.places);
  task.occluders = shareOccluders(std::move(occluders), neighbourhood, group, fit);
  task.settings = settings;
  findPoints(input, own, shared.places, blocks);
}
}

BakeInput readBakeInput(vtkSphereAmbientOcclusion& filter, const BakeSettings& settings,
  const std::vector<vtkPointSet*>& blocks, vtkDataObject* occluders, const ProcessGroup& group)
{
  BakeInput input;
  // Floats of what rests must stay for its textures to stay.
  const bool reuse = reusesTextures(filter);
  const FrameFit fit = reuse ? FrameFit::Steady : FrameFit::Exact;
  SphereCloud own = readParticles(input, radiiOf(filter), blocks, fit, group);
  const std::vector<std::uint64_t> idOfPoint = readIds(blocks, idArrayOf(filter), group);
  OccluderInput others = readOccluders(occluders, radiiOf(filter), own, group);

  const std::uint64_t cropped = cropParticles(own, cropOf(filter), blocks, group);
  const RejectedParticles rejected = own.rejected.summed(group);
  input.report.leftOut = rejected.total() + cropped;
  input.report.occluderSpheres = group.sum(std::uint64_t(others.occluders.spheres.size()));
  input.report.occluderTriangles = group.sum(std::uint64_t(others.occluders.mesh.triangles.size()));
  if (group.rank() == 0)
  {
    input.warnings = std::move(others.warnings);
    if (rejected.total() > 0)
    {
      input.warnings.insert(input.warnings.begin(), describe(rejected));
    }
  }
  makeTask(
    input, std::move(own), std::move(others.occluders), idOfPoint, settings, blocks, fit, group);
  input.task.targetError = filter.GetTargetError();
  input.task.outOfCore = filter.GetOutOfCore();
  input.task.reuseUnchanged = reuse;
  return input;
}
}
