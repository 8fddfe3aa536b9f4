// SPDX-License-Identifier: BSD-3-Clause
#include "SphereInput.h"

#include "RadiusEstimate.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <sstream>

namespace po
{
namespace
{
constexpr std::array<const char*, 5> DefaultRadiusArrays = { "radius", "Radius", "rad", "r",
  "diameter" };

/// Radius of a particle in world units, before scaling.
using RadiusFunction = std::function<double(std::size_t)>;

Vec3d pointAt(vtkPointSet& points, std::size_t i)
{
  Vec3d p;
  points.GetPoint(static_cast<vtkIdType>(i), &p.x);
  return p;
}

bool isDiameter(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name == "diameter";
}

std::string listArrays(vtkPointData& data)
{
  std::string names;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
  {
    const char* name = data.GetArrayName(i);
    names += (names.empty() ? "" : ", ") + std::string(name ? name : "(unnamed)");
  }
  return names.empty() ? "The input has no point arrays."
                       : "The point arrays of the input are: " + names + ".";
}

/// The array of that name, if radii can be read from it.
vtkDataArray* findRadii(vtkPointSet& points, const std::string& name, std::string& error)
{
  vtkPointData& data = *points.GetPointData();
  vtkAbstractArray* found = data.GetAbstractArray(name.c_str());
  auto* radii = vtkDataArray::SafeDownCast(found);
  std::ostringstream message;
  if (!found)
  {
    message << "RadiusArray: there is no point array '" << name << "'. " << listArrays(data);
  }
  else if (!radii)
  {
    message << "RadiusArray: the point array '" << name << "' is not numeric ("
            << found->GetClassName() << "); choose an array of one number a particle.";
  }
  else if (radii->GetNumberOfComponents() != 1)
  {
    message << "RadiusArray: the point array '" << name << "' has "
            << radii->GetNumberOfComponents()
            << " components; a radius needs exactly one. Choose another array.";
  }
  else if (radii->GetNumberOfTuples() != points.GetNumberOfPoints())
  {
    message << "RadiusArray: the point array '" << name << "' has " << radii->GetNumberOfTuples()
            << " values for " << points.GetNumberOfPoints()
            << " points; there must be one a point.";
  }
  error = message.str();
  return error.empty() ? radii : nullptr;
}

bool checkRange(const RadiusSettings& settings, std::string& error)
{
  std::ostringstream message;
  if (!(settings.scale > 0) || !std::isfinite(settings.scale))
  {
    message << "RadiusScale must be a positive number, but is " << settings.scale << ".";
  }
  else if (!(settings.constant >= 0) || !std::isfinite(settings.constant))
  {
    message << "ConstantRadius must be positive, or 0 for an estimate from the spacing, but is "
            << settings.constant << ".";
  }
  error = message.str();
  return error.empty();
}

RadiusFunction arrayRadii(vtkPointSet& points, const std::string& name, std::string& error)
{
  vtkDataArray* radii = findRadii(points, name, error);
  if (!radii)
  {
    return {};
  }
  const double factor = isDiameter(name) ? 0.5 : 1.0;
  return [radii, factor](std::size_t i)
  { return factor * radii->GetComponent(static_cast<vtkIdType>(i), 0); };
}

/// @param settings as resolveRadii gives them
RadiusFunction radiusFunction(
  vtkPointSet& points, const RadiusSettings& settings, std::string& error)
{
  if (settings.array != RadiusSettings::NoArray)
  {
    return arrayRadii(points, settings.array, error);
  }
  if (!(settings.constant > 0))
  {
    error = "No radius can be estimated from the spacing, since there are no two distinct finite "
            "points: choose a RadiusArray or set ConstantRadius.";
    return {};
  }
  return [radius = settings.constant](std::size_t) { return radius; };
}

/// The first default array that no process with points lacks, or NoArray.
std::string defaultRadiusArray(vtkPointSet& points, const ProcessGroup& group)
{
  std::uint64_t missing = 0;
  for (std::size_t i = 0; i < DefaultRadiusArrays.size(); ++i)
  {
    const bool lacks =
      points.GetNumberOfPoints() > 0 && !points.GetPointData()->HasArray(DefaultRadiusArrays[i]);
    missing |= std::uint64_t(lacks) << i;
  }
  for (const std::uint64_t missingElsewhere : group.gather({ missing }))
  {
    missing |= missingElsewhere;
  }
  for (std::size_t i = 0; i < DefaultRadiusArrays.size(); ++i)
  {
    if ((missing >> i & 1) == 0)
    {
      return DefaultRadiusArrays[i];
    }
  }
  return RadiusSettings::NoArray;
}
}

RadiusSettings resolveRadii(
  vtkPointSet& points, const RadiusSettings& settings, const ProcessGroup& group)
{
  RadiusSettings resolved = settings;
  if (settings.array.empty() || settings.array == RadiusSettings::Automatic)
  {
    resolved.array = defaultRadiusArray(points, group);
  }
  if (resolved.array == RadiusSettings::NoArray && settings.constant == 0)
  {
    resolved.constant = estimateRadius(points, group);
  }
  return resolved;
}

std::optional<SphereCloud> readSphereCloud(vtkPointSet& points, const RadiusSettings& settings,
  std::string& error, const SphereCloud* frame, const ProcessGroup& group)
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
  SphereCloud cloud = frame ? makeSphereCloudLike(*frame, source) : makeSphereCloud(source, group);
  if (group.sum(std::uint64_t(cloud.spheres.size())) == 0)
  {
    error = "No particle is usable. " + describe(cloud.rejected.summed(group));
    return std::nullopt;
  }
  return cloud;
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
