// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParticleDelivery_h
#define po_ParticleDelivery_h

// The way of particles from the processes that have them to those that draw them. ParaView appends
// what several processes send to one, and that loses the texture tables, which are field data: so
// each process sends a block of its own, and the blocks are merged, tables and all, where they
// arrive.

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkDataObject;

namespace po
{
/// What process `rank` of `size` hands over. A client, which has no particles, must hand over data
/// of the same type to get any, so this is a composite data set for a process alone too.
[[nodiscard]] vtkSmartPointer<vtkDataObject> pieceToDeliver(
  vtkPolyData* particles, int rank, int size);

/// The other end: particles of one delivery, kept until another one comes.
class DeliveredParticles
{
public:
  /// @param delivered what arrived, or null
  /// @param warning why textures were lost, empty if they were not
  [[nodiscard]] vtkPolyData* update(vtkDataObject* delivered, std::string& warning);

private:
  vtkWeakPointer<vtkDataObject> source_;
  vtkMTimeType sourceTime_ = 0;
  vtkSmartPointer<vtkPolyData> particles_;
};
}

#endif
