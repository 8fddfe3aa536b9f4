// SPDX-License-Identifier: BSD-3-Clause
#include "HiddenSpheres.h"

#include "SphereRenderer.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

namespace po
{
namespace
{
std::vector<std::array<double, 4>> coefficientsOf(const std::vector<HalfSpace>& halfSpaces)
{
  std::vector<std::array<double, 4>> planes;
  planes.reserve(halfSpaces.size());
  for (const HalfSpace& h : halfSpaces)
  {
    planes.push_back({ h.normal.x, h.normal.y, h.normal.z, h.offset });
  }
  return planes;
}
}

std::string HiddenSpheres::update(
  vtkPolyData& points, const MapperInput& input, const HidingRules& rules, SphereRenderer& renderer)
{
  const Source source{ input.source(), coefficientsOf(rules.halfSpaces), rules.ranges,
    rules.stylesVersion, rules.colors ? rules.colors->version() : 0 };
  if (source == source_)
  {
    return "";
  }
  source_ = source;
  std::string warning;
  const Cropping cropping{ rules.halfSpaces, valueRangesOf({ &points }, rules.ranges, warning) };
  const SphereCloud& cloud = renderer.cloud();
  std::vector<std::uint8_t> hidden = hideSpheres(cloud, cropping);
  hideInvisible(cloud.sourceIds, blockTableOf(points), rules.styles,
    rules.colors ? rules.colors->rgba() : nullptr, hidden);
  count_ = std::count(hidden.begin(), hidden.end(), 1);
  renderer.setHidden(std::move(hidden));
  return warning;
}
}
