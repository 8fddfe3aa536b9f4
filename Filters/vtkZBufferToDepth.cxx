// SPDX-License-Identifier: BSD-3-Clause
#include "vtkZBufferToDepth.h"

#include "Projection.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

vtkStandardNewMacro(vtkZBufferToDepth);

namespace
{
/// `zBuffer` and `depth` are row-major images of `width` x `height` pixels.
void convert(const po::WindowToEye& windowToEye, vtkDataArray* zBuffer, int width, int height,
  vtkFloatArray* depth)
{
  for (int j = 0; j < height; ++j)
  {
    const double y = po::pixelCenter(j, height);
    for (int i = 0; i < width; ++i)
    {
      const vtkIdType pixel = static_cast<vtkIdType>(j) * width + i;
      const double z = zBuffer->GetComponent(pixel, 0);
      const double t = po::eyeDistance(windowToEye, po::pixelCenter(i, width), y, z);
      depth->SetValue(pixel, static_cast<float>(t));
    }
  }
}
}

vtkZBufferToDepth::vtkZBufferToDepth() = default;
vtkZBufferToDepth::~vtkZBufferToDepth() = default;

void vtkZBufferToDepth::SetProjectionMatrix(vtkMatrix4x4* matrix)
{
  if (this->ProjectionMatrix != matrix)
  {
    this->ProjectionMatrix = matrix;
    this->Modified();
  }
}

vtkMatrix4x4* vtkZBufferToDepth::GetProjectionMatrix()
{
  return this->ProjectionMatrix;
}

vtkMTimeType vtkZBufferToDepth::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ProjectionMatrix ? std::max(own, this->ProjectionMatrix->GetMTime()) : own;
}

int vtkZBufferToDepth::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkDataObject::SetPointDataActiveScalarInfo(outputVector->GetInformationObject(0), VTK_FLOAT, 1);
  return 1;
}

int vtkZBufferToDepth::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  // A pixel's ray depends on the size of the whole image.
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
  return 1;
}

int vtkZBufferToDepth::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  vtkDataArray* zBuffer = input->GetPointData()->GetScalars();
  int dimensions[3];
  input->GetDimensions(dimensions);
  if (!zBuffer || zBuffer->GetNumberOfComponents() != 1 || dimensions[2] != 1)
  {
    vtkErrorMacro("The input's active scalars are no z-buffer: one slice of a one-component array "
                  "of values in [0, 1] is needed.");
    return 0;
  }
  const auto windowToEye = po::windowToEyeOf(this->ProjectionMatrix);
  if (!windowToEye)
  {
    vtkErrorMacro("ProjectionMatrix is not set or singular: set the projection of the camera that "
                  "drew the z-buffer.");
    return 0;
  }

  vtkNew<vtkFloatArray> depth;
  depth->SetName("Z");
  depth->SetNumberOfTuples(input->GetNumberOfPoints());
  convert(*windowToEye, zBuffer, dimensions[0], dimensions[1], depth);
  output->CopyStructure(input);
  output->GetPointData()->SetScalars(depth);
  return 1;
}

void vtkZBufferToDepth::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ProjectionMatrix: " << this->ProjectionMatrix << "\n";
}
