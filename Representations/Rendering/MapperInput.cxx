// SPDX-License-Identifier: BSD-3-Clause
#include "MapperInput.h"

#include "SphereRenderer.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace po
{
MapperMessages MapperInput::update(
  vtkPolyData* points, const RadiusSettings& radii, SphereRenderer& renderer)
{
  const Source source{ points, points ? points->GetMTime() : 0, radii };
  if (source == source_)
  {
    return {};
  }
  source_ = source;
  ++texturesVersion_;
  renderer.setCloud({});
  baked_ = {};
  if (!points || points->GetNumberOfPoints() == 0)
  {
    return {}; // nothing to draw is no mistake
  }
  MapperMessages messages;
  auto input = readSphereCloud(*points, radii, messages.error);
  if (!input)
  {
    return messages;
  }
  if (input->cloud.rejected.total() > 0)
  {
    messages.warnings.push_back(describe(input->cloud.rejected));
  }
  renderer.setCloud(std::move(input->cloud));
  std::string warning;
  baked_ = readBakedTextures(*points, warning);
  if (!warning.empty())
  {
    messages.warnings.push_back(warning);
  }
  return messages;
}

void MapperInput::forget()
{
  source_ = { nullptr, 0, {} };
  baked_ = {};
}

void boundsOf(const SphereCloud& cloud, double bounds[6])
{
  for (std::size_t i = 0; i < cloud.spheres.size(); ++i)
  {
    const Vec3d center = cloud.toWorld(cloud.spheres[i].center().as<double>());
    const double radius = cloud.scale * cloud.spheres[i].radius;
    const double* c = &center.x;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double low = c[axis] - radius, high = c[axis] + radius;
      bounds[2 * axis] = i == 0 ? low : std::min(bounds[2 * axis], low);
      bounds[2 * axis + 1] = i == 0 ? high : std::max(bounds[2 * axis + 1], high);
    }
  }
}
}
