// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereRepresentation.h"

#include "ControllerGroup.h"
#include "FreeLength.h"
#include "GatheredParticles.h"
#include "MapperCropping.h"
#include "SilhouetteVisibility.h"
#include "SphereRenderer.h"
#include "WholeSet.h"
#include "vtkRayTracedSphereRepresentationInternals.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkProperty.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"

#include <string>

vtkStandardNewMacro(vtkRayTracedSphereRepresentation);

vtkRayTracedSphereRepresentation::vtkRayTracedSphereRepresentation()
  : Internal(std::make_unique<Internals>(this->Mapper))
{
  this->Actor->SetMapper(this->Mapper);
  this->Silhouettes->AddActor(this->Actor);
  this->Silhouettes->LineVisibilityOff();
}

vtkRayTracedSphereRepresentation::~vtkRayTracedSphereRepresentation() = default;

bool vtkRayTracedSphereRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  this->Internal->View = renderView;
  renderView->GetRenderer()->AddActor(this->Actor);
  this->Internal->Refinement.begin(renderView);
  this->Internal->Sight.begin(renderView);
  renderView->GetRenderer()->AddViewProp(this->Silhouettes);
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
  this->Internal->Refinement.end();
  this->Internal->Sight.end();
  renderView->GetRenderer()->RemoveViewProp(this->Silhouettes);
  this->Silhouettes->SetRenderer(nullptr);
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
  std::string warning;
  this->Internal->Particles =
    po::gatherParticles(vtkDataObject::GetData(inputVector[0], 0), warning);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  this->Internal->Radii.resolve(*this->Internal->Particles, *this->Mapper);
  this->ShareExtent();
  const po::ControllerGroup group(vtkMultiProcessController::GetGlobalController());
  this->Internal->Piece = po::pieceToDeliver(this->Internal->Particles, group.rank(), group.size());
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

/// Tells the mapper of the particles of all processes.
void vtkRayTracedSphereRepresentation::ShareExtent()
{
  const po::ControllerGroup group(vtkMultiProcessController::GetGlobalController());
  if (group.size() > 1)
  {
    this->UpdateBounds();
    const po::SphereCloud& cloud = this->Mapper->GetSphereRenderer().cloud();
    const po::WholeSet all = po::wholeSetOf({ static_cast<double>(cloud.spheres.size()),
                                              cloud.scale, vtkBoundingBox(this->Internal->Bounds) },
      group);
    const double freeLength = po::meanFreeLength(cloud, { all.particles, all.meanRadius }, group);
    this->Mapper->SetWholeSet(
      all.particles, all.meanRadius, all.bounds.GetDiagonalLength(), freeLength);
  }
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
    this->ProvideData(inInfo, outInfo);
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    this->PrepareFrame(inInfo);
  }
  return 1;
}

void vtkRayTracedSphereRepresentation::ProvideData(vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (this->Internal->Particles)
  {
    vtkPVView::SetPiece(inInfo, this, this->Internal->Piece);
    this->UpdateBounds();
  }
  vtkNew<vtkMatrix4x4> matrix;
  this->Actor->GetMatrix(matrix);
  vtkPVRenderView::SetGeometryBounds(inInfo, this, this->Internal->Bounds, matrix);
  // What is translucent leaves no depth: processes' pictures are laid over each other then, in the
  // order of where their particles are.
  const bool translucent = this->IsTranslucent();
  outInfo->Set(vtkPVRenderView::NEED_ORDERED_COMPOSITING(), translucent ? 1 : 0);
  vtkPVRenderView::SetOrderedCompositingConfiguration(
    inInfo, this, translucent ? vtkPVRenderView::USE_BOUNDS_FOR_REDISTRIBUTION : 0);
}

/// By what all processes know alike, with particles and without: they must composite alike.
bool vtkRayTracedSphereRepresentation::IsTranslucent()
{
  this->UpdateColoring();
  const bool byMap =
    this->Mapper->GetScalarVisibility() != 0 && this->Mapper->GetLookupTable()->IsOpaque() == 0;
  return byMap || this->Actor->GetProperty()->GetOpacity() < 1 ||
    this->Internal->Blocks.get().anyTranslucent();
}

