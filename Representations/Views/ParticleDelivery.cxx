// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleDelivery.h"

#include "Blocks.h"
#include "MergedParticles.h"

#include "vtkDataObject.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointSet.h"

#include <vector>

namespace po
{
vtkSmartPointer<vtkDataObject> pieceToDeliver(vtkPolyData* particles, int rank, int size)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetNumberOfBlocks(static_cast<unsigned>(size));
  blocks->SetBlock(static_cast<unsigned>(rank), particles);
  return blocks;
}

vtkPolyData* DeliveredParticles::update(vtkDataObject* delivered, std::string& warning)
{
  warning.clear();
  const vtkMTimeType time = delivered ? delivered->GetMTime() : 0;
  if (!particles_ || delivered != source_ || time != sourceTime_)
  {
    std::vector<vtkPointSet*> blocks;
    for (vtkDataSet* block : blocksWithPoints(delivered))
    {
      blocks.push_back(vtkPointSet::SafeDownCast(block));
    }
    particles_ = mergeParticles(blocks, warning);
    source_ = delivered;
    sourceTime_ = time;
  }
  return particles_;
}
}
