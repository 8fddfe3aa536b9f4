// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphereAmbientOcclusion.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSphereAmbientOcclusion);
