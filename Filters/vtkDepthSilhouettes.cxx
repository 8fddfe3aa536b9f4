// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthSilhouettes.h"

#include "DepthLaplacian.h"

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

#include <string>
#include <vector>

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

/// The slice `k` (from 0) of an array that fills `extent`.
template <typename T>
po::DepthImage<T> slice(const T* depth, const int extent[6], int k)
{
  return { depth + k * pixelsOfSlice(extent), extent[1] - extent[0] + 1,
    extent[3] - extent[2] + 1 };
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

struct vtkDepthSilhouettes::Internals
{
  vtkDataArray* Depth = nullptr;
  /// One a slice, resolved before the threads start.
  std::vector<po::EdgeRule> Rules;
};

vtkDepthSilhouettes::vtkDepthSilhouettes()
  : Internal(std::make_unique<Internals>())
{
  // VTK's multi-threader is parallel in every build; vtkSMPTools may have a sequential backend.
  this->EnableSMP = false;
}

vtkDepthSilhouettes::~vtkDepthSilhouettes() = default;

bool vtkDepthSilhouettes::CheckParameters()
{
  const std::string fault = po::faultOf({ this->Threshold, this->BackgroundDepth });
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
  }
  return fault.empty();
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
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkDataObject::SetPointDataActiveScalarInfo(outputVector->GetInformationObject(0), VTK_FLOAT, 1);
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

void vtkDepthSilhouettes::PrepareImageData(vtkInformationVector** inputVector,
  vtkInformationVector* outputVector, vtkImageData*** inDataObjects, vtkImageData** outDataObjects)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->ShallowCopy(input);

  vtkNew<vtkFloatArray> silhouette;
  silhouette->SetName(SilhouetteName);
  silhouette->SetNumberOfTuples(input->GetNumberOfPoints());
  output->GetPointData()->AddArray(silhouette); // SetScalars would drop the input's scalars
  output->GetPointData()->SetActiveScalars(SilhouetteName);

  inDataObjects[0][0] = input;
  outDataObjects[0] = output;
}

int vtkDepthSilhouettes::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkDataArray* depth = this->CheckParameters() ? this->FindDepth(input, inputVector) : nullptr;
  if (!depth)
  {
    return 0;
  }

  int extent[6];
  input->GetExtent(extent);
  const po::SilhouetteParameters parameters{ this->Threshold, this->BackgroundDepth };
  this->Internal->Depth = depth;
  this->Internal->Rules.clear();
  withValues(depth,
    [&](const auto* values)
    {
      for (int k = 0; k <= extent[5] - extent[4]; ++k)
      {
        const auto farthest = po::farthestDepth(slice(values, extent, k));
        this->Internal->Rules.push_back(po::resolveEdgeRule(parameters, farthest));
      }
    });

  const int done = this->Superclass::RequestData(request, inputVector, outputVector);
  this->Internal->Depth = nullptr;
  return done;
}

void vtkDepthSilhouettes::ThreadedRequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector*, vtkImageData***, vtkImageData** outData, int piece[6], int)
{
  int extent[6];
  outData[0]->GetExtent(extent);
  auto* silhouette = vtkFloatArray::SafeDownCast(outData[0]->GetPointData()->GetScalars());
  const po::PixelBlock block{ piece[0] - extent[0], piece[1] - extent[0] + 1, piece[2] - extent[2],
    piece[3] - extent[2] + 1 };
  withValues(this->Internal->Depth,
    [&](const auto* values)
    {
      for (int k = piece[4] - extent[4]; k <= piece[5] - extent[4]; ++k)
      {
        po::markSilhouettes(slice(values, extent, k), this->Internal->Rules[k], block,
          silhouette->GetPointer(k * pixelsOfSlice(extent)));
      }
    });
}

void vtkDepthSilhouettes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "BackgroundDepth: " << this->BackgroundDepth << "\n";
}
