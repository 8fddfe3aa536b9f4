// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleIds.h"

#include "SphereInput.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace po
{
namespace
{
constexpr std::array<const char*, 6> DefaultIdArrays = { "id", "Id", "ID", "ParticleId",
  "GlobalNodeId", "GlobalPointIds" };

/// The array if it has one number a point, else null.
vtkDataArray* findIds(vtkPointSet& block, const std::string& name)
{
  vtkDataArray* ids = block.GetPointData()->GetArray(name.c_str());
  const bool usable = ids && ids->GetNumberOfComponents() == 1 &&
    ids->GetNumberOfTuples() == block.GetNumberOfPoints();
  return usable ? ids : nullptr;
}

bool haveAll(const std::vector<vtkPointSet*>& blocks, const std::string& name)
{
  return std::all_of(blocks.begin(), blocks.end(),
    [&](vtkPointSet* block) { return block->GetNumberOfPoints() == 0 || findIds(*block, name); });
}

/// Empty if there is none.
std::string chooseArray(
  const std::vector<vtkPointSet*>& blocks, const std::string& array, const ProcessGroup& group)
{
  if (array == RadiusSettings::NoArray)
  {
    return {};
  }
  if (array.empty() || array == RadiusSettings::Automatic)
  {
    const auto found = std::find_if(DefaultIdArrays.begin(), DefaultIdArrays.end(),
      [&](const char* name) { return !group.any(!haveAll(blocks, name)); });
    return found == DefaultIdArrays.end() ? std::string() : *found;
  }
  if (!haveAll(blocks, array))
  {
    throw std::invalid_argument("IdArray: there is no point array '" + array +
      "' of one number a point; choose another array, (automatic) or (none).");
  }
  return array;
}
}

std::vector<std::uint64_t> readIds(
  const std::vector<vtkPointSet*>& blocks, const std::string& array, const ProcessGroup& group)
{
  const std::string name = chooseArray(blocks, array, group);
  std::vector<std::uint64_t> ids;
  for (vtkPointSet* block : blocks)
  {
    vtkDataArray* values = name.empty() ? nullptr : findIds(*block, name);
    for (vtkIdType i = 0; values && i < values->GetNumberOfTuples(); ++i)
    {
      ids.push_back(wordOf(values->GetComponent(i, 0)));
    }
  }
  return ids;
}
}
