// SPDX-License-Identifier: BSD-3-Clause
#include "RenderState.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCollection.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderer.h"
#include "vtkProperty.h"

#include <algorithm>

namespace po
{
namespace
{
Matrix4 toMatrix(vtkMatrix4x4* source)
{
  Matrix4 matrix;
  std::copy_n(source->GetData(), matrix.size(), matrix.begin());
  return matrix;
}

Camera cameraOf(vtkRenderer* renderer, int width, int height, double aspect)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  return { toMatrix(camera->GetModelViewTransformMatrix()),
    toMatrix(camera->GetProjectionTransformMatrix(aspect, -1, 1)), width, height };
}

Vec3d toVec3d(const double* v)
{
  return { v[0], v[1], v[2] };
}

Vec3f toVec3f(const double* v)
{
  return toVec3d(v).as<float>();
}

Light toLight(vtkLight* source)
{
  double position[3], focalPoint[3];
  source->GetTransformedPosition(position);
  source->GetTransformedFocalPoint(focalPoint);
  const Vec3d way = toVec3d(focalPoint) - toVec3d(position);
  Light light;
  light.positional = source->GetPositional() != 0;
  light.position = toVec3d(position);
  light.direction = length(way) > 0 ? normalized(way) : light.direction;
  // VTK's shaders use the diffuse colour for highlights too.
  light.color = static_cast<float>(source->GetIntensity()) * toVec3f(source->GetDiffuseColor());
  light.coneAngle = source->GetConeAngle();
  light.exponent = source->GetExponent();
  std::copy_n(source->GetAttenuationValues(), 3, light.attenuation.begin());
  return light;
}
}

Camera cameraOf(vtkRenderer* renderer, int width, int height)
{
  return cameraOf(renderer, width, height, renderer->GetTiledAspectRatio());
}

Camera cameraOfPicture(vtkRenderer* renderer, int width, int height)
{
  return cameraOf(renderer, width, height, static_cast<double>(width) / height);
}

Matrix4 placementOf(vtkActor* actor)
{
  vtkNew<vtkMatrix4x4> matrix;
  actor->GetModelToWorldMatrix(matrix);
  return toMatrix(matrix);
}

std::vector<Light> lightsOf(vtkRenderer* renderer)
{
  std::vector<Light> lights;
  vtkLightCollection* sources = renderer->GetLights();
  vtkCollectionSimpleIterator iterator;
  sources->InitTraversal(iterator);
  while (vtkLight* source = sources->GetNextLight(iterator))
  {
    if (source->GetSwitch() != 0)
    {
      lights.push_back(toLight(source));
    }
  }
  auto* openGL = vtkOpenGLRenderer::SafeDownCast(renderer);
  const bool loneHeadlight =
    openGL && openGL->GetLightingComplexity() == vtkOpenGLRenderer::Headlight;
  if (loneHeadlight && lights.size() == 1)
  {
    lights.front().headlight = true;
  }
  return lights;
}

Material materialOf(vtkProperty* property, bool anyLight)
{
  Material material;
  material.lighting = property->GetLighting() && anyLight;
  material.ambient = property->GetAmbient();
  material.diffuse = property->GetDiffuse();
  material.specular = property->GetSpecular();
  material.specularPower = property->GetSpecularPower();
  material.opacity = property->GetOpacity();
  material.ambientColor = toVec3f(property->GetAmbientColor());
  material.diffuseColor = toVec3f(property->GetDiffuseColor());
  material.specularColor = toVec3f(property->GetSpecularColor());
  return material;
}
}
