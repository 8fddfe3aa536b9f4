// SPDX-License-Identifier: BSD-3-Clause
#include "OccluderInput.h"

#include "BakedData.h"
#include "Blocks.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"

#include <algorithm>
#include <stdexcept>

namespace po
{
namespace
{
constexpr const char* PortName = "Occluders: ";

[[noreturn]] void refuseType(vtkDataObject& data)
{
  throw std::invalid_argument(PortName +
    std::string("the input must be a vtkPolyData, or a composite data set of them, but has a ") +
    data.GetClassName() + ": extract its surface before.");
}

std::vector<vtkPolyData*> occluderBlocks(vtkDataObject* data)
{
  if (data && !vtkPolyData::SafeDownCast(data) && !vtkCompositeDataSet::SafeDownCast(data))
  {
    refuseType(*data);
  }
  std::vector<vtkPolyData*> blocks;
  for (vtkDataSet* block : blocksWithPoints(data))
  {
    auto* surface = vtkPolyData::SafeDownCast(block);
    if (!surface)
    {
      refuseType(*block);
    }
    blocks.push_back(surface);
  }
  return blocks;
}

bool isMesh(vtkPolyData& block)
{
  return block.GetNumberOfPolys() > 0 || block.GetNumberOfStrips() > 0;
}

template <typename Visit>
void forEachCell(vtkCellArray& cells, const Visit& visit)
{
  const auto cell = vtk::TakeSmartPointer(cells.NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cell->GetCurrentCell(count, ids);
    visit(count, ids);
  }
}

/// Adds the polygons and strips of blocks to a mesh.
class MeshReader
{
public:
  MeshReader(const SphereCloud& particles, OccluderMesh& mesh)
    : particles_(particles)
    , mesh_(mesh)
  {
  }

  void add(vtkPolyData& block)
  {
    addVertices(block);
    forEachCell(*block.GetPolys(),
      [&](vtkIdType count, const vtkIdType* ids) { addPolygon(block, count, ids); });
    forEachCell(
      *block.GetStrips(), [&](vtkIdType count, const vtkIdType* ids) { addStrip(count, ids); });
  }

  /// Triangles that were left out.
  [[nodiscard]] std::size_t skipped() const { return skipped_; }

private:
  void addVertices(vtkPolyData& block)
  {
    first_ = mesh_.vertices.size();
    const vtkIdType count = block.GetNumberOfPoints();
    usable_.assign(static_cast<std::size_t>(count), false);
    for (vtkIdType i = 0; i < count; ++i)
    {
      Vec3d world;
      block.GetPoint(i, &world.x);
      const Vec3d local = particles_.toLocal(world);
      const bool usable = SphereCloud::inRange(local);
      usable_[static_cast<std::size_t>(i)] = usable;
      mesh_.vertices.push_back(usable ? local.as<float>() : Vec3f{});
    }
  }

  [[nodiscard]] bool isUsable(vtkIdType id) const { return usable_[static_cast<std::size_t>(id)]; }

  void addTriangle(vtkIdType a, vtkIdType b, vtkIdType c)
  {
    if (!isUsable(a) || !isUsable(b) || !isUsable(c))
    {
      ++skipped_;
      return;
    }
    const auto vertex = [this](vtkIdType id)
    { return static_cast<unsigned>(first_ + static_cast<std::size_t>(id)); };
    mesh_.triangles.push_back({ vertex(a), vertex(b), vertex(c) });
  }

  /// Every second triangle is turned over, which does not matter: both sides occlude.
  void addStrip(vtkIdType count, const vtkIdType* ids)
  {
    for (vtkIdType i = 0; i + 2 < count; ++i)
    {
      addTriangle(ids[i], ids[i + 1], ids[i + 2]);
    }
  }

  void addPolygon(vtkPolyData& block, vtkIdType count, const vtkIdType* ids)
  {
    if (count == 3)
    {
      addTriangle(ids[0], ids[1], ids[2]);
    }
    else if (count > 3)
    {
      triangulate(block, count, ids);
    }
  }

  void triangulate(vtkPolyData& block, vtkIdType count, const vtkIdType* ids)
  {
    const bool usable =
      std::all_of(ids, ids + count, [this](vtkIdType id) { return isUsable(id); });
    if (usable)
    {
      polygon_->Initialize(static_cast<int>(count), ids, block.GetPoints());
      polygon_->Triangulate(0, corners_, cornerPoints_);
    }
    if (!usable || corners_->GetNumberOfIds() == 0)
    {
      skipped_ += static_cast<std::size_t>(count - 2);
      return;
    }
    for (vtkIdType i = 0; i + 2 < corners_->GetNumberOfIds(); i += 3)
    {
      addTriangle(corners_->GetId(i), corners_->GetId(i + 1), corners_->GetId(i + 2));
    }
  }

  const SphereCloud& particles_;
  OccluderMesh& mesh_;
  std::size_t first_ = 0;    ///< vertex of the block's first point
  std::vector<bool> usable_; ///< of the block's points
  std::size_t skipped_ = 0;
  vtkNew<vtkPolygon> polygon_;
  vtkNew<vtkIdList> corners_;
  vtkNew<vtkPoints> cornerPoints_;
};

void readSpheres(const std::vector<vtkPointSet*>& blocks, const RadiusSettings& radii,
  const SphereCloud& particles, const ProcessGroup& group, OccluderInput& input)
{
  std::string error;
  std::optional<ParticleInput> spheres = readBlocks(blocks, radii, error, { &particles }, group);
  if (!spheres)
  {
    throw std::invalid_argument(PortName + error);
  }
  const RejectedParticles rejected = spheres->cloud.rejected.summed(group);
  if (rejected.total() > 0)
  {
    input.warnings.push_back(PortName + describe(rejected));
  }
  input.occluders.spheres = std::move(spheres->cloud.spheres);
  input.occluders.centers = std::move(spheres->cloud.centers);
}
}

OccluderInput readOccluders(vtkDataObject* data, const RadiusSettings& radii,
  const SphereCloud& particles, const ProcessGroup& group)
{
  OccluderInput input;
  MeshReader meshes(particles, input.occluders.mesh);
  std::vector<vtkPointSet*> sphereBlocks;
  std::uint64_t linesAlone = 0;
  for (vtkPolyData* block : occluderBlocks(data))
  {
    if (isMesh(*block))
    {
      meshes.add(*block);
    }
    else if (block->GetNumberOfLines() > 0 && block->GetNumberOfVerts() == 0)
    {
      ++linesAlone;
    }
    else
    {
      sphereBlocks.push_back(block);
    }
  }
  const std::uint64_t skipped = group.sum(std::uint64_t(meshes.skipped()));
  if (skipped > 0)
  {
    input.warnings.push_back(PortName + std::to_string(skipped) +
      " triangles are left out: with a corner that is NaN, infinite or out of proportion to the "
      "mean radius, or of a polygon that cannot be cut into triangles.");
  }
  linesAlone = group.sum(linesAlone);
  if (linesAlone > 0)
  {
    input.warnings.push_back(PortName + std::to_string(linesAlone) +
      " data sets of lines are left out: make tubes of them before.");
  }
  if (group.any(!sphereBlocks.empty()))
  {
    readSpheres(sphereBlocks, radii, particles, group, input);
  }
  return input;
}
}
