// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRayTracedSphereMapper.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkRayTracedSphereMapper);
