// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ThreadGroup_h
#define po_ThreadGroup_h

// A group of processes that is played by threads.

#include "ProcessGroup.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

/// Where the threads meet.
class Meeting
{
public:
  explicit Meeting(int size)
    : size_(size)
    , words_(static_cast<std::size_t>(size))
  {
  }

  [[nodiscard]] int size() const { return size_; }

  /// Calls take(words) with what each has brought, in the order of ranks, when all are there.
  template <typename Take>
  void meet(int rank, const po::ProcessGroup::Words& own, const Take& take)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    words_[static_cast<std::size_t>(rank)] = &own;
    arrive(lock);
    lock.unlock();
    for (const po::ProcessGroup::Words* words : words_)
    {
      take(*words);
    }
    lock.lock();
    arrive(lock); // nobody brings more, or takes it away, before all have seen this
  }

private:
  void arrive(std::unique_lock<std::mutex>& lock)
  {
    const int round = round_;
    if (++there_ == size_)
    {
      there_ = 0;
      ++round_;
      all_.notify_all();
      return;
    }
    all_.wait(lock, [&] { return round_ != round; });
  }

  int size_;
  int there_ = 0;
  int round_ = 0;
  std::mutex mutex_;
  std::condition_variable all_;
  std::vector<const po::ProcessGroup::Words*> words_;
};

class ThreadGroup : public po::ProcessGroup
{
public:
  ThreadGroup(Meeting& meeting, int rank)
    : meeting_(meeting)
    , rank_(rank)
  {
  }

  [[nodiscard]] int size() const override { return meeting_.size(); }
  [[nodiscard]] int rank() const override { return rank_; }

protected:
  [[nodiscard]] std::vector<std::int64_t> exchange(std::int64_t own) const override
  {
    std::vector<std::int64_t> all;
    meeting_.meet(rank_, { static_cast<std::uint64_t>(own) },
      [&](const Words& words) { all.push_back(static_cast<std::int64_t>(words.front())); });
    return all;
  }

  void transfer(
    int destination, const Words& own, const std::vector<std::int64_t>&, Words& all) const override
  {
    all.clear();
    meeting_.meet(rank_, own,
      [&](const Words& words)
      {
        if (destination < 0 || destination == rank_)
        {
          all.insert(all.end(), words.begin(), words.end());
        }
      });
  }

private:
  Meeting& meeting_;
  int rank_;
};

/// Does the work of each process of a group of `size`.
inline void inParallel(int size, const std::function<void(const po::ProcessGroup&)>& work)
{
  Meeting meeting(size);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank)
  {
    threads.emplace_back([&, rank] { work(ThreadGroup(meeting, rank)); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

#endif
