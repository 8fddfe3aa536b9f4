// SPDX-License-Identifier: BSD-3-Clause
/// What a sweep costs each of the processes that share a bake.
///
/// Usage: BenchmarkProcesses [--count N] [scene]...
///
/// Scenes are told in BenchmarkScenes.h; by default pack, overlap and gas, of 200,000 particles.
/// The particles are divided over 1, 2 and 4 processes, by turns or into slabs; each bakes its own
/// with the defaults. Threads play the processes, one thread each, so that the CPU time of a thread
/// is that of a process, and nobody waits by going round in circles. "divided: no" is the baseline:
/// each process sweeps all spheres along all directions for the textures of its own, and nothing is
/// exchanged. Every row is a program run of its own, so that its memory is known: what the
/// processes add at the peak, divided by their number. MB are those that arrive at a process from
/// others.

#include "BenchmarkScenes.h"
#include "OcclusionBaker.h"
#include "ProcessCost.h"
#include "SweepEstimator.h"
#include "ThreadGroup.h"

#include <sys/wait.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <numeric>
#include <string>
#include <vector>

namespace
{
using namespace po;

struct Row
{
  std::string scene;
  std::size_t count;
  int processes;
  bool slabs;
  bool divided;
};

struct Cost
{
  double seconds = 0;
  double megabytes = 0; ///< that arrive
};

double threadSeconds()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// A process that knows how much it is sent.
class CountingGroup : public ProcessGroup
{
public:
  explicit CountingGroup(const ProcessGroup& group)
    : group_(group)
  {
  }

  [[nodiscard]] int size() const override { return group_.size(); }
  [[nodiscard]] int rank() const override { return group_.rank(); }
  [[nodiscard]] double megabytes() const { return 8e-6 * static_cast<double>(words_); }

protected:
  [[nodiscard]] std::vector<std::int64_t> exchange(std::int64_t own) const override
  {
    std::vector<std::int64_t> all;
    for (const std::uint64_t word : group_.gather({ static_cast<std::uint64_t>(own) }))
    {
      all.push_back(static_cast<std::int64_t>(word));
    }
    return all;
  }

  void transfer(
    int destination, const Words& own, const std::vector<std::int64_t>&, Words& all) const override
  {
    all = destination < 0 ? group_.gather(own) : group_.gatherAt(destination, own);
    words_ += all.empty() ? 0 : all.size() - own.size();
  }

private:
  const ProcessGroup& group_;
  mutable std::size_t words_ = 0;
};

/// The process that each particle belongs to.
std::vector<int> ownersOf(const SphereCloud& cloud, const Row& row)
{
  const std::size_t count = cloud.spheres.size();
  std::vector<unsigned> order(count);
  std::iota(order.begin(), order.end(), 0u);
  if (row.slabs)
  {
    std::stable_sort(order.begin(), order.end(),
      [&](unsigned a, unsigned b) { return cloud.spheres[a].x < cloud.spheres[b].x; });
  }
  const auto processes = static_cast<std::size_t>(row.processes);
  std::vector<int> owners(count);
  for (std::size_t place = 0; place < count; ++place)
  {
    owners[order[place]] =
      static_cast<int>(row.slabs ? place * processes / count : place % processes);
  }
  return owners;
}

Cost bakeShare(
  const SphereCloud& cloud, const std::vector<int>& owners, const ProcessGroup& group, bool divided)
{
  std::vector<unsigned> own;
  for (unsigned i = 0; i < owners.size(); ++i)
  {
    if (owners[i] == group.rank())
    {
      own.push_back(i);
    }
  }
  const CountingGroup counting(group);
  tbb::task_arena thisThread(1);
  Cost cost;
  thisThread.execute(
    [&]
    {
      const double start = threadSeconds();
      const BakeScene scene(cloud, {}, divided ? counting : ProcessGroup::alone());
      Progress progress;
      const BakeResult result =
        bakeOcclusion(scene, own, BakeSettings(), SweepEstimator(), progress);
      cost.seconds = threadSeconds() - start;
    });
  cost.megabytes = counting.megabytes();
  return cost;
}

void measure(const Row& row)
{
  const SphereCloud cloud = makeBenchmarkScene(row.scene, row.count);
  const std::vector<int> owners = ownersOf(cloud, row);
  const double before = statusMegabytes("VmRSS");
  std::vector<Cost> costs(static_cast<std::size_t>(row.processes));
  inParallel(row.processes,
    [&](const ProcessGroup& group) {
      costs[static_cast<std::size_t>(group.rank())] = bakeShare(cloud, owners, group, row.divided);
    });
  const double peak = (statusMegabytes("VmHWM") - before) / row.processes;
  Cost sum;
  double most = 0;
  for (const Cost& cost : costs)
  {
    sum.seconds += cost.seconds;
    sum.megabytes += cost.megabytes;
    most = std::max(most, cost.seconds);
  }
  std::printf("| %s (%zu) | %d | %s | %s | %.2f | %.2f | %.0f | %.0f |\n", row.scene.c_str(),
    cloud.spheres.size(), row.processes, row.slabs ? "slabs" : "by turns",
    row.divided ? "yes" : "no", sum.seconds / row.processes, most, peak,
    sum.megabytes / row.processes);
  std::fflush(stdout);
}

/// In a process of its own.
void measureApart(const Row& row)
{
  const pid_t child = fork();
  if (child == 0)
  {
    measure(row);
    std::_Exit(0);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
  {
    throw std::runtime_error("A run of " + row.scene + " has failed.");
  }
}

void run(const std::string& scene, std::size_t count)
{
  measureApart({ scene, count, 1, false, false });
  for (const int processes : { 2, 4 })
  {
    measureApart({ scene, count, processes, false, false });
    for (const bool slabs : { false, true })
    {
      measureApart({ scene, count, processes, slabs, true });
    }
  }
}
}

int main(int argc, char** argv)
try
{
  std::size_t count = 200000;
  std::vector<std::string> scenes;
  for (int i = 1; i < argc; ++i)
  {
    if (std::string(argv[i]) == "--count" && i + 1 < argc)
    {
      count = std::stoul(argv[++i]);
    }
    else
    {
      scenes.emplace_back(argv[i]);
    }
  }
  std::printf("| scene (spheres) | processes | particles | divided | CPU s a process | the most | "
              "MB a process | MB received |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::fflush(stdout);
  for (const std::string& scene :
    scenes.empty() ? std::vector<std::string>{ "pack", "overlap", "gas" } : scenes)
  {
    run(scene, count);
  }
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "BenchmarkProcesses: " << error.what() << "\n";
  return 1;
}
