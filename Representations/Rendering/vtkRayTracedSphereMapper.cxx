// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereMapper.h"

#include "BakedTextures.h"
#include "FrameDrawer.h"
#include "FrameLayers.h"
#include "RenderState.h"
#include "SphereInput.h"
#include "SphereRenderer.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
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
#include <cmath>
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

  Source LastSource{ nullptr, 0, {}, 0, 0 };
  po::SphereRenderer Renderer{ sharedScenes() };
  po::BakedTextures Baked;
  po::FrameDrawer Drawer;
  std::vector<std::uint8_t> SelectionColors;
  vtkSmartPointer<vtkImageData> Layers;
  bool LayersAreCurrent = false;
  bool WarnedOfPeeling = false;
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

/// The 24 bits of an id from `shift` on, as the hardware selector reads them: lowest byte in red.
void writeBits(std::int64_t id, int shift, std::uint8_t* rgba)
{
  const std::int64_t bits = id >> shift;
  rgba[0] = static_cast<std::uint8_t>(bits & 0xff);
  rgba[1] = static_cast<std::uint8_t>((bits >> 8) & 0xff);
  rgba[2] = static_cast<std::uint8_t>((bits >> 16) & 0xff);
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
  this->Internal->LayersAreCurrent = false;
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
  if (isBeingPeeled(actor))
  {
    if (!this->Internal->WarnedOfPeeling)
    {
      vtkWarningMacro("Ray-traced spheres are opaque and cannot be drawn by depth peeling; call "
                      "ForceOpaqueOn() of the actor to draw them.");
    }
    this->Internal->WarnedOfPeeling = true;
    return;
  }
  try
  {
    this->UpdateSpheres();
    if (!this->Internal->Renderer.cloud().spheres.empty())
    {
      this->TraceAndDraw(renderer, actor);
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Spheres cannot be drawn: " << error.what());
  }
}

void vtkRayTracedSphereMapper::TraceAndDraw(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    vtkErrorMacro("Ray-traced spheres need an OpenGL render window.");
    return;
  }
  const po::PixelRectangle viewport = po::FrameDrawer::currentViewport(window);
  const po::Camera camera = po::cameraOf(renderer, viewport.width, viewport.height);
  if (!this->Internal->Renderer.trace(camera, po::placementOf(actor)))
  {
    return;
  }
  vtkHardwareSelector* selector = renderer->GetSelector();
  if (selector)
  {
    selector->BeginRenderProp();
    this->ColorForSelection(renderer);
  }
  else
  {
    this->Shade(renderer, actor);
  }
  std::string error;
  this->Internal->Drawer.draw(window, viewport,
    selector ? this->Internal->SelectionColors : this->Internal->Renderer.rgba(),
    this->Internal->Renderer.frame().windowDepth, error);
  if (selector)
  {
    selector->EndRenderProp();
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
}

void vtkRayTracedSphereMapper::Shade(vtkRenderer* renderer, vtkActor* actor)
{
  const std::vector<po::Light> lights = po::lightsOf(renderer);
  po::Material material = po::materialOf(actor->GetProperty(), !lights.empty());
  material.mode = static_cast<po::ShadingMode>(this->ShadingMode);
  material.occlusionOnDiffuse = this->OcclusionOnDiffuse;
  material.particleColors = this->MapPointColors();
  this->Internal->Renderer.shade(material, this->Internal->Baked.textures, lights, this->Shadows);
  this->Internal->LayersAreCurrent = false;
}

const unsigned char* vtkRayTracedSphereMapper::MapPointColors()
{
  int cellFlag = 0;
  vtkUnsignedCharArray* colors = this->MapScalars(this->GetInput(), 1.0, cellFlag);
  const bool onePerPoint = colors && cellFlag == 0 && colors->GetNumberOfComponents() == 4 &&
    colors->GetNumberOfTuples() == this->GetInput()->GetNumberOfPoints();
  return onePerPoint ? colors->GetPointer(0) : nullptr;
}

void vtkRayTracedSphereMapper::ColorForSelection(vtkRenderer* renderer)
{
  vtkHardwareSelector* selector = renderer->GetSelector();
  const int pass = selector->GetCurrentPass();
  if (pass == vtkHardwareSelector::COMPOSITE_INDEX_PASS)
  {
    selector->RenderCompositeIndex(1);
  }
  const po::TracedFrame& frame = this->Internal->Renderer.frame();
  const std::vector<std::int64_t>& points = this->Internal->Renderer.cloud().sourceIds;
  selector->UpdateMaximumPointId(points.back());
  selector->UpdateMaximumCellId(points.back());
  const bool low =
    pass == vtkHardwareSelector::POINT_ID_LOW24 || pass == vtkHardwareSelector::CELL_ID_LOW24;
  const bool high =
    pass == vtkHardwareSelector::POINT_ID_HIGH24 || pass == vtkHardwareSelector::CELL_ID_HIGH24;
  float flat[3];
  selector->GetPropColorValue(flat);

  std::vector<std::uint8_t>& rgba = this->Internal->SelectionColors;
  rgba.assign(4 * frame.pixels(), 255);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    if (frame.sphere[pixel] == po::SphereScene::None)
    {
      continue;
    }
    if (low || high)
    {
      writeBits(points[frame.sphere[pixel]], high ? 24 : 0, &rgba[4 * pixel]);
      continue;
    }
    std::transform(flat, flat + 3, &rgba[4 * pixel],
      [](float value) { return static_cast<std::uint8_t>(std::lround(255 * value)); });
  }
}

vtkImageData* vtkRayTracedSphereMapper::GetLayers()
{
  if (!this->Internal->LayersAreCurrent)
  {
    const po::SphereRenderer& spheres = this->Internal->Renderer;
    const bool shaded = spheres.isShaded();
    this->Internal->Layers = shaded ? po::newLayers(spheres.frame().width, spheres.frame().height)
                                    : vtkSmartPointer<vtkImageData>::New();
    if (shaded)
    {
      po::fillLayers(spheres, this->Internal->Baked.textures, 0, this->Internal->Layers);
    }
    this->Internal->LayersAreCurrent = true;
  }
  return this->Internal->Layers;
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
    this->Shade(renderer, actor);
    po::fillLayers(spheres, this->Internal->Baked.textures, first, layers);
  }
  this->Internal->LayersAreCurrent = true;
  return layers;
}

void vtkRayTracedSphereMapper::ReleaseSpheres()
{
  this->Internal->LastSource = { nullptr, 0, {}, 0, 0 };
  this->Internal->Renderer = po::SphereRenderer(sharedScenes());
  this->Internal->Baked = {};
  this->Internal->Layers = nullptr;
  this->Internal->LayersAreCurrent = false;
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfScenes()
{
  return static_cast<vtkIdType>(sharedScenes()->size());
}

void vtkRayTracedSphereMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Drawer.releaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

vtkIdType vtkRayTracedSphereMapper::GetNumberOfSpheres()
{
  return static_cast<vtkIdType>(this->Internal->Renderer.cloud().spheres.size());
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
}
