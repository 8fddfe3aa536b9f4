// SPDX-License-Identifier: BSD-3-Clause
#include "BakeFilterTestSupport.h"
#include "MemoryGrowth.h"

#include <gtest/gtest.h>

namespace
{
/// Less than 4 kB a bake: a lost texture table, scene or device of this size would be far more.
constexpr double LargestGrowth = 4; // megabytes

class MemoryGrowth : public testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(Methods, MemoryGrowth,
  testing::Values(vtkSphereAmbientOcclusion::Sweep, vtkSphereAmbientOcclusion::Embree,
    vtkSphereAmbientOcclusion::Reference));

TEST_P(MemoryGrowth, AThousandBakesReachAPlateau)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(lattice(3));
  filter->SetMethod(GetParam());
  filter->SetSamplesPerTexel(4);
  const double growth = growthOver(1000, 200,
    [&](int i)
    {
      filter->SetTextureResolution(4 + i % 3);
      ASSERT_EQ(errorOf(filter), "");
    });
  EXPECT_LT(growth, LargestGrowth);
}

TEST_P(MemoryGrowth, AThousandFailedBakesReachAPlateau)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(lattice(3));
  filter->SetMethod(GetParam());
  filter->SetBackground(vtkSphereAmbientOcclusion::Image);
  filter->SetBackgroundImage("no-such-file.exr");
  const double growth = growthOver(1000, 200,
    [&](int)
    {
      filter->Modified();
      ASSERT_NE(errorOf(filter), "");
    });
  EXPECT_LT(growth, LargestGrowth);
}
}
