// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkParticleTextReader
 * @brief Reads particles from LAMMPS text dumps and XYZ files, plain or gzipped (.gz).
 *
 * The first line tells which of the two a file is. The output has a point and a vertex a particle,
 * and every column as a point array of its name; columns whose names differ in a last x, y and z
 * alone are one vector (`vx vy vz` is `v`), words are strings. Where there is an array `element` of
 * symbols, `atomic_number` goes with it, 0 for what is no element. Lengths are those of the file.
 *
 * Dumps: styles atom and custom. Coordinates are x y z, else xu yu zu, xs ys zs or xsu ysu zsu;
 * scaled ones are multiplied by the box, which may be triclinic. Particles come in the order of
 * their ids. XYZ: element x y z, further columns as column5, column6, ...; or as Properties=... of
 * an extended comment says.
 *
 * All frames of all files are one time series: the time of a dump is its time step, of several
 * frames of the same step the last one counts; frames of XYZ are counted from 0 through all files.
 * A frame that a file breaks off in is left out with a warning that says so. If there is nothing to
 * read, or the frame is wrong, the output is empty, and one error names the file and what is wrong.
 *
 * Each particle is read on one process only. Files are gone through once to find their frames; a
 * step back in a gzipped file costs reading it from the start.
 */
#ifndef vtkParticleTextReader_h
#define vtkParticleTextReader_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkParticleTextReader : public vtkPolyDataAlgorithm
{
public:
  static vtkParticleTextReader* New();
  vtkTypeMacro(vtkParticleTextReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The files of the series [none].
  void AddFileName(const char* name);
  void RemoveAllFileNames();
  int GetNumberOfFileNames();
  const char* GetFileName(int i);
  ///@}

  /// 1 if the first line of a file is that of a dump or of XYZ, else 0.
  static int CanReadFile(const char* name);

protected:
  vtkParticleTextReader();
  ~vtkParticleTextReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;
  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;

private:
  vtkParticleTextReader(const vtkParticleTextReader&) = delete;
  void operator=(const vtkParticleTextReader&) = delete;

  void Fail(const std::string& file, const char* what);
  void FindFrames();

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
