// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDepthSilhouettes
 * @brief Silhouettes of a depth image, in world units.
 *
 * Input: an image with a one-component float or double point array of depth: the distance t in
 * world units along the normalised eye ray (perspective) or along the view direction (parallel).
 * Values that are not finite (infinity, NaN) are background. Without a choice by
 * SetInputArrayToProcess, the active scalars are taken if they are of that kind, else the array
 * "Z", else "depth". An image of several slices is a stack of depth images; each is its own.
 *
 * Output: the input with all its arrays and, as active scalars, the one-component float array
 * "Silhouette": edge strength, 1 on the line and 0 elsewhere.
 *
 * A pixel is an edge where the Laplacian 8 t(centre) - sum of t(8 neighbours) exceeds Threshold.
 * Only this positive side counts, so that a jump gives one line; it lies on the pixels just behind
 * the jump, around the object in front. The border of the image is repeated beyond it.
 *
 * vtkDepthSilhouettePass draws the same lines on screen. vtkZBufferToDepth makes the depth image
 * from a z-buffer.
 *
 * Errors, with no output array: no such array, an array of the wrong type or number of components,
 * a negative or non-finite Threshold or BackgroundDepth.
 */
#ifndef vtkDepthSilhouettes_h
#define vtkDepthSilhouettes_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkThreadedImageAlgorithm.h"

#include <memory>

class vtkDataArray;

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkDepthSilhouettes : public vtkThreadedImageAlgorithm
{
public:
  static vtkDepthSilhouettes* New();
  vtkTypeMacro(vtkDepthSilhouettes, vtkThreadedImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Laplacian above which a pixel is an edge, in world units, >= 0. A straight jump of depth J has
   * the value 3 J. 0 (the default) is automatic: 1/100 of the farthest depth in the image.
   */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /**
   * Depth of the background, in world units, >= 0. 0 (the default) is automatic: behind the
   * farthest geometry by twice the threshold (the automatic one if that is larger), so that the
   * outline against the background is always drawn.
   */
  vtkSetMacro(BackgroundDepth, double);
  vtkGetMacro(BackgroundDepth, double);
  ///@}

protected:
  vtkDepthSilhouettes();
  ~vtkDepthSilhouettes() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void PrepareImageData(vtkInformationVector** inputVector, vtkInformationVector* outputVector,
    vtkImageData*** inDataObjects, vtkImageData** outDataObjects) override;
  void ThreadedRequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, vtkImageData*** inData, vtkImageData** outData,
    int extent[6], int threadId) override;

  double Threshold = 0.0;
  double BackgroundDepth = 0.0;

private:
  vtkDepthSilhouettes(const vtkDepthSilhouettes&) = delete;
  void operator=(const vtkDepthSilhouettes&) = delete;

  bool CheckParameters();
  vtkDataArray* FindDepth(vtkImageData* input, vtkInformationVector** inputVector);

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
