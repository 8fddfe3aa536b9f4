// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSphereAmbientOcclusionInternals_h
#define vtkSphereAmbientOcclusionInternals_h

#include "BakeMethods.h"
#include "vtkSphereAmbientOcclusion.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkPointSet;

/// One execution.
struct vtkSphereAmbientOcclusion::Internals
{
  po::BakeReport Report;
  double Seconds = 0;
  std::string RadiusUsed;
  std::string Estimate;

  /// What was read of this process' data.
  struct Particles
  {
    po::SphereCloud Cloud;
    std::vector<unsigned> Places; ///< of each sphere in the cloud of the task
  };

  /// Throws what its steps throw, and po::WorkStopped when this or another process was aborted.
  void Bake(vtkSphereAmbientOcclusion* self, const po::ProcessGroup& group,
    const std::vector<vtkPointSet*>& blocks, vtkDataObject* occluderData);

  Particles ReadParticles(vtkSphereAmbientOcclusion* self, const po::ProcessGroup& group,
    const std::vector<vtkPointSet*>& blocks);
  static po::Occluders ReadOccluders(vtkSphereAmbientOcclusion* self, const po::ProcessGroup& group,
    vtkDataObject* data, const po::SphereCloud& cloud);

  /// Exchanges particles and occluders with the other processes.
  po::BakeTask MakeTask(vtkSphereAmbientOcclusion* self, const po::ProcessGroup& group,
    Particles& particles, po::Occluders occluders, const po::BakeSettings& settings);

  void CountParticles(const Particles& particles, const po::BakeResult& result,
    const po::BakeSettings& settings, const po::ProcessGroup& group);
};

#endif
