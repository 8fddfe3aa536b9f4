// SPDX-License-Identifier: BSD-3-Clause
#include "BlockLooks.h"

#include "BlockTable.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataAssembly.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <iterator>

namespace po
{
namespace
{
constexpr const char* ArrayName = "ParticleOcclusionHierarchy";

using Ids = std::vector<unsigned>;

/// Flat indices of the nodes that are selected and of those below them, in order.
Ids nodesOf(vtkDataAssembly& hierarchy, const std::vector<std::string>& selectors)
{
  Ids ids;
  for (const int node : hierarchy.SelectNodes(selectors))
  {
    const std::vector<unsigned> found = hierarchy.GetDataSetIndices(node);
    ids.insert(ids.end(), found.begin(), found.end());
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// A block belongs to the node that it is, or, a partition, to the node before it.
bool contains(const Ids& selected, const Ids& all, unsigned flatIndex)
{
  const auto next = std::upper_bound(all.begin(), all.end(), flatIndex);
  return next != all.begin() &&
    std::binary_search(selected.begin(), selected.end(), *std::prev(next));
}
}

void keepHierarchy(vtkCompositeDataSet& blocks, vtkPolyData& points)
{
  vtkNew<vtkDataAssembly> hierarchy;
  if (vtkDataAssemblyUtilities::GenerateHierarchy(&blocks, hierarchy))
  {
    vtkNew<vtkStringArray> xml;
    xml->SetName(ArrayName);
    xml->InsertNextValue(hierarchy->SerializeToXML(vtkIndent()));
    points.GetFieldData()->AddArray(xml);
  }
}

bool BlockLooks::anyTranslucent() const
{
  return std::any_of(
    opacities.begin(), opacities.end(), [](const auto& look) { return look.second < 1; });
}

void BlockLooks::apply(vtkPolyData& points, vtkRayTracedSphereMapper& mapper) const
{
  mapper.RemoveAllBlockStyles();
  auto* xml = vtkStringArray::SafeDownCast(points.GetFieldData()->GetAbstractArray(ArrayName));
  vtkNew<vtkDataAssembly> hierarchy;
  if (!xml || !hierarchy->InitializeFromXML(xml->GetValue(0).c_str()))
  {
    return;
  }
  const Ids all = nodesOf(*hierarchy, { "/" });
  const auto forEachIn = [&](const std::vector<std::string>& selectors, bool inside, const auto& f)
  {
    const Ids selected = nodesOf(*hierarchy, selectors);
    for (const PointBlock& block : blockTableOf(points))
    {
      if (contains(selected, all, block.flatIndex) == inside)
      {
        f(block.flatIndex);
      }
    }
  };
  forEachIn(visible, false, [&](unsigned id) { mapper.SetBlockVisibility(id, false); });
  for (const auto& [selector, c] : colors)
  {
    forEachIn(
      { selector }, true, [&, &c = c](unsigned id) { mapper.SetBlockColor(id, c[0], c[1], c[2]); });
  }
  for (const auto& [selector, opacity] : opacities)
  {
    forEachIn({ selector }, true,
      [&, &opacity = opacity](unsigned id) { mapper.SetBlockOpacity(id, opacity); });
  }
}

void AppliedBlockLooks::update(vtkRayTracedSphereMapper& mapper)
{
  vtkPolyData* points = mapper.GetInput();
  const std::pair<vtkPolyData*, vtkMTimeType> source{ points, points ? points->GetMTime() : 0 };
  if (points && (looks_.isNew() || source != points_))
  {
    looks_.use().apply(*points, mapper);
    points_ = source;
  }
}
}
