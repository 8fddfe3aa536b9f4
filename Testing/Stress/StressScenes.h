// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_StressScenes_h
#define po_StressScenes_h

#include "VisibilityJudge.h"

#include <cstddef>
#include <string>
#include <vector>

namespace stress
{
using judge::Ball;
using po::Vec3d;

/// Spheres that are hard in one way, in units of their usual radius, about the origin.
struct Scene
{
  std::string name;
  std::vector<Ball> balls;
  std::vector<std::size_t> watched; ///< a dozen of them, which are compared with the judge
  std::vector<std::size_t> sealed;  ///< of these, those that no light can reach
  double reach = 1;                 ///< radius that lengths of a placement are counted in
};

/// All scenes; their number and order are fixed.
[[nodiscard]] std::vector<Scene> scenes();

/// An uneven layer over others without a gap, 40,000 balls in all, so wide that whole tiles of a
/// sweep are closed by its top. It is none of the above, for its size.
[[nodiscard]] Scene layers();

/// Where a scene is put, and in which unit.
struct Placement
{
  std::string name;
  double unit = 1;          ///< length of 1
  double offset = 0;        ///< of the origin, in the scene's reach, along (1, -2/3, 1/3)
  bool floatPoints = false; ///< positions are rounded to single precision, as files have them
};

[[nodiscard]] std::vector<Placement> placements();

/// The input that a placement makes of a scene.
[[nodiscard]] std::vector<Ball> place(const Scene& scene, const Placement& placement);

/// The farthest that rounding of the input has moved a ball, in radii of that ball.
[[nodiscard]] double inputError(const Scene& scene, const Placement& placement);
}

#endif
