// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereMapper.h"

#include "RenderState.h"
#include "vtkRayTracedSphereMapperInternals.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <chrono>
#include <exception>

vtkStandardNewMacro(vtkRayTracedSphereMapper);

namespace
{
bool isDragged(vtkRenderer* renderer)
{
  return renderer->GetRenderWindow()->GetDesiredUpdateRate() >= 1;
}

/// Does the user drag, so that frames must be ready in time?
bool isInteractive(vtkRayTracedSphereMapper& mapper, vtkRenderer* renderer)
{
  return !renderer->GetSelector() && mapper.GetInteractiveRate() > 0 && isDragged(renderer);
}

/// Fewer pixels of the same view.
po::Camera coarser(po::Camera camera, int reduction)
{
  camera.width = std::max(1, camera.width / reduction);
  camera.height = std::max(1, camera.height / reduction);
  return camera;
}
}

vtkRayTracedSphereMapper::vtkRayTracedSphereMapper()
  : Internal(std::make_unique<Internals>())
{
}

vtkRayTracedSphereMapper::~vtkRayTracedSphereMapper()
{
  this->SetRadiusArray(nullptr);
  this->SetTextureFile(nullptr);
}

void vtkRayTracedSphereMapper::UpdateSpheres()
{
  const po::RadiusSettings radii{ this->RadiusArray ? this->RadiusArray : "", this->RadiusScale,
    this->ConstantRadius, static_cast<po::RadiusSource>(this->RadiusFrom), this->Density };
  this->Report(this->Internal->Input.update(this->GetInput(), radii, this->Internal->Renderer));
}

void vtkRayTracedSphereMapper::UpdateTextures()
{
  const std::string file = this->TextureFile ? this->TextureFile : "";
  this->Report(this->Internal->Paging.update(*this->GetInput(), file, this->TextureBudget));
}

void vtkRayTracedSphereMapper::Report(const po::MapperMessages& messages)
{
  for (const std::string& warning : messages.warnings)
  {
    vtkWarningMacro(<< warning);
  }
  if (!messages.error.empty())
  {
    vtkErrorMacro(<< messages.error);
  }
}

void vtkRayTracedSphereMapper::ComputeBounds()
{
  this->UpdateSpheres();
  vtkMath::UninitializeBounds(this->Bounds);
  po::boundsOf(this->Internal->Renderer.cloud(), this->Bounds);
}

void vtkRayTracedSphereMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  if (!this->Static && this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->Update();
  }
  try
  {
    if (this->Prepare(actor))
    {
      this->RenderSpheres(renderer, actor);
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Spheres cannot be drawn: " << error.what());
  }
}

/// Brings spheres, their colours and what is hidden up to date; false if there are no spheres.
bool vtkRayTracedSphereMapper::Prepare(vtkActor* actor)
{
  this->UpdateSpheres();
  Internals& internal = *this->Internal;
  if (internal.Renderer.cloud().spheres.empty())
  {
    return false;
  }
  this->UpdateTextures();
  internal.updateColors(this, actor);
  const std::string warning = internal.updateHidden(this, actor);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  return true;
}

void vtkRayTracedSphereMapper::RenderSpheres(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    vtkErrorMacro("Ray-traced spheres need an OpenGL render window.");
    return;
  }
  Internals& internal = *this->Internal;
  const po::PixelRectangle viewport = po::FrameDrawer::currentViewport(window);
  const po::Matrix4 placement = po::placementOf(actor);
  po::Camera camera = po::cameraOf(renderer, viewport.width, viewport.height);
  if (isInteractive(*this, renderer) && !internal.Renderer.isCurrent(camera, placement))
  {
    camera = coarser(
      camera, internal.Resolution.reduction(camera.width, camera.height, this->InteractiveRate));
  }
  const auto start = std::chrono::steady_clock::now();
  const double waited = internal.Renderer.statistics().waitSeconds;
  const bool isNew = !internal.Renderer.isCurrent(camera, placement);
  if (!internal.Renderer.trace(camera, placement))
  {
    return;
  }
  this->Draw(renderer, actor);
  if (isNew && !renderer->GetSelector() && internal.Renderer.samples() == 1)
  {
    internal.Resolution.measured(internal.Renderer.frame().pixels(),
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() -
        (internal.Renderer.statistics().waitSeconds - waited));
  }
}

