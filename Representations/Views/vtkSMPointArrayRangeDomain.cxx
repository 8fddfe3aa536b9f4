// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMPointArrayRangeDomain.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMPointArrayRangeDomain);

namespace
{
/// As the superclass counts: the component after the last one is the magnitude.
int componentOf(vtkPVArrayInformation* array, int chosen)
{
  const int components = array->GetNumberOfComponents();
  return chosen < 0 && components > 1 ? components : chosen;
}
}

vtkSMPointArrayRangeDomain::vtkSMPointArrayRangeDomain() = default;
vtkSMPointArrayRangeDomain::~vtkSMPointArrayRangeDomain() = default;

void vtkSMPointArrayRangeDomain::Update(vtkSMProperty*)
{
  vtkSMProperty* input = this->GetRequiredProperty("Input");
  vtkSMProperty* selection = this->GetRequiredProperty("ArraySelection");
  vtkSMProperty* component = this->GetRequiredProperty("ComponentSelection");
  if (!input || !selection || !component)
  {
    return;
  }
  vtkSMUncheckedPropertyHelper source(input), name(selection);
  auto* producer = vtkSMSourceProxy::SafeDownCast(source.GetAsProxy());
  if (!producer || name.GetNumberOfElements() == 0)
  {
    return;
  }
  producer->CreateOutputPorts();
  const std::string array = name.GetAsString(name.GetNumberOfElements() - 1);
  vtkPVArrayInformation* found = producer->GetDataInformation(source.GetOutputPort())
                                   ->GetArrayInformation(array.c_str(), vtkDataObject::POINT);
  if (found)
  {
    this->Update(array.c_str(), vtkDataObject::POINT, producer,
      static_cast<int>(source.GetOutputPort()),
      componentOf(found, vtkSMUncheckedPropertyHelper(component).GetAsInt()));
  }
  else
  {
    this->SetEntries(std::vector<vtkEntry>());
  }
}

void vtkSMPointArrayRangeDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
