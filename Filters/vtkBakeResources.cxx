// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBakeResources.h"

#include "FreeMemory.h"

#include "vtkObjectFactory.h"

#include <tbb/task_arena.h>

vtkStandardNewMacro(vtkBakeResources);

void vtkBakeResources::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfCores: " << this->GetNumberOfCores() << "\n";
  os << indent << "FreeMemory: " << this->GetFreeMemory() << "\n";
}

int vtkBakeResources::GetNumberOfCores()
{
  return tbb::this_task_arena::max_concurrency();
}

double vtkBakeResources::GetFreeMemory()
{
  return po::freeMemory();
}
