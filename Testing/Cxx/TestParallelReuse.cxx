// SPDX-License-Identifier: BSD-3-Clause
// Several processes reuse textures of an earlier step. Run by mpiexec with any number of processes.

#include "ParallelBakeTestSupport.h"

#include <utility>

TEST(ParallelReuse, GivesTheBitsOfABakeOfOneProcess)
{
  const auto before = mixedCloud(600);
  vtkNew<vtkPolyData> after;
  after->DeepCopy(before);
  for (vtkIdType i = 0; i < 12; ++i)
  {
    double p[3];
    before->GetPoint(50 * i, p);
    after->GetPoints()->SetPoint(50 * i, p[0], p[1] + 0.05, p[2]);
  }
  const vtkIdType half = before->GetNumberOfPoints() / 2;
  const Owner byHalves = [&](vtkIdType i) { return i < half ? 0 : size() - 1; };
  for (const auto& [owner, withLight] :
    { std::pair(Owner(interleaved), false), std::pair(byHalves, false), std::pair(byHalves, true) })
  {
    const auto prepare = [light = withLight](vtkSphereAmbientOcclusion* filter)
    {
      filter->SetSamplesPerTexel(16);
      filter->SetMaximumDistance(0.5);
      filter->SetBakeLight(light);
      filter->ReuseUnchangedOn();
    };
    const auto alone = bake(after, false, prepare);
    EXPECT_STREQ(alone->GetMethodUsed(), "Embree");
    const auto together = bake(ownPart(before, owner), true, prepare);
    EXPECT_EQ(together->GetNumberOfParticlesReused(), 0);
    together->SetInputData(ownPart(after, owner));
    together->Update();
    EXPECT_EQ(difference(output(alone), output(together)).particles, 0);
    EXPECT_GT(together->GetNumberOfParticlesReused(), 100);
    EXPECT_LT(together->GetNumberOfParticlesReused(), 588);
  }
}
