// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ProcessCost_h
#define po_ProcessCost_h

// What this process has used of the machine.

#include <chrono>
#include <ctime>
#include <string>

namespace po
{
struct Seconds
{
  double cpu = 0; ///< of all threads of the process
  double wall = 0;
};

class Stopwatch
{
public:
  [[nodiscard]] Seconds elapsed() const;

private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// Megabytes from a line of /proc/self/status: "VmHWM" is the peak, "VmRSS" is used now; NaN where
/// there is no such line. (The peak of getrusage can be that of the program that started this one.)
[[nodiscard]] double statusMegabytes(const std::string& name);
}

#endif
