// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TableViews_h
#define po_TableViews_h

// Texture tables that lie in one piece of memory, which the last of them gives back.

#include "ParticleOcclusionFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkDataArray;

namespace po
{
/// An array of the tuples [first, first + count) of a table, by the name of TextureTableArray. It
/// keeps the whole table alive, and so does every array that is a shallow copy of it.
/// @param components values of a tuple
[[nodiscard]] vtkSmartPointer<vtkDataArray> viewTable(
  std::shared_ptr<std::vector<std::uint8_t>> table, std::size_t first, std::size_t count,
  int components);
[[nodiscard]] vtkSmartPointer<vtkDataArray> viewTable(
  std::shared_ptr<std::vector<float>> table, std::size_t first, std::size_t count, int components);

/// One view of what these are views of, without a copy; null if they do not follow each other in
/// one table. Those without tuples are of no account, but one must have some.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT vtkSmartPointer<vtkDataArray> joinViews(
  const std::vector<vtkDataArray*>& views);
}

#endif
