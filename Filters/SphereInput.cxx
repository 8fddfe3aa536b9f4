// SPDX-License-Identifier: BSD-3-Clause
#include "SphereInput.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <sstream>
#include <utility>

namespace po
{
namespace
{
Vec3d pointAt(vtkPointSet& points, std::size_t i)
{
  Vec3d p;
  points.GetPoint(static_cast<vtkIdType>(i), &p.x);
  return p;
}
}

std::optional<ParticleInput> readSphereCloud(vtkPointSet& points, const RadiusSettings& settings,
  std::string& error, const FrameChoice& frame, const ProcessGroup& group)
{
  error.clear();
  const auto count = static_cast<std::size_t>(points.GetNumberOfPoints());
  if (group.sum(std::uint64_t(count)) == 0)
  {
    error = "The input has no points: there are no particles.";
    return std::nullopt;
  }
  if (!checkRange(settings, error))
  {
    return std::nullopt;
  }
  const RadiusSettings resolved = resolveRadii(points, settings, group);
  // The arrays of a process without points do not matter.
  const RadiusFunction radiusAt =
    count > 0 ? radiusFunction(points, resolved, error) : [](std::size_t) { return 0.0; };
  if (!radiusAt)
  {
    return std::nullopt;
  }
  ParticleSource source{ count, [&points](std::size_t i) { return pointAt(points, i); },
    [&](std::size_t i) { return settings.scale * radiusAt(i); }, {} };
  if (vtkUnsignedCharArray* ghosts = points.GetPointGhostArray())
  {
    source.isGhost = [ghosts](std::size_t i)
    {
      return (ghosts->GetValue(static_cast<vtkIdType>(i)) & vtkDataSetAttributes::DUPLICATEPOINT) !=
        0;
    };
  }
  SphereCloud cloud = frame.like ? makeSphereCloudLike(*frame.like, source)
                                 : makeSphereCloud(source, group, frame.fit);
  if (group.sum(std::uint64_t(cloud.spheres.size())) == 0)
  {
    error = "No particle is usable. " + describe(cloud.rejected.summed(group));
    return std::nullopt;
  }
  return ParticleInput{ std::move(cloud), resolved };
}

std::string describe(const RejectedParticles& rejected)
{
  if (rejected.total() == 0)
  {
    return {};
  }
  std::ostringstream message;
  message << rejected.total() << " particles are left out:";
  const char* separator = " ";
  const auto add = [&](std::size_t count, const char* reason)
  {
    if (count > 0)
    {
      message << separator << count << " with " << reason;
      separator = ", ";
    }
  };
  add(rejected.nonFinitePosition, "a position that is NaN or infinite");
  add(rejected.nonFiniteRadius, "a radius that is NaN or infinite");
  add(rejected.nonPositiveRadius, "a radius that is zero or negative");
  add(rejected.outOfRange, "a position or radius out of proportion to the mean radius");
  message << '.';
  return message.str();
}
}
