// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBakeResources
 * @brief What the machine of this process has for a bake: processor cores and free memory.
 *
 * vtkSphereAmbientOcclusion::GetBakeEstimate uses the same numbers. An object of its own, so that a
 * client can ask a server without a filter there.
 */
#ifndef vtkBakeResources_h
#define vtkBakeResources_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkObject.h"

class PARTICLEOCCLUSIONFILTERS_EXPORT vtkBakeResources : public vtkObject
{
public:
  static vtkBakeResources* New();
  vtkTypeMacro(vtkBakeResources, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int GetNumberOfCores(); ///< that bakes of this process may use, at least 1
  double GetFreeMemory(); ///< bytes that this process can still take

protected:
  vtkBakeResources() = default;
  ~vtkBakeResources() override = default;

private:
  vtkBakeResources(const vtkBakeResources&) = delete;
  void operator=(const vtkBakeResources&) = delete;
};

#endif
