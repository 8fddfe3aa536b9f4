// SPDX-License-Identifier: BSD-3-Clause
#include "SphereInput.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>
#include <vector>

namespace po
{
namespace
{
/// The median of this many distances is known to a few percent; more would only cost time.
constexpr std::size_t SpacingSamples = 1000;

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

RadiusFunction constantRadii(vtkPointSet& points, double constant, std::string& error)
{
  const double radius = constant > 0 ? constant : estimateRadius(points);
  if (!(radius > 0))
  {
    error = "No radius can be estimated from the spacing, since there are no two distinct finite "
            "points: choose a RadiusArray or set ConstantRadius.";
    return {};
  }
  return [radius](std::size_t) { return radius; };
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

RadiusFunction chooseRadii(vtkPointSet& points, const RadiusSettings& settings, std::string& error)
{
  const bool automatic = settings.array.empty() || settings.array == RadiusSettings::Automatic;
  const std::string name = automatic ? defaultRadiusArray(*points.GetPointData()) : settings.array;
  return name.empty() || name == RadiusSettings::NoArray
    ? constantRadii(points, settings.constant, error)
    : arrayRadii(points, name, error);
}

/// A locator cannot bin points that are not finite.
void copyFinitePoints(vtkPointSet& points, vtkPoints* finite)
{
  finite->SetDataTypeToDouble();
  const auto count = static_cast<std::size_t>(points.GetNumberOfPoints());
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3d p = pointAt(points, i);
    if (isFinite(p))
    {
      finite->InsertNextPoint(&p.x);
    }
  }
}

/// Distance to the nearest point elsewhere; 0 if the nearest few all lie at the same place.
double nearestDistance(vtkStaticPointLocator* locator, vtkPoints* points, vtkIdType id)
{
  constexpr int Neighbors = 4; // the point itself, and some that may coincide with it
  Vec3d p;
  points->GetPoint(id, &p.x);
  vtkNew<vtkIdList> neighbors;
  locator->FindClosestNPoints(Neighbors, &p.x, neighbors);
  double nearest = HUGE_VAL;
  for (const vtkIdType neighbor : *neighbors)
  {
    Vec3d q;
    points->GetPoint(neighbor, &q.x);
    const double distance = length(q - p);
    nearest = distance > 0 ? std::min(nearest, distance) : nearest;
  }
  return std::isfinite(nearest) ? nearest : 0;
}
}

std::string defaultRadiusArray(vtkPointData& data)
{
  for (const char* name : { "radius", "Radius", "rad", "r", "diameter" })
  {
    if (data.HasArray(name))
    {
      return name;
    }
  }
  return {};
}

double estimateRadius(vtkPointSet& points)
{
  vtkNew<vtkPoints> finite;
  copyFinitePoints(points, finite);
  const auto count = static_cast<std::size_t>(finite->GetNumberOfPoints());
  if (count < 2)
  {
    return 0;
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(finite);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();

  std::mt19937_64 random; // the standard's fixed seed: the same radius every time
  std::vector<double> distances;
  for (std::size_t k = 0; k < std::min(count, SpacingSamples); ++k)
  {
    const std::size_t id = count <= SpacingSamples ? k : random() % count;
    const double distance = nearestDistance(locator, finite, static_cast<vtkIdType>(id));
    if (distance > 0)
    {
      distances.push_back(distance);
    }
  }
  if (distances.empty())
  {
    return 0;
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return 0.5 * *middle;
}

std::optional<SphereCloud> readSphereCloud(
  vtkPointSet& points, const RadiusSettings& settings, std::string& error, const SphereCloud* frame)
{
  error.clear();
  const auto count = static_cast<std::size_t>(points.GetNumberOfPoints());
  if (count == 0)
  {
    error = "The input has no points: there are no particles.";
    return std::nullopt;
  }
  if (!checkRange(settings, error))
  {
    return std::nullopt;
  }
  const RadiusFunction radiusAt = chooseRadii(points, settings, error);
  if (!radiusAt)
  {
    return std::nullopt;
  }
  const auto positionAt = [&points](std::size_t i) { return pointAt(points, i); };
  const auto scaledRadiusAt = [&](std::size_t i) { return settings.scale * radiusAt(i); };
  SphereCloud cloud = frame ? makeSphereCloudLike(*frame, count, positionAt, scaledRadiusAt)
                            : makeSphereCloud(count, positionAt, scaledRadiusAt);
  if (cloud.spheres.empty())
  {
    error = "No particle is usable. " + describe(cloud.rejected);
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