/// Draws the traced frame, shaded or, while a selection is made, as ids.
void vtkRayTracedSphereMapper::Draw(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  Internals& internal = *this->Internal;
  std::string error;
  if (vtkHardwareSelector* selector = renderer->GetSelector())
  {
    error = internal.Drawer.drawForSelection(window, internal.Renderer, *selector, this, actor);
  }
  else
  {
    this->Shade(renderer, actor);
    error = internal.Drawer.draw(window, internal.Renderer, internal.pictureVersion(), this, actor);
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
}

void vtkRayTracedSphereMapper::Shade(vtkRenderer* renderer, vtkActor* actor)
{
  Internals& internal = *this->Internal;
  po::Style style = internal.styleOf(this, renderer, actor);
  style.waitForTextures = !this->Progressive && !isDragged(renderer);
  const std::uint64_t before = internal.pictureVersion();
  internal.Renderer.shade(style);
  const bool isNew = before != internal.pictureVersion();
  this->Report({ internal.Paging.takeError(), {} });
  if (isInteractive(*this, renderer))
  {
    return;
  }
  const int samples = style.material.translucent ? 1 : this->SamplesPerPixel;
  internal.Renderer.refine(
    this->Progressive ? std::min(internal.Renderer.samples() + (isNew ? 0 : 1), samples) : samples);
  if (internal.Renderer.samples() < samples || internal.Renderer.isWaiting())
  {
    this->InvokeEvent(vtkCommand::UpdateEvent);
  }
}

bool vtkRayTracedSphereMapper::HasMoreToShow()
{
  return this->Internal->Renderer.canGoOn();
}

bool vtkRayTracedSphereMapper::HasTranslucentPolygonalGeometry()
{
  const auto isTranslucent = [](const auto& block)
  { return block.second.visible && block.second.opacity && *block.second.opacity < 1; };
  const po::BlockStyles& styles = this->Internal->BlockStyles;
  return std::any_of(styles.begin(), styles.end(), isTranslucent) ||
    this->Superclass::HasTranslucentPolygonalGeometry();
}

bool vtkRayTracedSphereMapper::HasOpaqueGeometry()
{
  return !this->HasTranslucentPolygonalGeometry();
}

bool vtkRayTracedSphereMapper::GetSupportsSelection()
{
  return true;
}

void vtkRayTracedSphereMapper::AddCropRange(
  const char* array, int component, double low, double high)
{
  this->Internal->CropRanges.push_back({ array ? array : "", component, low, high });
  this->Modified();
}

void vtkRayTracedSphereMapper::RemoveAllCropRanges()
{
  this->Internal->CropRanges.clear();
  this->Modified();
}

void vtkRayTracedSphereMapper::SetBlockVisibility(unsigned flatIndex, bool visible)
{
  this->Internal->BlockStyles[flatIndex].visible = visible;
  ++this->Internal->StylesVersion;
  this->Modified();
}

void vtkRayTracedSphereMapper::SetBlockColor(
  unsigned flatIndex, double red, double green, double blue)
{
  this->Internal->BlockStyles[flatIndex].color = po::Vec3d{ red, green, blue };
  ++this->Internal->StylesVersion;
  this->Modified();
}

void vtkRayTracedSphereMapper::SetBlockOpacity(unsigned flatIndex, double opacity)
{
  this->Internal->BlockStyles[flatIndex].opacity = opacity;
  ++this->Internal->StylesVersion;
  this->Modified();
}

void vtkRayTracedSphereMapper::RemoveAllBlockStyles()
{
  this->Internal->BlockStyles.clear();
  ++this->Internal->StylesVersion;
  this->Modified();
}

vtkImageData* vtkRayTracedSphereMapper::GetLayers()
{
  Internals& internal = *this->Internal;
  return internal.Layers.update(internal.Renderer, internal.textures(), internal.pictureVersion());
}

vtkSmartPointer<vtkImageData> vtkRayTracedSphereMapper::RenderLayers(
  vtkRenderer* renderer, vtkActor* actor, int width, int height)
{
  constexpr int largestSide = 65536;
  if (width < 1 || height < 1 || width > largestSide || height > largestSide)
  {
    vtkErrorMacro("Layers must have 1 to " << largestSide << " pixels a side, not " << width
                                           << " x " << height << ".");
    return vtkSmartPointer<vtkImageData>::New();
  }
  try
  {
    if (this->Prepare(actor))
    {
      this->GetLayers(); // keep those of the last frame, which is lost
      return this->Internal->traceLayers(this, renderer, actor, width, height);
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(
      "Layers of " << width << " x " << height << " pixels cannot be made: " << error.what());
  }
  return vtkSmartPointer<vtkImageData>::New();
}

void vtkRayTracedSphereMapper::ReleaseSpheres()
{
  Internals& internal = *this->Internal;
  internal.Input.forget();
  internal.Paging.forget();
  internal.Hidden.forget();
  internal.VersionBase = internal.pictureVersion();
  internal.Renderer = po::SphereRenderer(Internals::sharedScenes());
  internal.Layers.forget();
}

const po::SphereRenderer& vtkRayTracedSphereMapper::GetSphereRenderer() const
{
  return this->Internal->Renderer;
}

void vtkRayTracedSphereMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Drawer.releaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkRayTracedSphereMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArray: " << (this->RadiusArray ? this->RadiusArray : "(automatic)")
     << '\n';
  os << indent << "RadiusScale: " << this->RadiusScale << '\n';
  os << indent << "ConstantRadius: " << this->ConstantRadius << '\n';
  os << indent << "RadiusFrom: " << this->RadiusFrom << '\n';
  os << indent << "Density: " << this->Density << '\n';
  os << indent << "TextureFile: " << (this->TextureFile ? this->TextureFile : "(none)") << '\n';
  os << indent << "TextureBudget: " << this->TextureBudget << '\n';
  os << indent << "ShadingMode: " << this->ShadingMode << '\n';
  os << indent << "OcclusionOnDiffuse: " << (this->OcclusionOnDiffuse ? "on" : "off") << '\n';
  os << indent << "Shadows: " << (this->Shadows ? "on" : "off") << '\n';
  os << indent << "SamplesPerPixel: " << this->SamplesPerPixel << '\n';
  os << indent << "Progressive: " << (this->Progressive ? "on" : "off") << '\n';
  os << indent << "InteractiveRate: " << this->InteractiveRate << '\n';
}
