// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereMapper.h"

#include "BakedTextures.h"
#include "FrameDrawer.h"
#include "FrameLayers.h"
#include "InteractiveResolution.h"
#include "ParticleFilter.h"
#include "PointColors.h"
#include "RenderState.h"
#include "SelectionColors.h"
#include "SphereInput.h"
#include "SphereRenderer.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <tuple>

vtkStandardNewMacro(vtkRayTracedSphereMapper);

namespace
{
/// Of all mappers of the process: they often show the same spheres in several views.
const std::shared_ptr<po::SceneCache>& sharedScenes()
{
  static const auto scenes = std::make_shared<po::SceneCache>();
  return scenes;
}
}

struct vtkRayTracedSphereMapper::Internals
{
  /// What the spheres were read from; they are read again when any of it changes.
  using Source = std::tuple<vtkPolyData*, vtkMTimeType, std::string, double, double>;

  /// What decides which spheres are hidden.
  using Crop = std::tuple<Source, std::vector<std::array<double, 4>>, std::vector<po::CropRange>,
    std::uint64_t, std::uint64_t>;

  Source LastSource{ nullptr, 0, {}, 0, 0 };
  std::uint64_t TexturesVersion = 0;
  po::SphereRenderer Renderer{ sharedScenes() };
  po::BakedTextures Baked;
  std::vector<po::CropRange> CropRanges;
  po::BlockStyles BlockStyles;
  std::uint64_t StylesVersion = 0;
  Crop LastCrop;
  vtkIdType HiddenSpheres = 0;
  po::PointColors Colors;
  po::InteractiveResolution Resolution;
  po::FrameDrawer Drawer, SelectionDrawer;
  std::uint64_t SelectionVersion = 0;
  std::vector<std::uint8_t> SelectionColors;
  vtkSmartPointer<vtkImageData> Layers;
  std::uint64_t LayersVersion = 0;

  std::uint64_t VersionBase = 0; ///< pictures of renderers that are gone

  /// Another number for other pictures.
  [[nodiscard]] std::uint64_t pictureVersion() const
  {
    const po::RenderStatistics& s = this->Renderer.statistics();
    return this->VersionBase + 1 + s.framesTraced + s.framesShaded + s.samplesTraced;
  }
};

