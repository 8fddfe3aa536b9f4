// SPDX-License-Identifier: BSD-3-Clause
// Any arrays and blocks on both inputs of the filter, and into the renderer.
#include "FuzzBake.h"
#include "FuzzData.h"

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  prepareFuzzing();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Provider bytes(data, size);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetTextureResolution(bytes.ConsumeIntegralInRange<int>(1, 4));
  filter->SetSamplesPerTexel(bytes.ConsumeIntegralInRange<int>(1, 4));
  filter->SetMethod(bytes.ConsumeIntegralInRange<int>(0, 3));
  filter->SetEncoding(bytes.ConsumeIntegralInRange<int>(0, 1));
  const std::array<const char*, 6> arrays = { nullptr, "radius", "(none)", "value", "", "nothing" };
  filter->SetRadiusArray(arrays[bytes.ConsumeIntegralInRange<std::size_t>(0, arrays.size() - 1)]);
  const auto input = anyData(bytes);
  drawData(input);
  if (bytes.ConsumeBool())
  {
    filter->SetInputDataObject(vtkSphereAmbientOcclusion::OccludersPort, anyData(bytes));
  }
  bakeAndCheck(filter, input);
  return 0;
}
