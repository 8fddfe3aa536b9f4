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
template <typename Array>
void addLayer(vtkImageData* image, const char* name, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
}

/// Where the values of a row begin.
template <typename Array>
auto layerFrom(vtkImageData* image, const char* name, int row)
{
  auto* array = Array::SafeDownCast(image->GetPointData()->GetAbstractArray(name));
  const vtkIdType first = static_cast<vtkIdType>(row) * image->GetDimensions()[0];
  return array->GetPointer(first * array->GetNumberOfComponents());
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

vtkSmartPointer<vtkImageData> newLayers(int width, int height)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  addLayer<vtkUnsignedCharArray>(image, "RGBA", 4);
  image->GetPointData()->SetActiveScalars("RGBA");
  addLayer<vtkFloatArray>(image, "Z", 1);
  addLayer<vtkFloatArray>(image, "AO", 1);
  addLayer<vtkFloatArray>(image, "N", 3);
  addLayer<vtkTypeInt64Array>(image, "id", 1);
  return image;
}

void fillLayers(const SphereRenderer& renderer, const OcclusionTextures& textures, int firstRow,
  vtkImageData* image)
{
  const TracedFrame& frame = renderer.frame();
  const std::vector<std::uint8_t>& rgba = renderer.rgba();
  std::copy(rgba.begin(), rgba.end(), layerFrom<vtkUnsignedCharArray>(image, "RGBA", firstRow));

  std::transform(frame.t.begin(), frame.t.end(), layerFrom<vtkFloatArray>(image, "Z", firstRow),
    [](double t) { return static_cast<float>(t); });

  const std::vector<std::int64_t>& particles = renderer.cloud().sourceIds;
  std::vector<float> occlusion;
  lookUpOcclusion(frame, particles, textures, occlusion);
  std::copy(occlusion.begin(), occlusion.end(), layerFrom<vtkFloatArray>(image, "AO", firstRow));

  fillNormals(renderer, layerFrom<vtkFloatArray>(image, "N", firstRow));

  std::transform(frame.sphere.begin(), frame.sphere.end(),
    layerFrom<vtkTypeInt64Array>(image, "id", firstRow),
    [&](std::uint32_t sphere) { return sphere == SphereScene::None ? -1 : particles[sphere]; });
}

vtkSmartPointer<vtkImageData> traceLayers(SphereRenderer& renderer, const Camera& camera,
  const Matrix4& modelToWorld, const Style& style, int samples)
{
  constexpr int pixelsPerBand = 1 << 22;
  vtkSmartPointer<vtkImageData> layers = newLayers(camera.width, camera.height);
  const int rows = std::max(1, pixelsPerBand / camera.width);
  for (int first = 0; first < camera.height; first += rows)
  {
    const Camera band = bandOf(camera, first, std::min(rows, camera.height - first));
    if (!renderer.trace(band, modelToWorld))
    {
      return vtkSmartPointer<vtkImageData>::New();
    }
    renderer.shade(style);
    renderer.refine(samples);
    fillLayers(renderer, style.textures, first, layers);
  }
  return layers;
}

vtkImageData* LastLayers::update(
  const SphereRenderer& renderer, const OcclusionTextures& textures, std::uint64_t version)
{
  if (!renderer.isShaded())
  {
    layers_ = vtkSmartPointer<vtkImageData>::New();
    version_ = 0;
  }
  else if (version_ != version)
  {
    layers_ = newLayers(renderer.frame().width, renderer.frame().height);
    fillLayers(renderer, textures, 0, layers_);
    version_ = version;
  }
  return layers_;
}

void LastLayers::forget()
{
  layers_ = nullptr;
  version_ = 0;
}
}
