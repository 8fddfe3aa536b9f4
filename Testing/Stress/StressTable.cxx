// SPDX-License-Identifier: BSD-3-Clause
/// Writes the tables of RESULTS.md: the cases of StressTests, as numbers.

#include "CameraCases.h"
#include "StressCase.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace
{
using namespace stress;

/// What a group of rows comes to.
struct Summary
{
  std::size_t cases = 0, texels = 0, open = 0, selfHits = 0, leaks = 0;
  double worstZ = 0;
  double rms[3] = {};   ///< largest, by method
  double ratio[3] = {}; ///< to the same scene in the unit 1 at the origin: largest, by method
  double inputError = 0;

  void add(const Row& row, const Row& base)
  {
    inputError = std::max(inputError, row.inputError);
    for (std::size_t m = 0; m < 3; ++m)
    {
      const Outcome& o = row.outcomes[m];
      ++cases;
      texels += o.texels;
      open += o.open;
      selfHits += o.selfHits;
      leaks += o.leaks;
      worstZ = std::max(worstZ, o.worstZ);
      rms[m] = std::max(rms[m], o.rms);
      const double before = rootOfSquares(base.outcomes[m]);
      const double now = rootOfSquares(o);
      ratio[m] = std::max(ratio[m], before > 0 ? now / before : 1);
    }
  }

  /// The judge's part included, which is the same in both.
  static double rootOfSquares(const Outcome& outcome)
  {
    double sum = 0;
    for (const double square : outcome.squares)
    {
      sum += square;
    }
    return std::sqrt(sum);
  }

  void print(const char* name) const
  {
    std::printf("| %s | %zu | %zu | %zu | %zu | %zu | %.1f |", name, cases, texels, open, selfHits,
      leaks, worstZ);
    for (std::size_t m = 0; m < 3; ++m)
    {
      std::printf(" %.4f / %.3f |", rms[m], ratio[m]);
    }
    std::printf(" %.0e |\n", inputError);
  }
};

constexpr const char* Head =
  " | cases | texels | open | false hits | leaks | worst z | Reference | Sweep | Embree | input |\n"
  "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";

void printScenes()
{
  std::map<std::string, Summary> byPlace;
  Summary all;
  std::printf("### By scene\n\n| scene, in all units and places%s", Head);
  for (const Scene& scene : scenes())
  {
    const std::vector<Row> rows = runScene(scene);
    Summary summary;
    for (const Row& row : rows)
    {
      summary.add(row, rows[0]);
      all.add(row, rows[0]);
      byPlace[row.placement.name].add(row, rows[0]);
    }
    summary.print(scene.name.c_str());
    std::fflush(stdout);
  }
  all.print("**all**");
  std::printf("\n### By unit and place\n\n| unit and place, all scenes%s", Head);
  for (const Placement& placement : placements())
  {
    byPlace[placement.name].print(placement.name.c_str());
  }
}

void printViews()
{
  std::printf("\n### Views\n\n| view | pixels | hits | wrong | largest error of t, in radii |\n"
              "| --- | --- | --- | --- | --- |\n");
  for (const View& view : views())
  {
    const FrameOutcome o = runView(view);
    std::printf(
      "| %s | %zu | %zu | %zu | %.0e |\n", view.name.c_str(), o.pixels, o.hits, o.wrong, o.depth);
  }
}
}

int main()
{
  printScenes();
  printViews();
  return 0;
}
