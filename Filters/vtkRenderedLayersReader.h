// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRenderedLayersReader
 * @brief Reads the layers of a rendered image from an OpenEXR file, of this or another renderer.
 *
 * The output is a 2-D vtkImageData of the file's data window, of the first part that is not deep.
 * Each channel becomes a point array of its name: HALF and FLOAT as float, UINT as unsigned int.
 * Channels at a lower resolution are left out. The depth is the channel Z, or one whose name ends
 * in .Depth.Z; it is the active scalar. OpenEXR's rows go downwards, VTK's upwards: the image is
 * upright.
 *
 * Depth is +infinity where nothing is seen, as vtkRenderedLayersWriter writes it and
 * vtkDepthSilhouettes expects it; other renderers have a large number there: see BackgroundFrom.
 *
 * If the file cannot be read the output is empty, and one error names it and what is wrong.
 */
#ifndef vtkRenderedLayersReader_h
#define vtkRenderedLayersReader_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkImageAlgorithm.h"

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkRenderedLayersReader : public vtkImageAlgorithm
{
public:
  static vtkRenderedLayersReader* New();
  vtkTypeMacro(vtkRenderedLayersReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the file. No default.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// Depths of at least so much, in the file's units, are background and become +infinity: 1e10
  /// for Blender's. 0 (default): none.
  vtkSetClampMacro(BackgroundFrom, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(BackgroundFrom, double);
  ///@}

protected:
  vtkRenderedLayersReader();
  ~vtkRenderedLayersReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;
  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;

  char* FileName = nullptr;
  double BackgroundFrom = 0;

private:
  vtkRenderedLayersReader(const vtkRenderedLayersReader&) = delete;
  void operator=(const vtkRenderedLayersReader&) = delete;
};

#endif
