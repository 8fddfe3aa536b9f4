// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRule.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace po
{
namespace
{
/// Laplacian of a jump of 1 along a straight edge: three of the eight neighbours lie in front.
constexpr double LaplacianOfJump = 3;

/// Jumps of this many mean radii get a line.
constexpr double AutomaticRadii = 2;

/// Or jumps of this share of the depths.
constexpr double AutomaticShare = 0.02;

/// As many lines of sight through scattered particles may meet larger jumps.
constexpr double AutomaticSightLines = 1.0 / 6;

/// The jump that they exceed; 0 if fewer meet any jump at all.
double jumpOfScattered(const SilhouetteScale& scale)
{
  constexpr double Opaque = 50; // free lengths through which nobody sees
  constexpr int Steps = 20;     // far more than it takes
  const double length = scale.freeLength - AutomaticRadii * scale.meanRadius;
  if (!(length > 0))
  {
    return 0;
  }
  const double through = std::min(Opaque, scale.depthRange / std::sqrt(3) / length);
  const double unseen = std::exp(-through);
  const auto excess = [&](double jump)
  { return std::exp(-jump) - (1 + through - jump) * unseen - AutomaticSightLines; };
  double jump = 0; // in free lengths
  // Newton's method, from the left of a convex function that falls.
  for (int step = 0; step < Steps && excess(jump) > 0; ++step)
  {
    jump += excess(jump) / (std::exp(-jump) - unseen);
  }
  return length * jump;
}

bool isLength(double value)
{
  return value >= 0 && std::isfinite(value);
}

bool isWidth(double value)
{
  return value >= 1 && value <= WidestLine;
}
}

std::string faultOf(const SilhouetteParameters& p)
{
  std::ostringstream fault;
  const auto check = [&](bool right, const char* name, auto value, const char* range)
  {
    if (!right && fault.str().empty())
    {
      fault << name << " is " << value << "; it must be " << range << '.';
    }
  };
  check(isLength(p.threshold), "Threshold", p.threshold, "a length >= 0 (0: automatic)");
  check(p.density >= 0 && p.density <= 1, "LineDensity", p.density, "from 0 (none) to 1 (all)");
  check(isLength(p.backgroundDepth), "BackgroundDepth", p.backgroundDepth,
    "a depth >= 0 in world units (0: automatic)");
  check(isSampleCount(p.samples), "Samples", p.samples, "1, 2, 4 or 8 along each side of a pixel");
  check(isWidth(p.width), "LineWidth", p.width, "from 1 to 8 pixels");
  check(isWidth(p.maximumWidth), "MaximumLineWidth", p.maximumWidth, "from 1 to 8 pixels");
  check(isLength(p.jumpFrom), "JumpFrom", p.jumpFrom, "a length >= 0 (0: automatic)");
  check(isLength(p.jumpTo), "JumpTo", p.jumpTo, "a length >= 0 (0: automatic)");
  check(p.jumpTo == 0 || p.jumpTo > p.jumpFrom, "JumpTo", p.jumpTo, "larger than JumpFrom");
  return fault.str();
}

double automaticThreshold(const SilhouetteScale& scale)
{
  return LaplacianOfJump *
    std::max({ AutomaticRadii * scale.meanRadius, AutomaticShare * scale.depthRange,
      jumpOfScattered(scale) });
}

SilhouetteRule resolve(const SilhouetteParameters& p, const SilhouetteScale& scale)
{
  const double unit = p.unit == SilhouetteUnit::Radii ? scale.meanRadius : 1;
  const double middle = p.threshold > 0 ? unit * p.threshold : automaticThreshold(scale);
  const double odds = (1 - p.density) / p.density;
  SilhouetteRule rule;
  rule.threshold = p.density > 0 ? odds * odds * middle : std::numeric_limits<double>::infinity();
  rule.jump = rule.threshold / LaplacianOfJump;
  if (p.backgroundDepth > 0)
  {
    rule.background = p.backgroundDepth;
  }
  rule.backgroundLines = p.backgroundLines;
  rule.slopeTest = p.slopeTest;
  rule.samples = p.samples;
  rule.width = p.width;
  rule.maximumWidth = p.widthByJump ? std::max(p.width, p.maximumWidth) : p.width;
  rule.greyByJump = p.greyByJump;
  const double smallest = rule.drawsNothing() ? 0 : rule.jump;
  const double from = p.jumpFrom > 0 ? unit * p.jumpFrom : smallest / 2;
  const double to = p.jumpTo > 0 ? unit * p.jumpTo : 4 * smallest;
  rule.ramp = { static_cast<float>(from), static_cast<float>(std::max(from, to)) };
  return rule;
}
}
