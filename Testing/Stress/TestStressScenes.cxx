// SPDX-License-Identifier: BSD-3-Clause
/// Every hard scene, in every unit and place, by every method, against the judge.

#include "StressCase.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

namespace
{
using namespace stress;

/// Of one false alarm in the whole suite, if all were as it should be.
constexpr double Risk = 1e-3;

std::size_t numberOfTexels()
{
  std::size_t texels = 0;
  for (const Scene& scene : scenes())
  {
    texels += scene.watched.size() * Texels * placements().size() * std::size(Methods);
  }
  return texels;
}

std::size_t numberOfCases()
{
  return scenes().size() * placements().size() * std::size(Methods);
}

class StressScene : public testing::TestWithParam<std::size_t>
{
};

/// No texel that is open for certain is darkened, no light reaches a sealed particle, no texel
/// deviates from the judge by more than chance (binomial counts, Sidak over all texels of all
/// scenes), and the squared error is nowhere larger than at the origin in the unit 1 (paired over
/// the texels, Sidak over all cases).
TEST_P(StressScene, IsTheSameInEveryUnitAndPlace)
{
  const Scene scene = scenes()[GetParam()];
  const double mostZ = sidakBound(numberOfTexels(), Risk);
  const double mostGrowth = sidakBound(numberOfCases(), Risk);
  const std::vector<Row> rows = runScene(scene);
  for (const Row& row : rows)
  {
    for (const Method method : Methods)
    {
      SCOPED_TRACE(scene.name + ", " + row.placement.name + ", " + nameOf(method));
      const Outcome& outcome = row.outcomes[static_cast<int>(method)];
      const Outcome& base = rows[0].outcomes[static_cast<int>(method)];
      EXPECT_GT(outcome.texels, 0u);
      EXPECT_EQ(outcome.selfHits, 0u);
      EXPECT_EQ(outcome.leaks, 0u);
      EXPECT_LT(outcome.worstZ, mostZ);
      EXPECT_LT(growth(outcome, base), mostGrowth);
      // Sweep's shortcuts may move a mean by 0.001 (see the README).
      const double bound = method == Method::Sweep ? 0.001 : 0;
      EXPECT_LE(std::abs(outcome.bias), bound + mostGrowth * outcome.biasError);
    }
  }
}

std::string nameOfScene(const testing::TestParamInfo<std::size_t>& info)
{
  std::string name = scenes()[info.param].name;
  for (char& c : name)
  {
    c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(
  All, StressScene, testing::Range(std::size_t(0), scenes().size()), nameOfScene);

TEST(StressJudge, FindsWhatAFormulaFinds)
{
  // A ball of radius R at distance d, wholly above the horizon at angle theta from the normal,
  // takes cos(theta) (R/d)^2 of the sky. Seen from the texels around the pole of a small ball.
  const judge::Judge judge({ { {}, 1e-3 }, { { 0, 0, 5 }, 2 } });
  for (int column = 0; column < 8; ++column)
  {
    const judge::Texel texel = judge.look(0, 64, 0, column, 40000);
    EXPECT_EQ(texel.outsideShare(), 1);
    EXPECT_NEAR(texel.value(), 1 - 4.0 / 25, 4.5 * std::sqrt(0.84 * 0.16 / 40000));
  }
  EXPECT_TRUE(judge.isOpen(0, 64, 63, 5));
  EXPECT_FALSE(judge.isOpen(0, 64, 0, 5));
}

TEST(StressJudge, FindsTheOutsidePartOfAnOverlap)
{
  // Two unit balls one radius apart: each loses the cap beyond x = 1/2, a quarter of its area.
  const judge::Judge judge({ { {}, 1 }, { { 1, 0, 0 }, 1 } });
  double outside = 0;
  for (int row = 0; row < 8; ++row)
  {
    const double pi = std::acos(-1.0);
    const double area = (std::cos(pi * row / 8) - std::cos(pi * (row + 1) / 8)) / 2 / 8;
    for (int column = 0; column < 8; ++column)
    {
      outside += area * judge.look(0, 8, row, column, 2000).outsideShare();
    }
  }
  EXPECT_NEAR(outside, 0.75, 0.004); // 4 standard errors are below that
}

TEST(StressJudge, TellsUnlikelyDeviations)
{
  EXPECT_EQ(zOf(30, 100, 30, 100), 0);
  // Against the normal approximation where that is good.
  EXPECT_NEAR(zOf(4800, 10000, 5200, 10000), 400 / std::sqrt(20000 * 0.25), 0.02);
  EXPECT_LT(zOf(10, 1000, 0, 1000), -3);
  EXPECT_NEAR(sidakBound(1, 0.0455), 2, 0.01);
  EXPECT_NEAR(sidakBound(1000, 1e-3), 5.0, 0.2);
}
}
