// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ReferenceBake_h
#define po_ReferenceBake_h

#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "TestScenes.h"

#include <cstddef>
#include <vector>

/// All spheres, by the method Reference.
inline po::BakeResult bake(const std::vector<po::Sphere>& spheres, const po::BakeSettings& settings)
{
  po::Progress progress;
  const po::SphereCloud cloud = cloudOf(spheres);
  return po::bakeOcclusion(po::BakeScene(cloud), settings, po::ReferenceEstimator(), progress);
}

/// Of a table of floats.
inline double texelValue(const po::BakeResult& result, std::size_t particle, std::size_t texel)
{
  const int resolution = result.table.resolution;
  const auto row = static_cast<std::size_t>(result.rowOf[particle]);
  return result.table.floats[row * static_cast<std::size_t>(resolution * resolution) + texel];
}

#endif