namespace
{
/// World-parallel bounds of all spheres, in the coordinates of the points.
void boundsOf(const po::SphereCloud& cloud, double bounds[6])
{
  for (std::size_t i = 0; i < cloud.spheres.size(); ++i)
  {
    const po::Vec3d center = cloud.toWorld(cloud.spheres[i].center().as<double>());
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

bool isBeingPeeled(vtkActor* actor)
{
  vtkInformation* keys = actor->GetPropertyKeys();
  return actor->IsRenderingTranslucentPolygonalGeometry() && keys &&
    keys->Has(vtkOpenGLRenderPass::RenderPasses());
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
}

void vtkRayTracedSphereMapper::UpdateSpheres()
{
  vtkPolyData* input = this->GetInput();
  const std::string array = this->RadiusArray ? this->RadiusArray : "";
  const Internals::Source source{ input, input ? input->GetMTime() : 0, array, this->RadiusScale,
    this->ConstantRadius };
  if (source == this->Internal->LastSource)
  {
    return;
  }
  this->Internal->LastSource = source;
  ++this->Internal->TexturesVersion;
  this->Internal->Renderer.setCloud({});
  this->Internal->Baked = {};
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return; // nothing to draw is no mistake
  }
  std::string message;
  auto cloud =
    po::readSphereCloud(*input, { array, this->RadiusScale, this->ConstantRadius }, message);
  if (!cloud)
  {
    vtkErrorMacro(<< message);
    return;
  }
  if (cloud->rejected.total() > 0)
  {
    vtkWarningMacro(<< po::describe(cloud->rejected));
  }
  this->Internal->Renderer.setCloud(std::move(*cloud));
  this->Internal->Baked = po::readBakedTextures(*input, message);
  if (!message.empty())
  {
    vtkWarningMacro(<< message);
  }
}

void vtkRayTracedSphereMapper::ComputeBounds()
{
  this->UpdateSpheres();
  vtkMath::UninitializeBounds(this->Bounds);
  boundsOf(this->Internal->Renderer.cloud(), this->Bounds);
}

void vtkRayTracedSphereMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  if (!this->Static && this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->Update();
  }
  try
  {
    this->UpdateSpheres();
    if (!this->Internal->Renderer.cloud().spheres.empty())
    {
      this->UpdateColors(actor);
      this->UpdateHidden(actor);
      this->RenderSpheres(renderer, actor);
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Spheres cannot be drawn: " << error.what());
  }
}

void vtkRayTracedSphereMapper::UpdateColors(vtkActor* actor)
{
  int cellFlag = 0;
  const double opacity = actor->GetProperty()->GetOpacity();
  vtkUnsignedCharArray* colors = this->MapScalars(this->GetInput(), opacity, cellFlag);
  const bool onePerPoint = colors && cellFlag == 0 && colors->GetNumberOfComponents() == 4 &&
    colors->GetNumberOfTuples() == this->GetInput()->GetNumberOfPoints();
  Internals& internal = *this->Internal;
  internal.Colors.update(*this->GetInput(), onePerPoint ? colors : nullptr, *actor->GetProperty(),
    internal.BlockStyles, internal.StylesVersion);
}

void vtkRayTracedSphereMapper::UpdateHidden(vtkActor* actor)
{
  Internals& internal = *this->Internal;
  po::Cropping cropping;
  cropping.halfSpaces = po::clippingPlanesOf(*this, *actor);
  std::vector<std::array<double, 4>> planes;
  for (const po::HalfSpace& h : cropping.halfSpaces)
  {
    planes.push_back({ h.normal.x, h.normal.y, h.normal.z, h.offset });
  }
  const bool translucent = actor->HasTranslucentPolygonalGeometry();
  const Internals::Crop crop{ internal.LastSource, planes, internal.CropRanges,
    internal.StylesVersion, translucent ? internal.Colors.version() : 0 };
  if (crop == internal.LastCrop)
  {
    return;
  }
  internal.LastCrop = crop;
  std::string warning;
  cropping.ranges = po::valueRangesOf(*this->GetInput(), internal.CropRanges, warning);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  const po::SphereCloud& cloud = internal.Renderer.cloud();
  std::vector<std::uint8_t> hidden = po::hideSpheres(cloud, cropping);
  po::hideInvisible(cloud.sourceIds, po::blockTableOf(*this->GetInput()), internal.BlockStyles,
    translucent ? internal.Colors.rgba() : nullptr, hidden);
  internal.HiddenSpheres = std::count(hidden.begin(), hidden.end(), 1);
  internal.Renderer.setHidden(std::move(hidden));
}

bool vtkRayTracedSphereMapper::IsInteractive(vtkRenderer* renderer)
{
  return this->InteractiveRate > 0 && renderer->GetRenderWindow()->GetDesiredUpdateRate() >= 1;
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
  const bool interactive = !renderer->GetSelector() && this->IsInteractive(renderer);
  if (interactive && !internal.Renderer.isCurrent(camera, placement))
  {
    camera = coarser(
      camera, internal.Resolution.reduction(camera.width, camera.height, this->InteractiveRate));
  }
  const auto start = std::chrono::steady_clock::now();
  const bool isNew = !internal.Renderer.isCurrent(camera, placement);
  if (!internal.Renderer.trace(camera, placement))
  {
    return;
  }
  if (renderer->GetSelector())
  {
    this->DrawForSelection(renderer, actor);
    return;
  }
  this->Shade(renderer, actor, !interactive);
  this->Draw(renderer, actor);
  if (isNew && internal.Renderer.samples() == 1)
  {
    internal.Resolution.measured(internal.Renderer.frame().pixels(),
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
}

void vtkRayTracedSphereMapper::Shade(vtkRenderer* renderer, vtkActor* actor, bool refine)
{
  Internals& internal = *this->Internal;
  po::Style style;
  style.lights = po::lightsOf(renderer);
  style.material = po::materialOf(actor->GetProperty(), !style.lights.empty());
  style.material.mode = static_cast<po::ShadingMode>(this->ShadingMode);
  style.material.occlusionOnDiffuse = this->OcclusionOnDiffuse;
  style.material.translucent = actor->HasTranslucentPolygonalGeometry();
  style.material.particleColors = internal.Colors.rgba();
  style.material.colorsVersion = internal.Colors.version();
  style.textures = internal.Baked.textures;
  style.texturesVersion = internal.TexturesVersion;
  style.shadows = this->Shadows;
  const std::uint64_t before = internal.pictureVersion();
  internal.Renderer.shade(style);
  const bool isNew = before != internal.pictureVersion();
  if (!refine || style.material.translucent)
  {
    return;
  }
  const int next = this->Progressive
    ? std::min(internal.Renderer.samples() + (isNew ? 0 : 1), this->SamplesPerPixel)
    : this->SamplesPerPixel;
  internal.Renderer.refine(next);
  if (next < this->SamplesPerPixel)
  {
    this->InvokeEvent(vtkCommand::UpdateEvent);
  }
}

void vtkRayTracedSphereMapper::Draw(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  Internals& internal = *this->Internal;
  const po::TracedFrame& frame = internal.Renderer.frame();
  std::vector<po::PixelLayer> layers{ { frame.width, frame.height, &internal.Renderer.rgba(),
    &frame.windowDepth } };
  for (const po::FrameLayer& layer : internal.Renderer.layersBehind())
  {
    layers.push_back({ frame.width, frame.height, &layer.rgba, &layer.frame.windowDepth });
  }
  const bool smooth = internal.Renderer.samples() > 1;
  if (smooth)
  {
    layers.push_back(
      { frame.width, frame.height, &internal.Renderer.rgba(), &internal.Renderer.rimDepth() });
  }
  std::string error = internal.Drawer.load(window, layers, internal.pictureVersion());
  const bool translucent = actor->HasTranslucentPolygonalGeometry();
  for (std::size_t i = layers.size(); i-- > 0 && error.empty();) // back to front
  {
    const po::Blending blending = isBeingPeeled(actor) ? po::Blending::Peeled
      : translucent || (smooth && i > 0)               ? po::Blending::OverColors
      : smooth                                         ? po::Blending::Over
                                                       : po::Blending::None;
    error = internal.Drawer.draw(window, i, blending, this, actor);
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
}

void vtkRayTracedSphereMapper::DrawForSelection(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  Internals& internal = *this->Internal;
  const po::TracedFrame& frame = internal.Renderer.frame();
  vtkHardwareSelector* selector = renderer->GetSelector();
  selector->BeginRenderProp();
  po::colorForSelection(*selector, frame, internal.Renderer.cloud().sourceIds, *this->GetInput(),
    internal.SelectionColors);
  std::string error = internal.SelectionDrawer.load(window,
    { { frame.width, frame.height, &internal.SelectionColors, &frame.windowDepth } },
    ++internal.SelectionVersion);
  if (error.empty())
  {
    error = internal.SelectionDrawer.draw(window, 0, po::Blending::None, this, actor);
  }
  selector->EndRenderProp();
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
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
  if (!internal.Renderer.isShaded())
  {
    internal.Layers = vtkSmartPointer<vtkImageData>::New();
    internal.LayersVersion = 0;
  }
  else if (internal.LayersVersion != internal.pictureVersion())
  {
    internal.Layers =
      po::newLayers(internal.Renderer.frame().width, internal.Renderer.frame().height);
    po::fillLayers(internal.Renderer, internal.Baked.textures, 0, internal.Layers);
    internal.LayersVersion = internal.pictureVersion();
  }
  return internal.Layers;
}

vtkSmartPointer<vtkImageData> vtkRayTracedSphereMapper::RenderLayers(
  vtkRenderer* renderer, vtkActor* actor, int width, int height)
{
  constexpr int largestSide = 65536;
  constexpr int pixelsPerBand = 1 << 22;
  if (width < 1 || height < 1 || width > largestSide || height > largestSide)
  {
    vtkErrorMacro("Layers must have 1 to " << largestSide << " pixels a side, not " << width
                                           << " x " << height << ".");
    return vtkSmartPointer<vtkImageData>::New();
  }
  try
  {
    return this->TraceLayers(renderer, actor, width, height, pixelsPerBand);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(
      "Layers of " << width << " x " << height << " pixels cannot be made: " << error.what());
    return vtkSmartPointer<vtkImageData>::New();
  }
}

vtkSmartPointer<vtkImageData> vtkRayTracedSphereMapper::TraceLayers(
  vtkRenderer* renderer, vtkActor* actor, int width, int height, int pixelsPerBand)
{
  this->UpdateSpheres();
  po::SphereRenderer& spheres = this->Internal->Renderer;
  if (spheres.cloud().spheres.empty())
  {
    return vtkSmartPointer<vtkImageData>::New();
  }
  this->UpdateColors(actor);
  this->UpdateHidden(actor);
  this->GetLayers(); // keep those of the last frame, which is lost
  const po::Camera camera = po::cameraOfPicture(renderer, width, height);
  vtkSmartPointer<vtkImageData> layers = po::newLayers(width, height);
  const int rows = std::max(1, pixelsPerBand / width);
  for (int first = 0; first < height; first += rows)
  {
    const po::Camera band = po::bandOf(camera, first, std::min(rows, height - first));
    if (!spheres.trace(band, po::placementOf(actor)))
    {
      return vtkSmartPointer<vtkImageData>::New();
    }
    this->Shade(renderer, actor, false);
    spheres.refine(this->SamplesPerPixel);
    po::fillLayers(spheres, this->Internal->Baked.textures, first, layers);
  }
  this->Internal->LayersVersion = this->Internal->pictureVersion();
  return layers;
}

void vtkRayTracedSphereMapper::ReleaseSpheres()
{
  this->Internal->LastSource = { nullptr, 0, {}, 0, 0 };
  this->Internal->LastCrop = {};
  this->Internal->VersionBase = this->Internal->pictureVersion();
  this->Internal->Renderer = po::SphereRenderer(sharedScenes());
  this->Internal->Baked = {};
  this->Internal->Layers = nullptr;
  this->Internal->LayersVersion = 0;
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfScenes()
{
  return static_cast<vtkIdType>(sharedScenes()->size());
}

void vtkRayTracedSphereMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Drawer.releaseGraphicsResources(window);
  this->Internal->SelectionDrawer.releaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfSpheres()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.cloud().spheres.size());
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfShownSpheres()
{
  return this->GetNumberOfSpheres() - this->Internal->HiddenSpheres;
}

int vtkRayTracedSphereMapper::GetNumberOfSamples()
{
  return this->Internal->Renderer.samples();
}

int vtkRayTracedSphereMapper::GetNumberOfLayers()
{
  return this->Internal->Renderer.isShaded()
    ? 1 + static_cast<int>(this->Internal->Renderer.layersBehind().size())
    : 0;
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfRays()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().trace.rays);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfShadowRays()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().shadows.rays);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfSkippedTiles()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().trace.tilesSkipped);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfSkippedShadowRays()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().shadows.skipped);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfTracedFrames()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().framesTraced);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfTracedShadows()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.statistics().shadowsTraced);
}

