// SPDX-License-Identifier: BSD-3-Clause
#include "ControllerGroup.h"

#include "vtkMultiProcessController.h"

#include <cstring>
#include <exception>
#include <new>
#include <numeric>

namespace po
{
namespace
{
void requireSuccess(int success)
{
  if (success == 0)
  {
    throw WorkStopped(WorkState::Failed, "The processes cannot exchange data.");
  }
}

/// The length in bytes, then the bytes.
ProcessGroup::Words wordsOf(const std::string& text)
{
  ProcessGroup::Words words(1 + (text.size() + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
  words[0] = text.size();
  if (!text.empty())
  {
    std::memcpy(words.data() + 1, text.data(), text.size());
  }
  return words;
}

/// The first message, by rank, that is not empty: the same on all processes, which all must call.
std::string firstMessage(const ProcessGroup& group, const std::string& own)
{
  const ProcessGroup::Words words = group.gather(wordsOf(own));
  int process = 0;
  for (std::size_t at = 0; at < words.size(); ++process)
  {
    const std::size_t bytes = words[at];
    if (bytes > 0)
    {
      const std::string text(reinterpret_cast<const char*>(words.data() + at + 1), bytes);
      return group.size() > 1 ? "Process " + std::to_string(process) + ": " + text : text;
    }
    ++at;
  }
  return {};
}

/// Tells the others that this process does not go on, and why.
std::string stop(const ProcessGroup& group, const std::string& why)
{
  group.stop(WorkState::Failed);
  return firstMessage(group, why);
}
}

ControllerGroup::ControllerGroup(vtkMultiProcessController* controller)
  : controller_(controller)
  , size_(controller ? controller->GetNumberOfProcesses() : 1)
  , rank_(controller ? controller->GetLocalProcessId() : 0)
{
}

std::vector<std::int64_t> ControllerGroup::exchange(std::int64_t own) const
{
  std::vector<std::int64_t> all(static_cast<std::size_t>(size_), own);
  if (size_ > 1)
  {
    requireSuccess(controller_->AllGather(&own, all.data(), 1));
  }
  return all;
}

void ControllerGroup::transfer(
  int destination, const Words& own, const std::vector<std::int64_t>& lengths, Words& all) const
{
  std::vector<vtkIdType> received(lengths.begin(), lengths.end());
  std::vector<vtkIdType> offsets(lengths.size(), 0);
  std::partial_sum(received.begin(), received.end() - 1, offsets.begin() + 1);
  const auto length = static_cast<vtkIdType>(own.size());
  requireSuccess(destination < 0
      ? controller_->AllGatherV(own.data(), all.data(), length, received.data(), offsets.data())
      : controller_->GatherV(
          own.data(), all.data(), length, received.data(), offsets.data(), destination));
}

bool runTogether(const ProcessGroup& group, const std::function<void()>& work, std::string& error)
{
  error.clear();
  try
  {
    work();
    return true;
  }
  catch (const WorkStopped& stopped)
  {
    error = stopped.state() == WorkState::Failed ? firstMessage(group, stopped.what()) : "";
    return stopped.state() == WorkState::Aborted;
  }
  catch (const std::bad_alloc&)
  {
    error = stop(group, "Memory ran out: lower TextureResolution or bake fewer particles.");
  }
  catch (const std::exception& exception)
  {
    error = stop(group, exception.what());
  }
  return false;
}
}
