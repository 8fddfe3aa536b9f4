// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tbb/info.h>

#include <chrono>

/// Whether more than one thread takes part in `work`, which returns how many did. On a busy machine
/// one thread may be through before another one wakes up, so `work` is repeated for up to a minute.
/// Of a process that may use only one core nothing is asked.
template <class Work>
bool moreThanOneThreadTakesPart(const Work& work)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  bool shared = tbb::info::default_concurrency() < 2;
  while (!shared && std::chrono::steady_clock::now() < end)
  {
    shared = work() > 1;
  }
  return shared;
}
