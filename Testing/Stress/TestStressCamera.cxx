// SPDX-License-Identifier: BSD-3-Clause
/// Frames of hard views against rays in extended precision.

#include "CameraCases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace stress;

TEST(StressCamera, SeesWhatDoublePrecisionSees)
{
  for (const View& view : views())
  {
    SCOPED_TRACE(view.name);
    const FrameOutcome outcome = runView(view);
    EXPECT_GT(outcome.pixels, 0u);
    EXPECT_EQ(outcome.wrong, 0u);
    // Near the edge of a ball its depth changes fast; a place in the world is right to 1e-16 of its
    // distance from the origin, a place in the cloud to 1e-6 radii.
    const double reach = po::length(view.eye) / view.balls.front().radius;
    EXPECT_LT(outcome.depth, 2e-3 + 1e-12 * reach);
  }
}
}
