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
 * Output: as active scalars the one-component float array "Silhouette": strength of the line, 0 to
 * 1. With Samples 1 (the default) the output is the input with all its arrays and this one. With
 * Samples s the input has s x s depths a pixel, as from a renderer that was asked for an image s
 * times as large, and the output is an image of 1/s of its size with this array alone: lines are
 * antialiased and their widths are in pixels of the output.
 *
 * What is a line, see vtkSilhouetteParametersMacro: in short, a sample where the Laplacian
 * 8 t(centre) - sum of t(8 neighbours) exceeds Threshold. Only this positive side counts, so that a
 * jump gives one line; it lies behind the jump, around the object in front. The border of the image
 * is repeated beyond it. An automatic threshold is three times the jump of two ParticleRadius, or
 * of 1/50 of the spread of the visible depths (5th to 95th percentile) where that is more.
 *
 * vtkDepthSilhouettePass draws the same lines on screen. vtkZBufferToDepth makes the depth image
 * from a z-buffer.
 *
 * Errors, with no output array: no such array, an array of the wrong type or number of components,
 * a parameter out of its range, ThresholdUnit 1 without ParticleRadius, an image whose size is no
 * multiple of Samples.
 */
#ifndef vtkDepthSilhouettes_h
#define vtkDepthSilhouettes_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkImageAlgorithm.h"
#include "vtkSilhouetteParametersMacro.h"

class vtkDataArray;

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkDepthSilhouettes : public vtkImageAlgorithm
{
public:
  static vtkDepthSilhouettes* New();
  vtkTypeMacro(vtkDepthSilhouettes, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkSilhouetteParametersMacro(1);

public:
  ///@{
  /**
   * Mean radius of the particles in world units, >= 0, for ThresholdUnit 1 and the automatic
   * threshold. 0 (default): not known.
   */
  vtkSetMacro(ParticleRadius, double);
  vtkGetMacro(ParticleRadius, double);
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

  double ParticleRadius = 0.0;

private:
  vtkDepthSilhouettes(const vtkDepthSilhouettes&) = delete;
  void operator=(const vtkDepthSilhouettes&) = delete;

  bool CheckParameters(const int extent[6]);
  vtkDataArray* FindDepth(vtkImageData* input, vtkInformationVector** inputVector);
};

#endif
