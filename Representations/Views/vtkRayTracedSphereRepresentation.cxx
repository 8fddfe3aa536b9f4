// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereRepresentation.h"

#include "BakedTextures.h"
#include "BlockLooks.h"
#include "BlockTable.h"
#include "Blocks.h"
#include "ControllerGroup.h"
#include "ParticleDelivery.h"
#include "RefinementTimer.h"
#include "SphereInput.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProcessModule.h"
#include "vtkProperty.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkRenderedLayersWriter.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkRayTracedSphereRepresentation);

/// What the panel's properties say about cropping; turned into the mapper's planes and ranges.
struct vtkRayTracedSphereRepresentation::Cropping
{
  struct Range
  {
    std::string Array;
    int Component;
    double Low, High;
  };

  std::string Array;
  int Component = -1;
  std::array<double, 2> Limits{ -1e300, 1e300 };
  std::vector<Range> MoreRanges;
  bool Plane = false, Box = false;
  std::array<double, 3> PlaneOrigin{ 0, 0, 0 }, PlaneNormal{ 0, 0, 1 };
  std::array<double, 3> BoxOrigin{ 0, 0, 0 }, BoxSize{ 1, 1, 1 };
  bool IsNew = true;
};

struct vtkRayTracedSphereRepresentation::Blocks
{
  po::BlockLooks Looks;
  std::pair<vtkPolyData*, vtkMTimeType> Applied; ///< the points that the mapper's styles are for
  bool IsNew = true;
};

struct vtkRayTracedSphereRepresentation::Refinement
{
  std::unique_ptr<po::RefinementTimer> Timer;
  vtkNew<vtkCallbackCommand> Command; ///< called when the mapper has more to add
};

namespace
{
/// The points of a data set; those of an image or a rectilinear grid are computed.
vtkSmartPointer<vtkPointSet> pointsOf(vtkDataSet* data)
{
  if (auto* points = vtkPointSet::SafeDownCast(data))
  {
    return points;
  }
  auto computed = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, data->GetPoint(i));
  }
  computed->SetPoints(points);
  computed->GetPointData()->ShallowCopy(data->GetPointData());
  computed->GetFieldData()->ShallowCopy(data->GetFieldData());
  return computed;
}

void addPlane(vtkRayTracedSphereMapper* mapper, const double* origin, const double* normal)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin);
  plane->SetNormal(normal);
  mapper->AddClippingPlane(plane);
}

/// The six planes of a box along the axes.
void addBox(vtkRayTracedSphereMapper* mapper, const std::array<double, 3>& origin,
  const std::array<double, 3>& size)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double end : { 0.0, 1.0 })
    {
      std::array<double, 3> point = origin, normal{ 0, 0, 0 };
      point[axis] += end * size[axis];
      normal[axis] = end == 0 ? 1 : -1;
      addPlane(mapper, point.data(), normal.data());
    }
  }
}

/// Which points are of which block.
void keepBlocks(vtkCompositeDataSet& data, const std::vector<vtkSmartPointer<vtkPointSet>>& blocks,
  vtkPolyData& points)
{
  const std::vector<unsigned> indices = po::flatIndicesOfBlocks(&data);
  po::BlockTable table;
  vtkIdType first = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    table.push_back({ indices[i], first });
    first += blocks[i]->GetNumberOfPoints();
  }
  po::setBlockTable(points, table);
  po::keepHierarchy(data, points);
}

/// The flag is for views alone, but no event tells of it.
struct ScreenshotAccess : vtkPVRenderView
{
  static bool isCapturing(vtkPVRenderView& view)
  {
    bool (vtkPVView::*flag)() = &ScreenshotAccess::GetInCaptureScreenshot;
    return (view.*flag)();
  }
};

/// All blocks that have points.
std::vector<vtkSmartPointer<vtkPointSet>> blocksOf(vtkDataObject* data)
{
  std::vector<vtkSmartPointer<vtkPointSet>> blocks;
  for (vtkDataSet* block : po::blocksWithPoints(data))
  {
    blocks.push_back(pointsOf(block));
  }
  return blocks;
}
}

