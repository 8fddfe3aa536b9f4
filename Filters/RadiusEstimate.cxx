// SPDX-License-Identifier: BSD-3-Clause
#include "RadiusEstimate.h"

#include "Random.h"
#include "Vec3.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace po
{
namespace
{
/// The median of this many distances is known to a few percent; more would only cost time.
constexpr std::size_t SpacingSamples = 1000;

/// A point whose neighbours are looked for. The smallest keys make a random choice that does not
/// depend on who has which points.
struct Sample
{
  std::uint64_t key;
  Vec3d position;

  [[nodiscard]] auto identity() const
  {
    return std::make_tuple(key, position.x, position.y, position.z);
  }
  bool operator<(const Sample& other) const { return identity() < other.identity(); }
  bool operator==(const Sample& other) const { return identity() == other.identity(); }
};

Sample sampleAt(Vec3d position)
{
  std::uint64_t key = 0;
  for (const double coordinate : { position.x, position.y, position.z })
  {
    key = mixBits(key + wordOf(coordinate));
  }
  return { key, position };
}

/// A locator cannot bin points that are not finite.
void copyFinitePoints(vtkPointSet& points, vtkPoints* finite)
{
  finite->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < points.GetNumberOfPoints(); ++i)
  {
    Vec3d p;
    points.GetPoint(i, &p.x);
    if (isFinite(p))
    {
      finite->InsertNextPoint(&p.x);
    }
  }
}

/// The distinct ones with the smallest keys.
void keepSmallest(std::vector<Sample>& samples)
{
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  samples.resize(std::min(samples.size(), SpacingSamples));
}

std::vector<Sample> chooseSamples(vtkPoints* points, const ProcessGroup& group)
{
  std::vector<Sample> samples;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Vec3d p;
    points->GetPoint(i, &p.x);
    samples.push_back(sampleAt(p));
  }
  keepSmallest(samples);
  ProcessGroup::Words words;
  for (const Sample& s : samples)
  {
    words.insert(words.end(), { wordOf(s.position.x), wordOf(s.position.y), wordOf(s.position.z) });
  }
  words = group.gather(words);
  samples.clear();
  for (std::size_t i = 0; i + 2 < words.size(); i += 3)
  {
    samples.push_back(
      sampleAt({ doubleOf(words[i]), doubleOf(words[i + 1]), doubleOf(words[i + 2]) }));
  }
  keepSmallest(samples);
  return samples;
}

/// Distance to the nearest point elsewhere; infinite if the nearest few all lie at the same place.
double nearestDistance(vtkStaticPointLocator* locator, vtkPoints* points, Vec3d p)
{
  constexpr int Neighbors = 4; // the point itself, and some that may coincide with it
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
  return nearest;
}

/// To the points of this process alone, as words.
ProcessGroup::Words nearestDistances(vtkPoints* points, const std::vector<Sample>& samples)
{
  ProcessGroup::Words distances(samples.size(), wordOf(HUGE_VAL));
  if (points->GetNumberOfPoints() == 0)
  {
    return distances;
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  std::transform(samples.begin(), samples.end(), distances.begin(),
    [&](const Sample& s) { return wordOf(nearestDistance(locator, points, s.position)); });
  return distances;
}
}

double estimateRadius(vtkPointSet& points, const ProcessGroup& group)
{
  vtkNew<vtkPoints> finite;
  copyFinitePoints(points, finite);
  const std::vector<Sample> samples = chooseSamples(finite, group);
  const ProcessGroup::Words words = group.gather(nearestDistances(finite, samples));
  std::vector<double> distances;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    double nearest = HUGE_VAL;
    for (std::size_t k = i; k < words.size(); k += samples.size())
    {
      nearest = std::min(nearest, doubleOf(words[k]));
    }
    if (std::isfinite(nearest))
    {
      distances.push_back(nearest);
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
}
