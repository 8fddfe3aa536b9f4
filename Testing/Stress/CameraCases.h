// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_CameraCases_h
#define po_CameraCases_h

#include "VisibilityJudge.h"

#include <cstddef>
#include <string>
#include <vector>

namespace stress
{
using judge::Ball;
using po::Vec3d;

/// A view, in the terms of a camera: the eye looks along -z of a frame that is turned about y.
struct View
{
  std::string name;
  std::vector<Ball> balls;
  Vec3d eye;
  double turn = 0;   ///< about y, radians
  double angle = 30; ///< field of view, degrees, from lower to upper edge; 0: parallel
  double half = 1;   ///< parallel: half the height that is seen
  double zNear = 0.1, zFar = 100;
  int width = 64, height = 64; ///< of the whole picture
  int tileX = 0, tileY = 0;    ///< lower left corner of the part that is traced
  int tileSize = 0;            ///< 0: all of it
};

[[nodiscard]] std::vector<View> views();

/// The product's frame against double precision, pixel by pixel.
struct FrameOutcome
{
  std::size_t pixels = 0;
  std::size_t hits = 0;  ///< by the judge
  std::size_t wrong = 0; ///< hit instead of miss or the other way, or another ball, off the edges
  double depth = 0;      ///< largest error of t: in radii of the ball, beyond what doubles resolve
};

[[nodiscard]] FrameOutcome runView(const View& view);
}

#endif
