// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRenderedLayersWriter
 * @brief Writes the layers of a rendered image to one OpenEXR file for compositing.
 *
 * The input is a 2-D vtkImageData. Its point arrays become channels, by name:
 *
 * | array | input | channels | in the file |
 * | --- | --- | --- | --- |
 * | RGBA | uint8, 4 components, sRGB, not premultiplied | R G B A | HALF, linear light,
 * premultiplied | | Z | float or double | Z | FLOAT, world units, +infinity for background | | AO |
 * float or double | AO | FLOAT | | N | float or double, 3 components | N.X N.Y N.Z | FLOAT | | id |
 * integers | id | UINT, background -1 as 4294967295 | | any other | float or double, 1 to 4
 * components | name, or name.X name.Y ... | FLOAT |
 *
 * HALF holds each of the 256 sRGB levels of an opaque pixel apart. Arrays that are missing are not
 * written; other arrays of integers are left out with a warning; none that can be written is an
 * error. VTK's rows go upwards, OpenEXR's downwards: viewers show the image upright.
 *
 * The file appears under its name only when it is complete. On failure GetErrorCode() is set,
 * Write() returns 0, one error says what is wrong, and a file of that name that existed before is
 * unchanged.
 */
#ifndef vtkRenderedLayersWriter_h
#define vtkRenderedLayersWriter_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkWriter.h"

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkRenderedLayersWriter : public vtkWriter
{
public:
  static vtkRenderedLayersWriter* New();
  vtkTypeMacro(vtkRenderedLayersWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the file to write, usually with the extension .exr. No default.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// Writes the input. Returns 1 on success and 0 on failure.
  int Write() override;

protected:
  vtkRenderedLayersWriter() = default;
  ~vtkRenderedLayersWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  char* FileName = nullptr;

private:
  vtkRenderedLayersWriter(const vtkRenderedLayersWriter&) = delete;
  void operator=(const vtkRenderedLayersWriter&) = delete;
};

#endif
