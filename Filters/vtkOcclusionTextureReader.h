// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOcclusionTextureReader
 * @brief Reads ambient occlusion textures from an OpenEXR file onto particles.
 *
 * With an input, the output is a shallow copy of it plus point data AmbientOcclusion (float32[N])
 * and AmbientOcclusionTexture (int32[N]) and field data AmbientOcclusionTextures (one tuple a
 * texture, T*T components) and AmbientOcclusionParameters, as vtkOcclusionTextureWriter wrote them.
 * A table that was encoded as UInt8Gamma2 gets its bytes back exactly; a table of floats is read as
 * it is. The particles must be as many, and in the same order, as when the file was written.
 * Without an input, the output has the field data only.
 *
 * Particles that are as many but not the same, by the hash in the file of their positions and
 * radii, get the textures all the same, and one warning: their shadows may be wrong.
 *
 * A file that is missing, foreign, damaged or of another number of particles gives one error and an
 * empty output.
 */
#ifndef vtkOcclusionTextureReader_h
#define vtkOcclusionTextureReader_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"

class vtkFloatArray;

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkOcclusionTextureReader : public vtkPolyDataAlgorithm
{
public:
  static vtkOcclusionTextureReader* New();
  vtkTypeMacro(vtkOcclusionTextureReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the file to read. No default.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// The T*T linear values of one row of the table as one tuple, read without the other textures;
  /// nullptr, after an error, if the file has no such row or cannot be read.
  vtkSmartPointer<vtkFloatArray> ReadTexture(vtkIdType row);

protected:
  vtkOcclusionTextureReader() = default;
  ~vtkOcclusionTextureReader() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  char* FileName = nullptr;

private:
  vtkOcclusionTextureReader(const vtkOcclusionTextureReader&) = delete;
  void operator=(const vtkOcclusionTextureReader&) = delete;
};

#endif
