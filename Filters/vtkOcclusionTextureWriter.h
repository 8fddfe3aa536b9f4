// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOcclusionTextureWriter
 * @brief Writes the ambient occlusion textures of particles to an OpenEXR file.
 *
 * The input is vtkPolyData as vtkSphereAmbientOcclusion makes it: point data AmbientOcclusion
 * (float32[N]) and AmbientOcclusionTexture (int32[N]), field data AmbientOcclusionTextures (one
 * tuple a texture, T*T components, uint8 or float32) and AmbientOcclusionParameters (strings
 * "key=value").
 *
 * The file holds linear values, one compressed tile a texture, so that any viewer shows them and a
 * single texture can be read alone; the mean and the texture of every particle; and a hash of the
 * particles, so that the reader notices if they are others. Points are not written: keep them in a
 * .vtp file. vtkOcclusionTextureReader puts the textures back: bit by bit, but for a table of
 * floats with Precision Half. One texture at a time is held in memory.
 *
 * The file appears under its name only when it is complete. On failure GetErrorCode() is set,
 * Write() returns 0, one error says what is wrong, and a file of that name that existed before is
 * unchanged.
 */
#ifndef vtkOcclusionTextureWriter_h
#define vtkOcclusionTextureWriter_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkWriter.h"

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkOcclusionTextureWriter : public vtkWriter
{
public:
  static vtkOcclusionTextureWriter* New();
  vtkTypeMacro(vtkOcclusionTextureWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the file to write, usually with the extension .exr. No default.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// What a texel takes in the file.
  enum PrecisionType
  {
    Float = 0, ///< 32 bits a texel
    Half = 1   ///< 16 bits: half the size; values are rounded by up to 1/2048 of themselves
  };

  ///@{
  /// How texels are stored [Float]. Half is for values up to 65,504. A table of bytes comes back
  /// from it as it was; one whose maximum is below 1/128 would not, and is an error.
  vtkSetClampMacro(Precision, int, Float, Half);
  vtkGetMacro(Precision, int);
  ///@}

  /// Writes the input. Returns 1 on success and 0 on failure.
  int Write() override;

protected:
  vtkOcclusionTextureWriter() = default;
  ~vtkOcclusionTextureWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  char* FileName = nullptr;
  int Precision = Float;

private:
  vtkOcclusionTextureWriter(const vtkOcclusionTextureWriter&) = delete;
  void operator=(const vtkOcclusionTextureWriter&) = delete;
};

#endif
