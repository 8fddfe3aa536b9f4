// SPDX-License-Identifier: BSD-3-Clause
#include "SphereDrawer.h"

#include "SelectionColors.h"
#include "SphereRenderer.h"

#include "vtkActor.h"
#include "vtkHardwareSelector.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

#include <cstddef>

namespace po
{
namespace
{
bool isBeingPeeled(vtkActor* actor)
{
  vtkInformation* keys = actor->GetPropertyKeys();
  return actor->IsRenderingTranslucentPolygonalGeometry() && keys &&
    keys->Has(vtkOpenGLRenderPass::RenderPasses());
}

bool isSmooth(const SphereRenderer& renderer)
{
  return renderer.samples() > 1;
}

/// Front to back; of a smooth frame the rims come last.
std::vector<PixelLayer> pixelsOf(const SphereRenderer& renderer)
{
  const TracedFrame& frame = renderer.frame();
  std::vector<PixelLayer> layers{ { frame.width, frame.height, &renderer.rgba(),
    &frame.windowDepth } };
  for (const FrameLayer& layer : renderer.layersBehind())
  {
    layers.push_back({ frame.width, frame.height, &layer.rgba, &layer.frame.windowDepth });
  }
  if (isSmooth(renderer))
  {
    layers.push_back({ frame.width, frame.height, &renderer.rgba(), &renderer.rimDepth() });
  }
  return layers;
}

Blending blendingOf(std::size_t layer, bool smooth, vtkActor* actor)
{
  if (isBeingPeeled(actor))
  {
    return Blending::Peeled;
  }
  if (actor->HasTranslucentPolygonalGeometry() || (smooth && layer > 0))
  {
    return Blending::OverColors;
  }
  return smooth ? Blending::Over : Blending::None;
}
}

std::string SphereDrawer::draw(vtkOpenGLRenderWindow* window, const SphereRenderer& renderer,
  std::uint64_t version, vtkPolyDataMapper* mapper, vtkActor* actor)
{
  const std::vector<PixelLayer> layers = pixelsOf(renderer);
  std::string error = picture_.load(window, layers, version);
  for (std::size_t i = layers.size(); i-- > 0 && error.empty();) // back to front
  {
    const Blending blending = blendingOf(i, isSmooth(renderer), actor);
    error = picture_.draw(window, i, blending, mapper, actor);
  }
  return error;
}

std::string SphereDrawer::drawForSelection(vtkOpenGLRenderWindow* window,
  const SphereRenderer& renderer, vtkHardwareSelector& selector, vtkPolyDataMapper* mapper,
  vtkActor* actor)
{
  const TracedFrame& frame = renderer.frame();
  selector.BeginRenderProp();
  colorForSelection(
    selector, frame, renderer.cloud().sourceIds, *mapper->GetInput(), selectionColors_);
  std::string error = selection_.load(window,
    { { frame.width, frame.height, &selectionColors_, &frame.windowDepth } }, ++selectionVersion_);
  if (error.empty())
  {
    error = selection_.draw(window, 0, Blending::None, mapper, actor);
  }
  selector.EndRenderProp();
  return error;
}

void SphereDrawer::releaseGraphicsResources(vtkWindow* window)
{
  picture_.releaseGraphicsResources(window);
  selection_.releaseGraphicsResources(window);
}
}
