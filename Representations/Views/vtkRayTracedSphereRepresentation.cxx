// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereRepresentation.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkRayTracedSphereRepresentation);
