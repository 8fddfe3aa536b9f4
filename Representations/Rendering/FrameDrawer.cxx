// SPDX-License-Identifier: BSD-3-Clause
#include "FrameDrawer.h"

#include "vtkRayTracedFrameFS.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkProp.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

namespace po
{
namespace
{
/// Calls f for every render pass that the prop is drawn by.
template <typename Function>
void forEachPass(vtkProp* prop, const Function& f)
{
  vtkInformation* keys = prop->GetPropertyKeys();
  if (!keys || !keys->Has(vtkOpenGLRenderPass::RenderPasses()))
  {
    return;
  }
  for (int i = 0; i < keys->Length(vtkOpenGLRenderPass::RenderPasses()); ++i)
  {
    f(static_cast<vtkOpenGLRenderPass*>(keys->Get(vtkOpenGLRenderPass::RenderPasses(), i)));
  }
}

/// The fragment shader with what the passes put into it.
std::string shaderFor(Blending blending, vtkAbstractMapper* mapper, vtkProp* prop)
{
  std::string fragment = vtkRayTracedFrameFS;
  if (blending == Blending::Peeled)
  {
    std::string vertex, geometry;
    forEachPass(prop,
      [&](vtkOpenGLRenderPass* pass)
      {
        pass->PreReplaceShaderValues(vertex, geometry, fragment, mapper, prop);
        pass->PostReplaceShaderValues(vertex, geometry, fragment, mapper, prop);
      });
  }
  return fragment;
}

void setState(vtkOpenGLState* state, Blending blending)
{
  state->vtkglDisable(GL_CULL_FACE);
  if (blending == Blending::Peeled)
  {
    return; // the rest is the pass' business
  }
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglDepthMask(blending == Blending::OverColors ? GL_FALSE : GL_TRUE);
  if (blending == Blending::None)
  {
    state->vtkglDisable(GL_BLEND);
    return;
  }
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(
    GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}
}

FrameDrawer::FrameDrawer() = default;
FrameDrawer::~FrameDrawer() = default;

PixelRectangle FrameDrawer::currentViewport(vtkOpenGLRenderWindow* window)
{
  int viewport[4] = {};
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  return { viewport[0], viewport[1], viewport[2], viewport[3] };
}

std::string FrameDrawer::load(
  vtkOpenGLRenderWindow* window, const std::vector<PixelLayer>& layers, std::uint64_t version)
{
  if (window == window_ && version == version_ && textures_.size() == layers.size())
  {
    return {};
  }
  window_ = nullptr;
  textures_.clear();
  for (const PixelLayer& layer : layers)
  {
    auto textures = std::make_unique<Textures>();
    for (vtkTextureObject* texture : { textures->colors.Get(), textures->depths.Get() })
    {
      texture->SetContext(window);
      texture->SetMinificationFilter(vtkTextureObject::Nearest);
      texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    }
    const auto width = static_cast<unsigned>(layer.width);
    const auto height = static_cast<unsigned>(layer.height);
    // VTK's interface takes a mutable pointer, but only reads.
    if (!textures->colors->Create2DFromRaw(
          width, height, 4, VTK_UNSIGNED_CHAR, const_cast<std::uint8_t*>(layer.rgba->data())) ||
      !textures->depths->Create2DFromRaw(
        width, height, 1, VTK_FLOAT, const_cast<float*>(layer.depth->data())))
    {
      return "OpenGL could not make a texture of " + std::to_string(width) + " x " +
        std::to_string(height) + " pixels.";
    }
    textures_.push_back(std::move(textures));
  }
  window_ = window;
  version_ = version;
  return {};
}

vtkOpenGLQuadHelper* FrameDrawer::readyProgram(
  vtkOpenGLRenderWindow* window, Blending blending, vtkAbstractMapper* mapper, vtkProp* prop)
{
  const std::string shader = shaderFor(blending, mapper, prop);
  std::unique_ptr<vtkOpenGLQuadHelper>& quad = quads_[shader];
  if (!quad)
  {
    quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, shader.c_str(), nullptr);
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(quad->Program);
  }
  return quad->Program && quad->Program->GetCompiled() ? quad.get() : nullptr;
}

std::string FrameDrawer::draw(vtkOpenGLRenderWindow* window, std::size_t layer, Blending blending,
  vtkAbstractMapper* mapper, vtkProp* prop)
{
  vtkOpenGLQuadHelper* quad = readyProgram(window, blending, mapper, prop);
  if (!quad)
  {
    return "OpenGL could not compile the program that draws the traced frame.";
  }
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable culling(state, GL_CULL_FACE);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  setState(state, blending);

  Textures& textures = *textures_[layer];
  textures.colors->Activate();
  textures.depths->Activate();
  quad->Program->SetUniformi("colors", textures.colors->GetTextureUnit());
  quad->Program->SetUniformi("depths", textures.depths->GetTextureUnit());
  if (blending == Blending::Peeled)
  {
    forEachPass(prop,
      [&](vtkOpenGLRenderPass* pass)
      { pass->SetShaderParameters(quad->Program, mapper, prop, quad->VAO); });
  }
  quad->Render();
  textures.depths->Deactivate();
  textures.colors->Deactivate();
  return {};
}

void FrameDrawer::releaseGraphicsResources(vtkWindow* window)
{
  quads_.clear();
  for (const auto& textures : textures_)
  {
    textures->colors->ReleaseGraphicsResources(window);
    textures->depths->ReleaseGraphicsResources(window);
  }
  textures_.clear();
  window_ = nullptr;
}
}
