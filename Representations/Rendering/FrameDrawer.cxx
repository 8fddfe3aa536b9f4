// SPDX-License-Identifier: BSD-3-Clause
#include "FrameDrawer.h"

#include "vtkRayTracedFrameFS.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

namespace po
{
FrameDrawer::FrameDrawer() = default;
FrameDrawer::~FrameDrawer() = default;

PixelRectangle FrameDrawer::currentViewport(vtkOpenGLRenderWindow* window)
{
  int viewport[4] = {};
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  return { viewport[0], viewport[1], viewport[2], viewport[3] };
}

bool FrameDrawer::upload(vtkOpenGLRenderWindow* window, const PixelRectangle& viewport,
  const std::vector<std::uint8_t>& rgba, const std::vector<float>& depth)
{
  const auto width = static_cast<unsigned>(viewport.width);
  const auto height = static_cast<unsigned>(viewport.height);
  for (vtkTextureObject* texture : { colors_.Get(), depths_.Get() })
  {
    texture->SetContext(window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  }
  // VTK's interface takes a mutable pointer, but only reads.
  return colors_->Create2DFromRaw(
           width, height, 4, VTK_UNSIGNED_CHAR, const_cast<std::uint8_t*>(rgba.data())) &&
    depths_->Create2DFromRaw(width, height, 1, VTK_FLOAT, const_cast<float*>(depth.data()));
}

bool FrameDrawer::readyProgram(vtkOpenGLRenderWindow* window)
{
  if (!quad_)
  {
    quad_ = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, vtkRayTracedFrameFS, nullptr);
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(quad_->Program);
  }
  return quad_->Program && quad_->Program->GetCompiled();
}

void FrameDrawer::draw(vtkOpenGLRenderWindow* window, const PixelRectangle& viewport,
  const std::vector<std::uint8_t>& rgba, const std::vector<float>& depth, std::string& error)
{
  error.clear();
  if (!upload(window, viewport, rgba, depth))
  {
    error = "OpenGL could not make a texture of " + std::to_string(viewport.width) + " x " +
      std::to_string(viewport.height) + " pixels.";
    return;
  }
  if (!readyProgram(window))
  {
    error = "OpenGL could not compile the program that draws the traced frame.";
    return;
  }
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable blending(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable culling(state, GL_CULL_FACE);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglDepthMask(GL_TRUE);

  colors_->Activate();
  depths_->Activate();
  quad_->Program->SetUniformi("colors", colors_->GetTextureUnit());
  quad_->Program->SetUniformi("depths", depths_->GetTextureUnit());
  quad_->Render();
  depths_->Deactivate();
  colors_->Deactivate();
}

void FrameDrawer::releaseGraphicsResources(vtkWindow* window)
{
  quad_.reset();
  colors_->ReleaseGraphicsResources(window);
  depths_->ReleaseGraphicsResources(window);
}
}