double vtkRayTracedSphereMapper::GetBuildSeconds()
{
  return this->Internal->Renderer.statistics().buildSeconds;
}

double vtkRayTracedSphereMapper::GetTraceSeconds()
{
  return this->Internal->Renderer.statistics().traceSeconds;
}

double vtkRayTracedSphereMapper::GetShadowSeconds()
{
  return this->Internal->Renderer.statistics().shadowSeconds;
}

double vtkRayTracedSphereMapper::GetShadeSeconds()
{
  return this->Internal->Renderer.statistics().shadeSeconds;
}

void vtkRayTracedSphereMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArray: " << (this->RadiusArray ? this->RadiusArray : "(automatic)")
     << '\n';
  os << indent << "RadiusScale: " << this->RadiusScale << '\n';
  os << indent << "ConstantRadius: " << this->ConstantRadius << '\n';
  os << indent << "ShadingMode: " << this->ShadingMode << '\n';
  os << indent << "OcclusionOnDiffuse: " << (this->OcclusionOnDiffuse ? "on" : "off") << '\n';
  os << indent << "Shadows: " << (this->Shadows ? "on" : "off") << '\n';
  os << indent << "SamplesPerPixel: " << this->SamplesPerPixel << '\n';
  os << indent << "Progressive: " << (this->Progressive ? "on" : "off") << '\n';
  os << indent << "InteractiveRate: " << this->InteractiveRate << '\n';
}
