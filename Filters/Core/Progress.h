// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Progress_h
#define po_Progress_h

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <utility>

namespace po
{
/// Progress and abort of a long, parallel computation.
///
/// Workers of any thread call advance() often. The report is only ever called on the thread that
/// made the object (user interfaces ask for that), at most once an interval.
class Progress
{
public:
  /// Takes the share of the work that is done, 0 to 1; returns false to stop the computation.
  using Report = std::function<bool(double)>;

  explicit Progress(
    Report report = {}, std::chrono::milliseconds interval = std::chrono::milliseconds(50))
    : report_(std::move(report))
    , interval_(interval)
  {
  }

  /// Starts counting anew, towards `total` units of work; on the thread that made the object.
  /// @param phase what the work is, for the user
  void begin(std::uint64_t total, std::string phase = {})
  {
    total_ = total;
    done_ = 0;
    phase_ = std::move(phase);
  }

  /// What is being done; for reports.
  [[nodiscard]] const std::string& phase() const { return phase_; }

  /// Adds finished work; false means: stop soon, the result is not wanted any more.
  bool advance(std::uint64_t work)
  {
    const std::uint64_t done = done_.fetch_add(work, std::memory_order_relaxed) + work;
    if (report_ && std::this_thread::get_id() == owner_)
    {
      reportNowAndThen(done);
    }
    return !aborted();
  }

  [[nodiscard]] bool aborted() const { return aborted_.load(std::memory_order_relaxed); }

private:
  using Clock = std::chrono::steady_clock;

  void reportNowAndThen(std::uint64_t done)
  {
    const auto now = Clock::now();
    if (now - reported_ < interval_)
    {
      return;
    }
    reported_ = now;
    const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 0;
    if (!report_(share < 1 ? share : 1))
    {
      aborted_.store(true, std::memory_order_relaxed);
    }
  }

  Report report_;
  std::chrono::milliseconds interval_;
  std::thread::id owner_ = std::this_thread::get_id();
  Clock::time_point reported_ = Clock::now();
  std::uint64_t total_ = 0;
  std::string phase_;
  std::atomic<std::uint64_t> done_{ 0 };
  std::atomic<bool> aborted_{ false };
};
}

#endif
