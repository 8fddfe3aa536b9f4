// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as an OpenEXR file of occlusion textures.
#include "FuzzSupport.h"
#include "VTKErrors.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkOcclusionTextureReader.h"
#include "vtkOcclusionTextureWriter.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include "OcclusionTextureFile.h"

#include <stdexcept>

namespace
{
/// Particles as many as the file says; -1 if it cannot be opened.
std::int64_t particlesOf(const std::string& fileName)
{
  try
  {
    return po::OcclusionTextureFile(fileName).particleCount();
  }
  catch (const std::runtime_error& error)
  {
    FUZZ_REQUIRE(std::string(error.what()).find(fileName) != std::string::npos);
    return -1;
  }
}

/// Reads onto particles, or without them; either one error and nothing, or all there should be.
void read(const std::string& fileName, vtkPolyData* particles)
{
  vtkNew<vtkOcclusionTextureReader> reader;
  ErrorCatcher errors(reader);
  reader->SetFileName(fileName.c_str());
  reader->SetInputData(particles);
  reader->Update();
  vtkFieldData* fields = reader->GetOutput()->GetFieldData();
  FUZZ_REQUIRE(errors.count() == (reader->GetErrorCode() ? 1 : 0));
  const bool whole =
    fields->HasArray("AmbientOcclusionTextures") && fields->HasArray("AmbientOcclusionParameters");
  FUZZ_REQUIRE(whole == (errors.count() == 0));
  FUZZ_REQUIRE(whole || fields->GetNumberOfArrays() == 0);
  reader->ReadTexture(0);
}
}

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  prepareFuzzing();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const MemoryFile file(bytes, size);
  const std::int64_t count = particlesOf(file.name());
  read(file.name(), nullptr);
  constexpr std::int64_t Most = 1 << 20; // more points than this would only take time
  if (count >= 0 && count < Most)
  {
    vtkNew<vtkPoints> points;
    points->SetNumberOfPoints(count);
    vtkNew<vtkPolyData> particles;
    particles->SetPoints(points);
    read(file.name(), particles);
  }
  return 0;
}
