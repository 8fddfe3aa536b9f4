// SPDX-License-Identifier: BSD-3-Clause
#include "TableViews.h"

#include "OcclusionParameters.h"

#include "vtkAbstractArray.h"
#include "vtkFloatArray.h"
#include "vtkUnsignedCharArray.h"

#include <mutex>
#include <unordered_map>
#include <utility>

namespace po
{
namespace
{
/// What keeps the memory of arrays: VTK tells an address alone when the last array that shares it
/// is gone.
class TableOwners
{
public:
  /// Never destroyed: arrays may be gone later than what is static.
  static TableOwners& get()
  {
    static TableOwners& owners = *new TableOwners;
    return owners;
  }

  /// One more array begins at an address inside of the table.
  void add(void* address, std::shared_ptr<void> table)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Entry& entry = entries_[address];
    entry.table = std::move(table);
    ++entry.arrays;
  }

  void remove(void* address)
  {
    std::shared_ptr<void> last; // is given back after the lock
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto entry = entries_.find(address);
    if (--entry->second.arrays == 0)
    {
      last = std::move(entry->second.table);
      entries_.erase(entry);
    }
  }

  /// Null if no view begins there.
  [[nodiscard]] std::shared_ptr<void> tableAt(void* address)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto entry = entries_.find(address);
    return entry == entries_.end() ? nullptr : entry->second.table;
  }

private:
  struct Entry
  {
    std::shared_ptr<void> table;
    std::size_t arrays = 0;
  };

  std::mutex mutex_;
  std::unordered_map<void*, Entry> entries_;
};

template <typename Array>
vtkSmartPointer<vtkDataArray> makeView(
  const std::shared_ptr<void>& table, void* begin, vtkIdType values, int components)
{
  auto view = vtkSmartPointer<Array>::New();
  view->SetName(TextureTableArray);
  view->SetNumberOfComponents(components);
  if (values == 0)
  {
    return view; // its address could be that of other memory
  }
  TableOwners::get().add(begin, table);
  view->SetArray(static_cast<typename Array::ValueType*>(begin), values, 0,
    vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  view->SetArrayFreeFunction([](void* memory) { TableOwners::get().remove(memory); });
  return view;
}

template <typename Array, typename Value>
vtkSmartPointer<vtkDataArray> viewOf(const std::shared_ptr<std::vector<Value>>& table,
  std::size_t first, std::size_t count, int components)
{
  const auto width = static_cast<std::size_t>(components);
  return makeView<Array>(
    table, table->data() + first * width, static_cast<vtkIdType>(count * width), components);
}

char* endOf(vtkDataArray* array)
{
  return static_cast<char*>(array->GetVoidPointer(0)) +
    array->GetNumberOfValues() * array->GetDataTypeSize();
}

/// Does a view begin where the other one ends?
bool follows(vtkDataArray* view, vtkDataArray* before, const std::shared_ptr<void>& table)
{
  return view->GetDataType() == before->GetDataType() &&
    view->GetNumberOfComponents() == before->GetNumberOfComponents() &&
    view->GetVoidPointer(0) == endOf(before) &&
    TableOwners::get().tableAt(view->GetVoidPointer(0)) == table;
}
}

vtkSmartPointer<vtkDataArray> viewTable(std::shared_ptr<std::vector<std::uint8_t>> table,
  std::size_t first, std::size_t count, int components)
{
  return viewOf<vtkUnsignedCharArray>(table, first, count, components);
}

vtkSmartPointer<vtkDataArray> viewTable(
  std::shared_ptr<std::vector<float>> table, std::size_t first, std::size_t count, int components)
{
  return viewOf<vtkFloatArray>(table, first, count, components);
}

vtkSmartPointer<vtkDataArray> joinViews(const std::vector<vtkDataArray*>& views)
{
  std::shared_ptr<void> table;
  vtkDataArray* first = nullptr;
  vtkDataArray* last = nullptr;
  vtkIdType values = 0;
  for (vtkDataArray* view : views)
  {
    if (view->GetNumberOfValues() == 0)
    {
      continue;
    }
    table = first ? table : TableOwners::get().tableAt(view->GetVoidPointer(0));
    if (!table || (last && !follows(view, last, table)))
    {
      return nullptr;
    }
    first = first ? first : view;
    last = view;
    values += view->GetNumberOfValues();
  }
  if (!first)
  {
    return nullptr;
  }
  const int components = first->GetNumberOfComponents();
  void* begin = first->GetVoidPointer(0);
  return first->GetDataType() == VTK_FLOAT
    ? makeView<vtkFloatArray>(table, begin, values, components)
    : makeView<vtkUnsignedCharArray>(table, begin, values, components);
}
}
