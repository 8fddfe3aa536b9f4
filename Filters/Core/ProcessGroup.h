// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ProcessGroup_h
#define po_ProcessGroup_h

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace po
{
/// How the work that processes share goes on for one of them.
enum class WorkState
{
  Running = 0,
  Aborted = -1, ///< by its user
  Failed = -2   ///< by an error
};

/// Shared work has come to an end, and all processes of the group know it: nothing must be told any
/// more.
class WorkStopped : public std::runtime_error
{
public:
  /// @param what empty if another process is the cause
  WorkStopped(WorkState state, const std::string& what)
    : std::runtime_error(what)
    , state_(state)
  {
  }

  [[nodiscard]] WorkState state() const { return state_; }

private:
  WorkState state_;
};

/// The processes that share a bake. This class by itself is a group of one.
///
/// All processes must call the same functions in the same order, on one thread. One that cannot go
/// on calls stop() instead, whatever the others are at: they get a WorkStopped from the function
/// that they call next, and nobody waits for ever.
class ProcessGroup
{
public:
  using Words = std::vector<std::uint64_t>;

  virtual ~ProcessGroup() = default;

  [[nodiscard]] static const ProcessGroup& alone();

  [[nodiscard]] virtual int size() const { return 1; }
  [[nodiscard]] virtual int rank() const { return 0; }

  /// The words of all processes, one after the other in the order of ranks; for each process any
  /// number. Throws WorkStopped, also when memory for them is missing anywhere.
  [[nodiscard]] Words gather(const Words& own) const;

  /// The same at one process only; the others get nothing.
  [[nodiscard]] Words gatherAt(int destination, const Words& own) const;

  /// Waits for all; throws WorkStopped unless all go on.
  void agree() const;

  /// Tells the others that this process does not go on; does not throw.
  void stop(WorkState state) const;

  // Made of gather(): the same bits on all processes.
  [[nodiscard]] std::uint64_t sum(std::uint64_t own) const;
  [[nodiscard]] double sum(double own) const;
  [[nodiscard]] double largest(double own) const;
  [[nodiscard]] bool any(bool own) const;

protected:
  /// One number of each process, to all.
  [[nodiscard]] virtual std::vector<std::int64_t> exchange(std::int64_t own) const;

  /// Numbers of words by process, whose sum is the size of `all`; to one process, or to all if
  /// `destination` is negative. `all` is empty where nothing arrives.
  virtual void transfer(
    int destination, const Words& own, const std::vector<std::int64_t>& lengths, Words& all) const;

private:
  /// Exchanges lengths; throws WorkStopped if one is a WorkState other than Running.
  [[nodiscard]] std::vector<std::int64_t> lengthsOfAll(std::int64_t own) const;
  [[nodiscard]] Words gatherWords(int destination, const Words& own) const;
};

/// The bits of a number as a word, and back.
[[nodiscard]] std::uint64_t wordOf(double value);
[[nodiscard]] double doubleOf(std::uint64_t word);
}

#endif
