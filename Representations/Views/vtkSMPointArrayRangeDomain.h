// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSMPointArrayRangeDomain_h
#define vtkSMPointArrayRangeDomain_h

#include "ParticleOcclusionRepresentationsModule.h" // for the export macro
#include "vtkSMArrayRangeDomain.h"

/**
 * The range of the point array that another property chooses, as a slider shows it.
 *
 * Unlike its superclass this one also takes a property that holds nothing but the array's name, and
 * -1, the component of a magnitude, for what it says. Required properties: Input, ArraySelection
 * (the name is the last element) and ComponentSelection.
 */
class PARTICLEOCCLUSIONREPRESENTATIONS_EXPORT vtkSMPointArrayRangeDomain
  : public vtkSMArrayRangeDomain
{
public:
  static vtkSMPointArrayRangeDomain* New();
  vtkTypeMacro(vtkSMPointArrayRangeDomain, vtkSMArrayRangeDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkSMArrayRangeDomain::Update;
  void Update(vtkSMProperty* requestingProperty) override;

protected:
  vtkSMPointArrayRangeDomain();
  ~vtkSMPointArrayRangeDomain() override;

private:
  vtkSMPointArrayRangeDomain(const vtkSMPointArrayRangeDomain&) = delete;
  void operator=(const vtkSMPointArrayRangeDomain&) = delete;
};

#endif