vtkRayTracedSphereRepresentation::vtkRayTracedSphereRepresentation()
  : Delivered(std::make_unique<po::DeliveredParticles>())
  , Crop(std::make_unique<Cropping>())
  , BlockStyles(std::make_unique<Blocks>())
  , Refine(std::make_unique<Refinement>())
{
  vtkMath::UninitializeBounds(this->Bounds);
  this->Actor->SetMapper(this->Mapper);
  this->Refine->Command->SetClientData(this);
  this->Refine->Command->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*)
    {
      auto* me = static_cast<vtkRayTracedSphereRepresentation*>(self);
      if (me->Refine->Timer)
      {
        me->Refine->Timer->start();
      }
    });
  this->Mapper->AddObserver(vtkCommand::UpdateEvent, this->Refine->Command);
}

vtkRayTracedSphereRepresentation::~vtkRayTracedSphereRepresentation() = default;

bool vtkRayTracedSphereRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  this->View = renderView;
  renderView->GetRenderer()->AddActor(this->Actor);
  this->Refine->Timer = std::make_unique<po::RefinementTimer>(renderView);
  renderView->RegisterPropForHardwareSelection(this, this->Actor);
  return this->Superclass::AddToView(view);
}

bool vtkRayTracedSphereRepresentation::RemoveFromView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->RemoveActor(this->Actor);
  this->Refine->Timer.reset();
  renderView->UnRegisterPropForHardwareSelection(this, this->Actor);
  this->ReleaseMemory();
  return this->Superclass::RemoveFromView(view);
}

int vtkRayTracedSphereRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  // Where the data are not, on a client for instance, a representation has no input.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkRayTracedSphereRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto blocks = blocksOf(vtkDataObject::GetData(inputVector[0], 0));
  std::string warning;
  this->Particles = po::mergeParticles({ blocks.begin(), blocks.end() }, warning);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  auto* composite = vtkCompositeDataSet::SafeDownCast(vtkDataObject::GetData(inputVector[0], 0));
  if (composite)
  {
    keepBlocks(*composite, blocks, *this->Particles);
  }
  this->ResolveRadii();
  const po::ControllerGroup group(vtkMultiProcessController::GetGlobalController());
  this->Piece = po::pieceToDeliver(this->Particles, group.rank(), group.size());
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

/// What is chosen automatically is chosen for the particles of all processes.
void vtkRayTracedSphereRepresentation::ResolveRadii()
{
  const po::ControllerGroup group(vtkMultiProcessController::GetGlobalController());
  po::RadiusSettings radii{ this->RadiusArray, 1.0, this->ConstantRadius };
  if (group.size() > 1)
  {
    radii = po::resolveRadii(*this->Particles, radii, group);
  }
  this->Mapper->SetRadiusArray(radii.array.c_str());
  this->Mapper->SetConstantRadius(radii.constant);
}

int vtkRayTracedSphereRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0; // not visible, nothing to do
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->ProvideData(inInfo);
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    std::string warning;
    this->Mapper->SetInputDataObject(
      this->Delivered->update(vtkPVView::GetDeliveredPiece(inInfo, this), warning));
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
    this->UpdateColoring();
    this->UpdateCropping();
    this->UpdateRefinement();
  }
  return 1;
}

void vtkRayTracedSphereRepresentation::ProvideData(vtkInformation* inInfo)
{
  if (this->Particles)
  {
    vtkPVView::SetPiece(inInfo, this, this->Piece);
    this->UpdateBounds();
  }
  vtkNew<vtkMatrix4x4> matrix;
  this->Actor->GetMatrix(matrix);
  vtkPVRenderView::SetGeometryBounds(inInfo, this, this->Bounds, matrix);
}

void vtkRayTracedSphereRepresentation::UpdateBounds()
{
  // Not each time: the mapper reads the spheres again when it changes between the particles and the
  // delivered copy of them.
  if (this->BoundsTime < this->Particles->GetMTime() || this->BoundsTime < this->RadiusTime)
  {
    this->Mapper->SetInputDataObject(this->Particles);
    this->Mapper->GetBounds(this->Bounds);
    this->BoundsTime.Modified();
  }
}

