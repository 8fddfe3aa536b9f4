// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthSilhouettes.h"

#include "ImageDepth.h"
#include "SilhouetteFinder.h"
#include "SilhouetteParametersOf.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

vtkStandardNewMacro(vtkDepthSilhouettes);

namespace
{
const char* const SilhouetteName = "Silhouette";

bool isDepth(vtkDataArray* array)
{
  return array && array->GetNumberOfComponents() == 1 &&
    (vtkFloatArray::SafeDownCast(array) || vtkDoubleArray::SafeDownCast(array));
}

/// The active scalars if they can be depth, else "Z", else "depth".
vtkDataArray* defaultDepth(vtkPointData* points)
{
  for (vtkDataArray* array :
    { points->GetScalars(), points->GetArray("Z"), points->GetArray("depth") })
  {
    if (isDepth(array))
    {
      return array;
    }
  }
  return nullptr;
}

vtkIdType pixelsOfSlice(const int extent[6])
{
  return static_cast<vtkIdType>(extent[1] - extent[0] + 1) * (extent[3] - extent[2] + 1);
}

/// An image of s x s samples a pixel becomes one of pixels: the origin moves to the middle of the
/// first pixel's samples.
void coarsen(int samples, int extent[6], double spacing[3], double origin[3])
{
  for (int axis = 0; axis < 2; ++axis)
  {
    const int count = (extent[2 * axis + 1] - extent[2 * axis] + 1) / samples;
    origin[axis] += spacing[axis] * (extent[2 * axis] + 0.5 * (samples - 1));
    spacing[axis] *= samples;
    extent[2 * axis] = 0;
    extent[2 * axis + 1] = count - 1;
  }
}

/// The input itself, or an empty image of the coarser size.
void prepareOutput(vtkImageData* input, int samples, vtkImageData* output)
{
  if (samples == 1)
  {
    output->ShallowCopy(input);
    return;
  }
  int extent[6];
  double spacing[3], origin[3];
  input->GetExtent(extent);
  input->GetSpacing(spacing);
  input->GetOrigin(origin);
  coarsen(samples, extent, spacing, origin);
  output->SetExtent(extent);
  output->SetSpacing(spacing);
  output->SetOrigin(origin);
}

/// Calls `work` with the array's values as const float* or const double*.
template <typename Work>
void withValues(vtkDataArray* depth, Work work)
{
  if (auto* floats = vtkFloatArray::SafeDownCast(depth))
  {
    work(static_cast<const float*>(floats->GetPointer(0)));
  }
  else if (auto* doubles = vtkDoubleArray::SafeDownCast(depth))
  {
    work(static_cast<const double*>(doubles->GetPointer(0)));
  }
}
}

vtkDepthSilhouettes::vtkDepthSilhouettes() = default;
vtkDepthSilhouettes::~vtkDepthSilhouettes() = default;

bool vtkDepthSilhouettes::CheckParameters(const int extent[6])
{
  const std::string fault = po::faultOf(po::silhouetteParametersOf(*this));
  const int columns = extent[1] - extent[0] + 1, rows = extent[3] - extent[2] + 1;
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
  }
  else if (!(this->ParticleRadius >= 0.0 && std::isfinite(this->ParticleRadius)))
  {
    vtkErrorMacro(
      "ParticleRadius is " << this->ParticleRadius << "; it must be a length >= 0 (0: not known).");
  }
  else if (this->ThresholdUnit != 0 && this->ParticleRadius == 0.0)
  {
    vtkErrorMacro("ThresholdUnit asks for particle radii: set ParticleRadius.");
  }
  else if (columns % this->Samples != 0 || rows % this->Samples != 0)
  {
    vtkErrorMacro("The image has " << columns << " x " << rows
                                   << " depths, which is no multiple of Samples (" << this->Samples
                                   << ").");
  }
  else
  {
    return true;
  }
  return false;
}

vtkDataArray* vtkDepthSilhouettes::FindDepth(
  vtkImageData* input, vtkInformationVector** inputVector)
{
  const char* chosen = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  if (!chosen || !*chosen) // ParaView sets an empty name where there is no choice
  {
    vtkDataArray* array = defaultDepth(input->GetPointData());
    if (!array)
    {
      vtkErrorMacro("There is no depth array: choose a one-component float or double point array, "
                    "or name it Z or depth.");
    }
    return array;
  }

  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* array = this->GetInputArrayToProcess(0, inputVector, association);
  if (!array || association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    vtkErrorMacro("The image has no point array " << chosen
                                                  << ": choose a one-component float or double "
                                                     "point array of depth.");
    return nullptr;
  }
  if (!isDepth(array))
  {
    vtkErrorMacro("Array " << chosen << " (" << array->GetNumberOfComponents()
                           << " components of type " << array->GetDataTypeAsString()
                           << ") is no depth: choose a one-component float or double point array.");
    return nullptr;
  }
  return array;
}

int vtkDepthSilhouettes::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 1);
  int extent[6];
  double spacing[3], origin[3];
  vtkInformation* inputInfo = inputVector[0]->GetInformationObject(0);
  inputInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  if (po::isSampleCount(this->Samples) && this->Samples > 1 &&
    inputInfo->Has(vtkDataObject::SPACING()) && inputInfo->Has(vtkDataObject::ORIGIN()))
  {
    inputInfo->Get(vtkDataObject::SPACING(), spacing);
    inputInfo->Get(vtkDataObject::ORIGIN(), origin);
    coarsen(this->Samples, extent, spacing, origin);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::SPACING(), spacing, 3);
    info->Set(vtkDataObject::ORIGIN(), origin, 3);
  }
  return 1;
}

int vtkDepthSilhouettes::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  // The farthest depth is a matter of the whole image.
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
  return 1;
}

int vtkDepthSilhouettes::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  int extent[6];
  input->GetExtent(extent);
  vtkDataArray* depth =
    this->CheckParameters(extent) ? this->FindDepth(input, inputVector) : nullptr;
  if (!depth)
  {
    return 0;
  }
  prepareOutput(input, this->Samples, output);
  vtkNew<vtkFloatArray> silhouette;
  silhouette->SetName(SilhouetteName);
  silhouette->SetNumberOfTuples(output->GetNumberOfPoints());
  const int width = extent[1] - extent[0] + 1, height = extent[3] - extent[2] + 1;
  const po::SilhouetteParameters parameters = po::silhouetteParametersOf(*this);
  withValues(depth,
    [&](const auto* values)
    {
      using T = std::decay_t<decltype(*values)>;
      po::SilhouetteImage lines;
      float* strength = silhouette->GetPointer(0);
      for (int k = 0; k <= extent[5] - extent[4]; ++k)
      {
        const po::ImageDepth<T> source(
          po::DepthImage<T>{ values + k * pixelsOfSlice(extent), width, height }, this->Samples);
        const po::SilhouetteScale scale{ this->ParticleRadius, po::depthSpread(source) };
        po::findSilhouettes(source, po::resolve(parameters, scale), lines);
        strength = std::copy(lines.strength.begin(), lines.strength.end(), strength);
      }
    });
  output->GetPointData()->AddArray(silhouette); // SetScalars would drop the input's scalars
  output->GetPointData()->SetActiveScalars(SilhouetteName);
  return 1;
}

void vtkDepthSilhouettes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  po::print(os, indent, po::silhouetteParametersOf(*this));
  os << indent << "ParticleRadius: " << this->ParticleRadius << "\n";
}
