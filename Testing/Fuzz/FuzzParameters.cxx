// SPDX-License-Identifier: BSD-3-Clause
// Any parameters of the filter, on a few particles.
#include "FuzzBake.h"
#include "FuzzData.h"

namespace
{
int anyInteger(Provider& bytes)
{
  return bytes.ConsumeBool() ? bytes.ConsumeIntegralInRange<int>(-1, 8)
                             : bytes.ConsumeIntegral<int>();
}

vtkSmartPointer<vtkPolyData> fewParticles()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 6; ++i)
  {
    points->InsertNextPoint(0.8 * i, 0.3 * (i % 3), 0.1 * i);
  }
  data->SetPoints(points);
  return data;
}

/// Work that a user may ask for, but that would stop the fuzzing.
bool isTooMuch(vtkSphereAmbientOcclusion* filter)
{
  return filter->GetTextureResolution() > 8 || filter->GetSamplesPerTexel() > 64 ||
    (filter->GetTargetError() > 0 && filter->GetTargetError() < 0.02);
}
}

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  prepareFuzzing();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Provider bytes(data, size);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  // Each a parameter of its own, in any order and number.
  while (bytes.remaining_bytes() > 0)
  {
    switch (bytes.ConsumeIntegralInRange<int>(0, 19))
    {
      case 0:
        filter->SetTextureResolution(anyInteger(bytes));
        break;
      case 1:
        filter->SetSamplesPerTexel(anyInteger(bytes));
        break;
      case 2:
        filter->SetTargetError(anyNumber(bytes));
        break;
      case 3:
        filter->SetMethod(anyInteger(bytes));
        break;
      case 4:
        filter->SetMaximumDistance(anyNumber(bytes));
        break;
      case 5:
        filter->SetBackground(anyInteger(bytes));
        break;
      case 6:
      {
        const double x = anyNumber(bytes), y = anyNumber(bytes), z = anyNumber(bytes);
        filter->SetBackgroundUp(x, y, z);
        break;
      }
      case 7:
        filter->SetBackgroundBottom(anyNumber(bytes));
        break;
      case 8:
        filter->SetBackgroundTop(anyNumber(bytes));
        break;
      case 9:
        filter->SetBackgroundImage(bytes.ConsumeRandomLengthString(20).c_str());
        break;
      case 10:
        filter->SetDilateInside(bytes.ConsumeBool());
        break;
      case 11:
        filter->SetInsideThreshold(anyNumber(bytes));
        break;
      case 12:
        filter->SetEncoding(anyInteger(bytes));
        break;
      case 13:
        filter->SetSeed(anyInteger(bytes));
        break;
      case 14:
        filter->SetRadiusScale(anyNumber(bytes));
        break;
      case 15:
        filter->SetBakeLight(bytes.ConsumeBool());
        break;
      case 16:
      {
        const double x = anyNumber(bytes), y = anyNumber(bytes), z = anyNumber(bytes);
        filter->SetLightDirection(x, y, z);
        break;
      }
      case 17:
        filter->SetLightIntensity(anyNumber(bytes));
        break;
      case 18:
        filter->SetReuseUnchanged(bytes.ConsumeBool());
        break;
      default:
        filter->SetConstantRadius(anyNumber(bytes));
        break;
    }
  }
  if (!isTooMuch(filter))
  {
    bakeAndCheck(filter, fewParticles());
  }
  return 0;
}
