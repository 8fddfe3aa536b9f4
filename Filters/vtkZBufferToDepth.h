// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkZBufferToDepth
 * @brief Turns an OpenGL z-buffer into a depth image in world units.
 *
 * Input: a one-component image of z in [0, 1] (active scalars), one pixel a pixel of the renderer's
 * viewport, such as vtkWindowToImageFilter gives with SetInputBufferTypeToZBuffer.
 * Output: an image with the one-component float point array "Z": distance in world units along the
 * normalised eye ray (perspective) or along the view direction (parallel), +infinity for
 * background (z = 1). This is what vtkDepthSilhouettes takes.
 *
 * Errors, with no output array: no or wrong input scalars, more than one slice, no or a singular
 * projection matrix.
 */
#ifndef vtkZBufferToDepth_h
#define vtkZBufferToDepth_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h"

class vtkMatrix4x4;

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkZBufferToDepth : public vtkImageAlgorithm
{
public:
  static vtkZBufferToDepth* New();
  vtkTypeMacro(vtkZBufferToDepth, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The OpenGL projection that the image was drawn with (eye to clip coordinates). From a renderer:
   * camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1).
   */
  virtual void SetProjectionMatrix(vtkMatrix4x4* matrix);
  vtkMatrix4x4* GetProjectionMatrix();
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkZBufferToDepth();
  ~vtkZBufferToDepth() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkZBufferToDepth(const vtkZBufferToDepth&) = delete;
  void operator=(const vtkZBufferToDepth&) = delete;

  vtkSmartPointer<vtkMatrix4x4> ProjectionMatrix;
};

#endif