void vtkRayTracedSphereRepresentation::PrepareFrame(vtkInformation* inInfo)
{
  std::string warning;
  this->Mapper->SetInputDataObject(
    this->Internal->Delivered.update(vtkPVView::GetDeliveredPiece(inInfo, this), warning));
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  this->UpdateColoring();
  this->Internal->Blocks.update(*this->Mapper);
  if (this->Internal->Crop.isNew())
  {
    po::crop(*this->Mapper, this->Internal->Crop.use());
  }
  this->Internal->Refinement.prepare(vtkPVRenderView::SafeDownCast(this->GetView()));
  warning = po::updateVisibility(*this->Silhouettes, *this->Actor, this->Internal->View);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
}

void vtkRayTracedSphereRepresentation::UpdateBounds()
{
  // Not each time: the mapper reads the spheres again when it changes between the particles and the
  // delivered copy of them.
  if (this->Internal->BoundsTime < this->Internal->Particles->GetMTime() ||
    this->Internal->BoundsTime < this->Internal->Radii.changeTime())
  {
    this->Mapper->SetInputDataObject(this->Internal->Particles);
    this->Mapper->GetBounds(this->Internal->Bounds);
    this->Internal->BoundsTime.Modified();
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
  this->Internal->Delivered = po::DeliveredParticles();
}

void vtkRayTracedSphereRepresentation::SetVisibility(bool visible)
{
  this->Actor->SetVisibility(visible);
  if (!visible)
  {
    this->ReleaseMemory();
  }
  this->Silhouettes->SetVisibility(visible);
  this->Superclass::SetVisibility(visible);
}

// Parameters of the geometry change the bounds, which the view asks for in an update only.

void vtkRayTracedSphereRepresentation::SetRadiusArray(const char* name)
{
  this->Internal->Radii.change().array = name ? name : "";
  this->MarkModified();
}

void vtkRayTracedSphereRepresentation::SetRadiusScale(double scale)
{
  this->Internal->Radii.change().scale = scale;
  this->MarkModified();
}

void vtkRayTracedSphereRepresentation::SetConstantRadius(double radius)
{
  this->Internal->Radii.change().constant = radius;
  this->MarkModified();
}

void vtkRayTracedSphereRepresentation::SetRadiusFrom(int source)
{
  this->Internal->Radii.change().from = static_cast<po::RadiusSource>(source);
  this->MarkModified();
}

void vtkRayTracedSphereRepresentation::SetDensity(double density)
{
  this->Internal->Radii.change().density = density;
  this->MarkModified();
}

const char* vtkRayTracedSphereRepresentation::GetRadiusUsed()
{
  return this->Internal->Radii.used().c_str();
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
  this->Internal->Blocks.change().visible.emplace_back(selector ? selector : "");
}

void vtkRayTracedSphereRepresentation::RemoveAllBlockSelectors()
{
  this->Internal->Blocks.change().visible.clear();
}

void vtkRayTracedSphereRepresentation::SetBlockColor(
  const char* selector, double red, double green, double blue)
{
  this->Internal->Blocks.change().colors.push_back(
    { selector ? selector : "", { red, green, blue } });
}

void vtkRayTracedSphereRepresentation::RemoveAllBlockColors()
{
  this->Internal->Blocks.change().colors.clear();
}

void vtkRayTracedSphereRepresentation::SetBlockOpacity(const char* selector, double opacity)
{
  this->Internal->Blocks.change().opacities.emplace_back(selector ? selector : "", opacity);
}

void vtkRayTracedSphereRepresentation::RemoveAllBlockOpacities()
{
  this->Internal->Blocks.change().opacities.clear();
}

void vtkRayTracedSphereRepresentation::SetLayersFile(const char* name)
{
  this->Internal->Layers.name = name ? name : "";
}

const char* vtkRayTracedSphereRepresentation::GetLayersFile()
{
  return this->Internal->Layers.name.c_str();
}

void vtkRayTracedSphereRepresentation::SetLayersResolution(int width, int height)
{
  this->Internal->Layers.width = width;
  this->Internal->Layers.height = height;
}

void vtkRayTracedSphereRepresentation::WriteLayers()
{
  const std::string error =
    this->Internal->Layers.write(this->Internal->View, *this->Mapper, this->Actor);
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
}

void vtkRayTracedSphereRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mapper:\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
