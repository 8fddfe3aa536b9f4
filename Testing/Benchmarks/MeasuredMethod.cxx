// SPDX-License-Identifier: BSD-3-Clause
#include "MeasuredMethod.h"

#include "EmbreeEstimator.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "ThesisEstimator.h"

#include <map>
#include <stdexcept>

namespace po
{
namespace
{
/// All that a sweep may leave out, but for what is named.
SweepSkips skipsWithout(const std::string& name)
{
  static const std::map<std::string, bool SweepSkips::*> flags{
    { "closedCells", &SweepSkips::closedCells },
    { "neverSeen", &SweepSkips::neverSeen },
    { "offsetMasks", &SweepSkips::offsetMasks },
    { "blackSky", &SweepSkips::blackSky },
    { "lonely", &SweepSkips::lonely },
  };
  SweepSkips skips;
  if (!name.empty())
  {
    const auto flag = flags.find(name);
    if (flag == flags.end())
    {
      throw std::runtime_error("There is no skip '" + name + "'");
    }
    skips.*flag->second = false;
  }
  return skips;
}
}

MeasuredMethod makeMethod(const std::string& name, int level, const std::string& without)
{
  if (name == "Sweep")
  {
    SweepOptions options;
    options.directions = level;
    options.smooth = without != "smoothing";
    options.skips = skipsWithout(options.smooth ? without : "");
    return { std::make_unique<SweepEstimator>(options), 1, true };
  }
  if (!without.empty())
  {
    throw std::runtime_error("--without is only for the method Sweep");
  }
  if (name == "Reference")
  {
    return { std::make_unique<ReferenceEstimator>(), level, false };
  }
  if (name == "Thesis")
  {
    return { std::make_unique<ThesisEstimator>(), level, false };
  }
  if (name == "Embree")
  {
    return { std::make_unique<EmbreeEstimator>(EmbreeOptions{ level, 0 }), 1, false };
  }
  throw std::runtime_error("There is no method '" + name + "'");
}
}