void vtkRayTracedSphereRepresentation::UpdateColoring()
{
  vtkInformation* info = this->GetInputArrayInformation(0);
  const bool byArray = info && info->Has(vtkDataObject::FIELD_ASSOCIATION()) &&
    info->Has(vtkDataObject::FIELD_NAME()) &&
    info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  const char* name = byArray ? info->Get(vtkDataObject::FIELD_NAME()) : nullptr;
  const bool colored = name && name[0] != '\0';
  this->Mapper->SetScalarVisibility(colored);
  this->Mapper->SetScalarModeToUsePointFieldData();
  this->Mapper->SetUseLookupTableScalarRange(true);
  this->Mapper->SelectColorArray(colored ? name : nullptr);
}

/// What the next frame would need is made again then.
void vtkRayTracedSphereRepresentation::ReleaseMemory()
{
  this->Mapper->ReleaseSpheres();
  this->Mapper->SetInputDataObject(nullptr);
  *this->Delivered = po::DeliveredParticles();
}

void vtkRayTracedSphereRepresentation::UpdateCropping()
{
  vtkPolyData* points = this->Mapper->GetInput();
  const std::pair<vtkPolyData*, vtkMTimeType> source{ points, points ? points->GetMTime() : 0 };
  if (points && (this->BlockStyles->IsNew || source != this->BlockStyles->Applied))
  {
    this->BlockStyles->Looks.apply(*points, *this->Mapper);
    this->BlockStyles->Applied = source;
    this->BlockStyles->IsNew = false;
  }
  Cropping& crop = *this->Crop;
  if (!crop.IsNew)
  {
    return;
  }
  crop.IsNew = false;
  this->Mapper->RemoveAllCropRanges();
  this->Mapper->RemoveAllClippingPlanes();
  if (!crop.Array.empty())
  {
    this->Mapper->AddCropRange(crop.Array.c_str(), crop.Component, crop.Limits[0], crop.Limits[1]);
  }
  for (const Cropping::Range& range : crop.MoreRanges)
  {
    this->Mapper->AddCropRange(range.Array.c_str(), range.Component, range.Low, range.High);
  }
  if (crop.Plane)
  {
    addPlane(this->Mapper, crop.PlaneOrigin.data(), crop.PlaneNormal.data());
  }
  if (crop.Box)
  {
    addBox(this->Mapper, crop.BoxOrigin, crop.BoxSize);
  }
}

void vtkRayTracedSphereRepresentation::UpdateRefinement()
{
  // Only what this process alone draws on a screen can be refined step by step.
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  this->Mapper->SetProgressive(view && !ScreenshotAccess::isCapturing(*view) &&
    view->GetInteractor() && !view->GetUseDistributedRenderingForRender());
}

void vtkRayTracedSphereRepresentation::SetVisibility(bool visible)
{
  this->Actor->SetVisibility(visible);
  if (!visible)
  {
    this->ReleaseMemory();
  }
  this->Superclass::SetVisibility(visible);
}

// Parameters of the geometry change the bounds, which the view asks for in an update only.

void vtkRayTracedSphereRepresentation::SetRadiusArray(const char* name)
{
  this->RadiusArray = name ? name : "";
  this->Mapper->SetRadiusArray(name);
  this->RadiusTime.Modified();
  this->MarkModified();
}

void vtkRayTracedSphereRepresentation::SetRadiusScale(double scale)
{
  this->Mapper->SetRadiusScale(scale);
  this->RadiusTime.Modified();
  this->MarkModified();
}

void vtkRayTracedSphereRepresentation::SetConstantRadius(double radius)
{
  this->ConstantRadius = radius;
  this->Mapper->SetConstantRadius(radius);
  this->RadiusTime.Modified();
  this->MarkModified();
}

void vtkRayTracedSphereRepresentation::SetShadingMode(int mode)
{
  this->Mapper->SetShadingMode(mode);
}

void vtkRayTracedSphereRepresentation::SetOcclusionOnDiffuse(bool on)
{
  this->Mapper->SetOcclusionOnDiffuse(on);
}

void vtkRayTracedSphereRepresentation::SetShadows(bool on)
{
  this->Mapper->SetShadows(on);
}

void vtkRayTracedSphereRepresentation::SetSamplesPerPixel(int samples)
{
  this->Mapper->SetSamplesPerPixel(samples);
}

void vtkRayTracedSphereRepresentation::SetInteractiveRate(double framesPerSecond)
{
  this->Mapper->SetInteractiveRate(framesPerSecond);
}

// Cropping takes effect when the view is rendered next; nothing is updated for it.

