// SPDX-License-Identifier: BSD-3-Clause
#include "FreeLength.h"

#include "Constants.h"
#include "ThreadGroup.h"
#include "TracedSilhouetteTestScene.h"

#include <cmath>
#include <limits>

using namespace traced_silhouettes;

namespace
{
using Spheres = std::vector<std::array<double, 4>>;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double VolumeFraction = 0.01;

/// At random in a cube, radius 1; the seed is fixed.
Spheres gas(std::size_t count)
{
  const double edge = std::cbrt(4.0 / 3.0 * Pi * static_cast<double>(count) / VolumeFraction);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0, edge);
  Spheres spheres(count);
  for (auto& sphere : spheres)
  {
    sphere = { place(random), place(random), place(random), 1 };
  }
  return spheres;
}

/// On a cubic lattice of so many sites a side, touching, radius 1.
Spheres lattice(int side)
{
  Spheres spheres;
  for (int i = 0; i < side * side * side; ++i)
  {
    spheres.push_back({ 2.0 * (i % side), 2.0 * (i / side % side), 2.0 * (i / side / side), 1 });
  }
  return spheres;
}

double freeLength(const Spheres& spheres)
{
  const SphereCloud cloud = cloudOf(spheres);
  return meanFreeLength(cloud, { static_cast<double>(spheres.size()), cloud.scale });
}

/// Share of the rays that meet a sphere and, behind it, another one farther away than the jump.
double jumpShare(const Traced& traced, double jump)
{
  const TracedFrame& front = traced.renderer.frame();
  TracedFrame behind;
  const SphereScene scene(traced.renderer.cloud().spheres);
  traceBehind(
    scene, traced.renderer.rays(), {}, front, std::vector<std::uint8_t>(front.pixels(), 1), behind);
  std::size_t larger = 0;
  for (std::size_t pixel = 0; pixel < front.pixels(); ++pixel)
  {
    const double step = behind.t[pixel] - front.t[pixel];
    larger += step > jump && behind.t[pixel] < Infinity;
  }
  return static_cast<double>(larger) / static_cast<double>(front.pixels());
}

/// Share of the pixels that have a line, whole pixels.
double lineShare(const Traced& traced, const SilhouetteScale& scale)
{
  SilhouetteParameters parameters;
  parameters.samples = 1;
  parameters.backgroundLines = false;
  SilhouetteImage image;
  findTracedSilhouettes(TracedDepth({ traced.layer() }), resolve(parameters, scale), image);
  return static_cast<double>(count(image.strength)) / static_cast<double>(image.strength.size());
}
}

/// Lines meet spheres of a gas every 1 / (n pi r^2) = 4 r / (3 x volume fraction).
TEST(FreeLength, OfAGasIsThatOfKineticTheory)
{
  const double exact = 4.0 / 3.0 / VolumeFraction - 4.0 / 3.0;
  EXPECT_NEAR(freeLength(gas(10000)), exact, 0.12 * exact); // the box cuts its outermost cells
  EXPECT_NEAR(freeLength(gas(200000)), exact, 0.05 * exact);
}

TEST(FreeLength, OfWhatTouchesIsAFewRadiiHoweverEmptyItsBoxIs)
{
  // Of the volume of a cubic lattice pi / 6 is full, less at its surface.
  const double inside = 4.0 / 3.0 / (Pi / 6) - 4.0 / 3.0;
  EXPECT_NEAR(freeLength(lattice(40)), inside, 0.5 * inside);
  Spheres apart = lattice(20);
  for (auto& sphere : lattice(20))
  {
    apart.push_back({ sphere[0] + 1e5, sphere[1], sphere[2], 1 });
  }
  EXPECT_NEAR(freeLength(apart), inside, inside);
}

TEST(FreeLength, ScalesWithTheDataAndIsInfiniteForTheLonely)
{
  const Spheres unit = gas(10000);
  for (const double scale : { 1e-9, 3e22 })
  {
    Spheres scaled = unit;
    for (auto& sphere : scaled)
    {
      std::for_each(sphere.begin(), sphere.end(), [scale](double& value) { value *= scale; });
    }
    EXPECT_NEAR(freeLength(scaled) / scale, freeLength(unit), 0.01 * freeLength(unit));
  }
  EXPECT_EQ(freeLength({ { 0, 0, 0, 1 } }), Infinity);
  EXPECT_EQ(freeLength({ { 0, 0, 0, 1 }, { 1e3, 0, 0, 1 } }), Infinity);
  EXPECT_EQ(freeLength({}), Infinity);
}

TEST(FreeLength, IsTheSameForAllProcessesAndWithoutGhosts)
{
  for (const Spheres& all : { gas(40000), lattice(30) })
  {
    const double alone = freeLength(all);
    inParallel(3,
      [&](const ProcessGroup& group)
      {
        Spheres own;
        for (std::size_t i = 0; i < all.size(); ++i)
        {
          if (static_cast<int>(i * i % 3) == group.rank() % 2)
          {
            own.push_back(all[i]);
          }
        }
        const bool hasParticles = group.rank() < 2; // the third has ghosts alone
        SphereCloud cloud = cloudOf(hasParticles ? own : all);
        cloud.ghosts.assign(cloud.spheres.size(), hasParticles ? 0 : 1);
        const double found = meanFreeLength(cloud, { static_cast<double>(all.size()), 1 }, group);
        EXPECT_NEAR(found, alone, 1e-3 * alone);
      });
  }
}

/// Particles of five pixels: a jump of a fiftieth of the depths lies behind nearly all of them.
/// With the automatic threshold as many lines of sight have jumps above it as it is made for.
TEST(FreeLength, KeepsAGasFromTurningBlack)
{
  Spheres spheres = gas(30000);
  const double edge = std::cbrt(4.0 / 3.0 * Pi * 30000 / VolumeFraction);
  for (auto& sphere : spheres)
  {
    std::for_each(sphere.begin(), sphere.begin() + 3, [edge](double& x) { x -= edge / 2; });
  }
  const Traced traced(spheres, lookAtOrigin(false, edge, edge / 4, 400, 300, 1, 3 * edge));
  const double depths = std::sqrt(3.0) * edge;
  const SilhouetteScale scale{ 1, depths, traced.renderer.freeLength() };
  const double before = lineShare(traced, { 1, depths });
  const double now = lineShare(traced, scale);
  EXPECT_GT(before, 0.2);
  EXPECT_LT(now, 0.5 * before);
  EXPECT_NEAR(jumpShare(traced, automaticThreshold(scale) / 3), 1.0 / 6, 0.03);
}
