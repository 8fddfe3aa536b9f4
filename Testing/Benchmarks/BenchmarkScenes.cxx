// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkScenes.h"

#include "Constants.h"
#include "Random.h"
#include "SyntheticSpheres.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace po
{
namespace
{
constexpr std::uint64_t Seed = 1;

SphereCloud cloudOf(const SyntheticSpheres& spheres)
{
  return makeSphereCloud(
    spheres.radii.size(),
    [&](std::size_t i)
    {
      const auto& center = spheres.centers[i];
      return Vec3d{ static_cast<double>(center[0]), static_cast<double>(center[1]),
        static_cast<double>(center[2]) };
    },
    [&](std::size_t i) { return static_cast<double>(spheres.radii[i]); });
}

/// Log-uniform radii: as many particles from 1 to 10 as from 10 to 100. Equal shares of the volume
/// would leave hardly a large one among any number that can be baked.
SphereCloud makeRatioGas(std::size_t count, double ratio)
{
  std::vector<double> radii(count);
  double volume = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    radii[i] = std::pow(ratio, Random(Seed, i, 0).uniform());
    volume += 4.0 / 3.0 * Pi * radii[i] * radii[i] * radii[i];
  }
  const double side = std::cbrt(volume / GasVolumeFraction);
  return makeSphereCloud(
    count,
    [&](std::size_t i)
    {
      Random random(Seed, i, 1);
      const double x = random.uniform();
      const double y = random.uniform();
      return side * Vec3d{ x, y, random.uniform() };
    },
    [&](std::size_t i) { return radii[i]; });
}

SphereCloud makeLattice(std::size_t count, double radius)
{
  SyntheticSpheres spheres = makeSyntheticSpheres(SyntheticFamily::Overlap, count, Seed);
  std::fill(spheres.radii.begin(), spheres.radii.end(), static_cast<float>(radius));
  return cloudOf(spheres);
}

SphereCloud readScene(const std::string& path)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  vtkDataArray* radius = data->GetPointData()->GetArray("radius");
  if (reader->GetErrorCode() != vtkErrorCode::NoError || !radius)
  {
    throw std::runtime_error("No particles with an array 'radius' could be read from " + path);
  }
  return makeSphereCloud(
    static_cast<std::size_t>(data->GetNumberOfPoints()),
    [&](std::size_t i)
    {
      double point[3];
      data->GetPoint(static_cast<vtkIdType>(i), point);
      return Vec3d{ point[0], point[1], point[2] };
    },
    [&](std::size_t i) { return radius->GetComponent(static_cast<vtkIdType>(i), 0); });
}

/// The number behind "kind:", which must be positive.
double parameterOf(const std::string& name)
{
  const double value = std::strtod(name.c_str() + name.find(':') + 1, nullptr);
  if (!(value > 0) || !std::isfinite(value))
  {
    throw std::runtime_error("A positive number is missing in '" + name + "'");
  }
  return value;
}

bool startsWith(const std::string& text, const std::string& start)
{
  return text.compare(0, start.size(), start) == 0;
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}
}

SphereCloud makeBenchmarkScene(const std::string& name, std::size_t count)
{
  if (const auto family = syntheticFamilyFromName(name))
  {
    return cloudOf(makeSyntheticSpheres(*family, count, Seed));
  }
  if (startsWith(name, "ratio:"))
  {
    return makeRatioGas(count, parameterOf(name));
  }
  if (startsWith(name, "lattice:"))
  {
    return makeLattice(count, parameterOf(name));
  }
  if (endsWith(name, ".vtp"))
  {
    return readScene(name);
  }
  throw std::runtime_error("There is no scene '" + name + "'");
}

Background makeBenchmarkBackground(const std::string& name)
{
  if (name != "half")
  {
    throw std::runtime_error("There is no background '" + name + "'");
  }
  // Rows are interpolated between their centres. With an odd number of them the centre of a black
  // one lies on the horizon; of two rows, light would reach 45 degrees below it.
  constexpr int Width = 4;
  constexpr int Rows = 65;
  std::vector<float> light(std::size_t(Width) * Rows, 0);
  std::fill(light.begin(), light.begin() + Width * (Rows / 2), 1.0f);
  return ImageBackground{ Width, Rows, std::move(light) };
}

std::uint64_t checksum(const SphereCloud& cloud)
{
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const Sphere& sphere : cloud.spheres)
  {
    unsigned char bytes[sizeof(Sphere)];
    std::memcpy(bytes, &sphere, sizeof(Sphere));
    for (const unsigned char byte : bytes)
    {
      hash = (hash ^ byte) * 0x100000001B3ull;
    }
  }
  return hash;
}

std::vector<unsigned> drawParticles(std::size_t particles, std::size_t count)
{
  std::vector<unsigned> drawn(particles);
  std::iota(drawn.begin(), drawn.end(), 0u);
  count = std::min(count, particles);
  Random random(Seed, particles, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto left = static_cast<std::uint32_t>(particles - i);
    std::swap(drawn[i], drawn[i + random.below(left)]);
  }
  drawn.resize(count);
  drawn.shrink_to_fit();
  return drawn;
}
}
