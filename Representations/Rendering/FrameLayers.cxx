// SPDX-License-Identifier: BSD-3-Clause
#include "FrameLayers.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace po
{
namespace
{
/// A new point array of the image; the pointer is to its values.
template <typename Array>
auto addLayer(vtkImageData* image, const char* name, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return array->GetPointer(0);
}

void fillNormals(const SphereRenderer& renderer, float* normals)
{
  const TracedFrame& frame = renderer.frame();
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    const bool hit = frame.sphere[pixel] != SphereScene::None;
    const Vec3f n = hit ? worldNormal(renderer.rays(), frame.normal[pixel]).as<float>() : Vec3f{};
    std::copy_n(&n.x, 3, normals + 3 * pixel);
  }
}
}

vtkSmartPointer<vtkImageData> makeLayers(
  const SphereRenderer& renderer, const OcclusionTextures& textures)
{
  const TracedFrame& frame = renderer.frame();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(frame.width, frame.height, 1);

  const std::vector<std::uint8_t>& rgba = renderer.rgba();
  std::copy(rgba.begin(), rgba.end(), addLayer<vtkUnsignedCharArray>(image, "RGBA", 4));
  image->GetPointData()->SetActiveScalars("RGBA");

  std::transform(frame.t.begin(), frame.t.end(), addLayer<vtkFloatArray>(image, "Z", 1),
    [](double t) { return static_cast<float>(t); });

  const std::vector<std::int64_t>& particles = renderer.cloud().sourceIds;
  std::vector<float> occlusion;
  lookUpOcclusion(frame, particles, textures, occlusion);
  std::copy(occlusion.begin(), occlusion.end(), addLayer<vtkFloatArray>(image, "AO", 1));

  fillNormals(renderer, addLayer<vtkFloatArray>(image, "N", 3));

  std::transform(frame.sphere.begin(), frame.sphere.end(),
    addLayer<vtkTypeInt64Array>(image, "id", 1),
    [&](std::uint32_t sphere) { return sphere == SphereScene::None ? -1 : particles[sphere]; });
  return image;
}
}
