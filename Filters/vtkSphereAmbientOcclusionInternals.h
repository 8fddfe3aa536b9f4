// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSphereAmbientOcclusionInternals_h
#define vtkSphereAmbientOcclusionInternals_h

#include "BakeReuse.h"
#include "vtkSphereAmbientOcclusion.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkPointSet;

namespace po
{
struct BakeInput;
}

/// The last execution.
struct vtkSphereAmbientOcclusion::Internals
{
  po::BakeReport Report;
  double Seconds = 0;
  std::string RadiusUsed;
  std::string Estimate;
  po::BakeReuse Reuse; ///< what is left of it for the next one

  /// Forgets what is reported of it.
  void Reset();

  /// Throws what its steps throw, and po::WorkStopped when this or another process was aborted.
  void Bake(vtkSphereAmbientOcclusion* self, const po::ProcessGroup& group,
    const std::vector<vtkPointSet*>& blocks, vtkDataObject* occluderData);

  void CountParticles(const po::BakeInput& input, const po::BakeResult& result,
    const po::BakeSettings& settings, const po::ProcessGroup& group);
};

#endif
