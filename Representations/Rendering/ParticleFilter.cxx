// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleFilter.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlaneCollection.h"

namespace po
{
std::vector<HalfSpace> clippingPlanesOf(vtkMapper& mapper, vtkActor& actor)
{
  vtkNew<vtkMatrix4x4> matrix;
  actor.GetModelToWorldMatrix(matrix);
  const int count = mapper.GetClippingPlanes() ? mapper.GetClippingPlanes()->GetNumberOfItems() : 0;
  std::vector<HalfSpace> halfSpaces;
  for (int i = 0; i < count; ++i)
  {
    double plane[4];
    mapper.GetClippingPlaneInDataCoords(matrix, i, plane);
    halfSpaces.push_back({ { plane[0], plane[1], plane[2] }, plane[3] });
  }
  return halfSpaces;
}
}
