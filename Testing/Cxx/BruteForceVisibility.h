// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BruteForceVisibility_h
#define po_BruteForceVisibility_h

#include "Random.h"
#include "Sampling.h"
#include "Sphere.h"
#include "TexelMap.h"

#include <cmath>
#include <limits>
#include <vector>

/// An independent judge of baked values: double precision, every sphere tested against every ray,
/// no code of the product's intersection or overlap tests. For small scenes only.
namespace bruteforce
{
inline bool inside(const po::Sphere& s, po::Vec3d p)
{
  const po::Vec3d d = p - s.center().as<double>();
  return po::dot(d, d) < static_cast<double>(s.radius) * static_cast<double>(s.radius);
}

/// Does the ray from p (outside s) meet s within `distance`?
inline bool hits(const po::Sphere& s, po::Vec3d p, po::Vec3d direction, double distance)
{
  const po::Vec3d toCenter = s.center().as<double>() - p;
  const double along = po::dot(toCenter, direction);
  const double r = s.radius;
  const double discriminant = along * along - (po::dot(toCenter, toCenter) - r * r);
  return along > 0 && discriminant > 0 && along - std::sqrt(discriminant) < distance;
}

struct Texel
{
  double value = 0;        ///< mean visibility of the outside part
  double outsideShare = 0; ///< share of the texel's area outside all other spheres
};

/// Visibility of texel (row, column) of sphere `id` with side^2 points of `rays` rays each.
inline Texel texel(const std::vector<po::Sphere>& spheres, std::size_t id, int resolution, int row,
  int column, int side = 8, int rays = 256,
  double distance = std::numeric_limits<double>::infinity())
{
  const po::Sphere& self = spheres[id];
  const po::StratifiedSquare strata(rays);
  po::Random random(20040501, id, po::texelIndex(resolution, row, column));
  int outside = 0;
  int open = 0;
  for (int k = 0; k < side * side; ++k)
  {
    const double s = (k % side + 0.5) / side;
    const double t = (k / side + 0.5) / side;
    const po::Vec3d normal = po::texelPoint(resolution, row, column, s, t);
    const po::Vec3d p = self.center().as<double>() + static_cast<double>(self.radius) * normal;
    bool buried = false;
    for (std::size_t j = 0; j < spheres.size() && !buried; ++j)
    {
      buried = j != id && inside(spheres[j], p);
    }
    if (buried)
    {
      continue;
    }
    ++outside;
    for (int r = 0; r < rays; ++r)
    {
      const po::Point2 square = strata.point(r, random.uniform(), random.uniform());
      const po::Vec3d direction = po::aboutNormal(normal, po::cosineHemisphereFromSquare(square));
      bool blocked = false;
      for (std::size_t j = 0; j < spheres.size() && !blocked; ++j)
      {
        blocked = j != id && hits(spheres[j], p, direction, distance);
      }
      open += blocked ? 0 : 1;
    }
  }
  return { outside > 0 ? static_cast<double>(open) / (static_cast<double>(outside) * rays) : 0,
    static_cast<double>(outside) / (side * side) };
}
}

#endif