void vtkRayTracedSphereRepresentation::AddCropRange(
  const char* array, int component, double low, double high)
{
  this->Crop->MoreRanges.push_back({ array ? array : "", component, low, high });
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::RemoveAllCropRanges()
{
  this->Crop->MoreRanges.clear();
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropArray(
  int, int, int, int association, const char* name)
{
  const bool ofPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  const bool isOne = name && std::string(name) != po::RadiusSettings::NoArray;
  this->Crop->Array = ofPoints && isOne ? name : "";
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropComponent(int component)
{
  this->Crop->Component = component;
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropRange(double low, double high)
{
  this->Crop->Limits = { low, high };
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropPlane(bool on)
{
  this->Crop->Plane = on;
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropPlaneOrigin(double x, double y, double z)
{
  this->Crop->PlaneOrigin = { x, y, z };
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropPlaneNormal(double x, double y, double z)
{
  this->Crop->PlaneNormal = { x, y, z };
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropBox(bool on)
{
  this->Crop->Box = on;
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropBoxOrigin(double x, double y, double z)
{
  this->Crop->BoxOrigin = { x, y, z };
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetCropBoxSize(double x, double y, double z)
{
  this->Crop->BoxSize = { x, y, z };
  this->Crop->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetActiveAssembly(const char* name)
{
  if (name && std::string(name) != vtkDataAssemblyUtilities::HierarchyName())
  {
    vtkWarningMacro("Ray-traced spheres know blocks by the assembly \"Hierarchy\" only, not by \""
      << name << "\".");
  }
}

void vtkRayTracedSphereRepresentation::AddBlockSelector(const char* selector)
{
  this->BlockStyles->Looks.visible.emplace_back(selector ? selector : "");
  this->BlockStyles->IsNew = true;
}

void vtkRayTracedSphereRepresentation::RemoveAllBlockSelectors()
{
  this->BlockStyles->Looks.visible.clear();
  this->BlockStyles->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetBlockColor(
  const char* selector, double red, double green, double blue)
{
  this->BlockStyles->Looks.colors.push_back({ selector ? selector : "", { red, green, blue } });
  this->BlockStyles->IsNew = true;
}

void vtkRayTracedSphereRepresentation::RemoveAllBlockColors()
{
  this->BlockStyles->Looks.colors.clear();
  this->BlockStyles->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetBlockOpacity(const char* selector, double opacity)
{
  this->BlockStyles->Looks.opacities.emplace_back(selector ? selector : "", opacity);
  this->BlockStyles->IsNew = true;
}

void vtkRayTracedSphereRepresentation::RemoveAllBlockOpacities()
{
  this->BlockStyles->Looks.opacities.clear();
  this->BlockStyles->IsNew = true;
}

void vtkRayTracedSphereRepresentation::SetLookupTable(vtkScalarsToColors* table)
{
  this->Mapper->SetLookupTable(table);
}

void vtkRayTracedSphereRepresentation::SetMapScalars(int map)
{
  this->Mapper->SetColorMode(map != 0 ? VTK_COLOR_MODE_MAP_SCALARS : VTK_COLOR_MODE_DIRECT_SCALARS);
}

vtkImageData* vtkRayTracedSphereRepresentation::GetLayers()
{
  return this->Mapper->GetLayers();
}

void vtkRayTracedSphereRepresentation::SetLayersFile(const char* name)
{
  this->LayersFile = name ? name : "";
}

const char* vtkRayTracedSphereRepresentation::GetLayersFile()
{
  return this->LayersFile.c_str();
}

void vtkRayTracedSphereRepresentation::SetLayersResolution(int width, int height)
{
  this->LayersResolution[0] = width;
  this->LayersResolution[1] = height;
}

/// The client or the server, whichever the view has chosen; ParaView calls both.
bool vtkRayTracedSphereRepresentation::DrawsHere()
{
  const bool onServer = this->View && this->View->GetUseDistributedRenderingForRender();
  switch (vtkProcessModule::GetProcessType())
  {
    case vtkProcessModule::PROCESS_CLIENT:
      return !onServer;
    case vtkProcessModule::PROCESS_SERVER:
    case vtkProcessModule::PROCESS_RENDER_SERVER:
      return onServer;
    case vtkProcessModule::PROCESS_DATA_SERVER:
      return false;
    default:
      return true;
  }
}

vtkSmartPointer<vtkImageData> vtkRayTracedSphereRepresentation::MakeLayers()
{
  const int width = this->LayersResolution[0];
  const int height = this->LayersResolution[1];
  if (!this->View || (width == 0 && height == 0))
  {
    return this->Mapper->GetLayers();
  }
  return this->Mapper->RenderLayers(this->View->GetRenderer(), this->Actor, width, height);
}

void vtkRayTracedSphereRepresentation::WriteLayers()
{
  if (!this->DrawsHere())
  {
    return;
  }
  vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
  if (this->LayersFile.empty())
  {
    vtkErrorMacro("LayersFile is empty: name the OpenEXR file to write the layers to.");
    return;
  }
  if (processes && processes->GetNumberOfProcesses() > 1)
  {
    vtkErrorMacro("Layers can only be written where one process draws all spheres.");
    return;
  }
  const vtkSmartPointer<vtkImageData> layers = this->MakeLayers();
  if (layers->GetNumberOfPoints() == 0)
  {
    vtkErrorMacro("There are no layers to write: show the spheres and render the view first.");
    return;
  }
  vtkNew<vtkRenderedLayersWriter> writer; // reports its own errors
  writer->SetInputData(layers);
  writer->SetFileName(this->LayersFile.c_str());
  writer->Write();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfSpheres()
{
  return this->Mapper->GetNumberOfSpheres();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfShownSpheres()
{
  return this->Mapper->GetNumberOfShownSpheres();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfTracedFrames()
{
  return this->Mapper->GetNumberOfTracedFrames();
}

int vtkRayTracedSphereRepresentation::GetNumberOfSamples()
{
  return this->Mapper->GetNumberOfSamples();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfScenes()
{
  return vtkRayTracedSphereMapper::GetNumberOfScenes();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfRays()
{
  return this->Mapper->GetNumberOfRays();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfShadowRays()
{
  return this->Mapper->GetNumberOfShadowRays();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfSkippedTiles()
{
  return this->Mapper->GetNumberOfSkippedTiles();
}

vtkIdType vtkRayTracedSphereRepresentation::GetNumberOfSkippedShadowRays()
{
  return this->Mapper->GetNumberOfSkippedShadowRays();
}

double vtkRayTracedSphereRepresentation::GetTraceSeconds()
{
  return this->Mapper->GetTraceSeconds();
}

double vtkRayTracedSphereRepresentation::GetShadowSeconds()
{
  return this->Mapper->GetShadowSeconds();
}

double vtkRayTracedSphereRepresentation::GetShadeSeconds()
{
  return this->Mapper->GetShadeSeconds();
}

void vtkRayTracedSphereRepresentation::SetOrientation(double x, double y, double z)
{
  this->Actor->SetOrientation(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetOrigin(double x, double y, double z)
{
  this->Actor->SetOrigin(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetPickable(int pickable)
{
  this->Actor->SetPickable(pickable);
}

void vtkRayTracedSphereRepresentation::SetPosition(double x, double y, double z)
{
  this->Actor->SetPosition(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetScale(double x, double y, double z)
{
  this->Actor->SetScale(x, y, z);
}

void vtkRayTracedSphereRepresentation::SetAmbient(double coefficient)
{
  this->Actor->GetProperty()->SetAmbient(coefficient);
}

void vtkRayTracedSphereRepresentation::SetAmbientColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetAmbientColor(r, g, b);
}

void vtkRayTracedSphereRepresentation::SetDiffuse(double coefficient)
{
  this->Actor->GetProperty()->SetDiffuse(coefficient);
}

void vtkRayTracedSphereRepresentation::SetDiffuseColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetDiffuseColor(r, g, b);
}

void vtkRayTracedSphereRepresentation::SetOpacity(double opacity)
{
  this->Actor->GetProperty()->SetOpacity(opacity);
}

void vtkRayTracedSphereRepresentation::SetSpecular(double coefficient)
{
  this->Actor->GetProperty()->SetSpecular(coefficient);
}

void vtkRayTracedSphereRepresentation::SetSpecularColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetSpecularColor(r, g, b);
}

void vtkRayTracedSphereRepresentation::SetSpecularPower(double power)
{
  this->Actor->GetProperty()->SetSpecularPower(power);
}

void vtkRayTracedSphereRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mapper:\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
