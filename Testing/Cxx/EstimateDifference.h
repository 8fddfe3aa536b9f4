// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_EstimateDifference_h
#define po_EstimateDifference_h

// Judges estimates, in the scenes that all estimators are judged in.

#include "SyntheticSpheres.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <cmath>
#include <cstddef>
#include <vector>

/// How far estimates are from those of a judge.
struct Difference
{
  double rms = 0;  ///< weighted by visible area
  double bias = 0; ///< of the first, weighted by visible area
};

inline Difference compare(const Estimates& ours, const Estimates& judge, int resolution)
{
  Difference difference;
  double area = 0;
  const auto columns = static_cast<std::size_t>(resolution);
  for (std::size_t i = 0; i < judge.values.size(); ++i)
  {
    const double weight =
      po::texelArea(resolution, static_cast<int>(i / columns % columns)) * judge.shares[i];
    const double error = static_cast<double>(ours.values[i]) - judge.values[i];
    difference.rms += weight * error * error;
    difference.bias += weight * error;
    area += weight;
  }
  return { std::sqrt(difference.rms / area), difference.bias / area };
}

inline std::vector<po::Sphere> syntheticScene(po::SyntheticFamily family, std::size_t count)
{
  const po::SyntheticSpheres made = po::makeSyntheticSpheres(family, count, 1);
  std::vector<po::Sphere> spheres;
  for (std::size_t i = 0; i < made.radii.size(); ++i)
  {
    const auto& c = made.centers[i];
    spheres.push_back({ c[0], c[1], c[2], made.radii[i] });
  }
  return spheres;
}

/// Radii of one to ten thousand.
inline std::vector<po::Sphere> wideScene()
{
  po::Random random(17, 0, 0);
  std::vector<po::Sphere> spheres{ { 0, 0, -1000, 1000 } };
  for (int i = 0; i < 80; ++i)
  {
    const auto coordinate = [&] { return static_cast<float>(10 * random.uniform() - 5); };
    const auto radius = static_cast<float>(std::pow(10.0, -1 + 1.5 * random.uniform()));
    spheres.push_back({ coordinate(), coordinate(), coordinate() + 4, radius });
  }
  return spheres;
}

#endif
