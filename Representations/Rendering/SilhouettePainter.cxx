// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePainter.h"

#include "vtkSilhouetteFS.h"

#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

namespace po
{
namespace
{
/// Below 1 in buffers of 24 bits and of floats.
constexpr float JustBeforeFarPlane = 1 - 2e-7F;

int attachmentParameter(GLenum attachment, GLenum parameter)
{
  GLint value = 0;
  glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, parameter, &value);
  return value;
}

bool isAttached(GLenum attachment)
{
  return attachmentParameter(attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE;
}

/// A texture that is readable by shaders while this object lives.
class ActiveTexture
{
public:
  ActiveTexture(vtkShaderProgram* program, const char* name, vtkTextureObject* texture)
    : texture_(texture)
  {
    texture_->Activate();
    program->SetUniformi(name, texture_->GetTextureUnit());
  }
  ~ActiveTexture() { texture_->Deactivate(); }
  ActiveTexture(const ActiveTexture&) = delete;
  void operator=(const ActiveTexture&) = delete;

private:
  vtkTextureObject* texture_;
};

/// Everything that drawing changes is as before when this object ends.
struct SavedState
{
  explicit SavedState(vtkOpenGLState* state)
    : viewport(state)
    , scissor(state)
    , scissorTest(state, GL_SCISSOR_TEST)
    , blend(state, GL_BLEND)
    , depthTest(state, GL_DEPTH_TEST)
    , depthMask(state)
    , depthFunction(state)
    , blendFunction(state)
  {
  }
  vtkOpenGLState::ScopedglViewport viewport;
  vtkOpenGLState::ScopedglScissor scissor;
  vtkOpenGLState::ScopedglEnableDisable scissorTest;
  vtkOpenGLState::ScopedglEnableDisable blend;
  vtkOpenGLState::ScopedglEnableDisable depthTest;
  vtkOpenGLState::ScopedglDepthMask depthMask;
  vtkOpenGLState::ScopedglDepthFunc depthFunction;
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction;
};

}

std::string SilhouettePainter::readDepth(
  vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport, std::vector<float>& zBuffer)
{
  zBuffer.resize(static_cast<std::size_t>(viewport.width) * viewport.height);
  return read(window, viewport, GL_DEPTH_COMPONENT, GL_FLOAT, zBuffer.data());
}

std::string SilhouettePainter::readColors(vtkOpenGLRenderWindow* window,
  const SilhouetteViewport& viewport, std::vector<std::uint8_t>& rgba)
{
  rgba.resize(4 * static_cast<std::size_t>(viewport.width) * viewport.height);
  return read(window, viewport, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

std::string SilhouettePainter::read(vtkOpenGLRenderWindow* window,
  const SilhouetteViewport& viewport, unsigned int glFormat, unsigned int glType, void* target)
{
  GLint frame = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &frame);
  const DepthFormat format = queryDepthFormat(frame);
  if (!format.exists)
  {
    return "The frame buffer has no depth.";
  }
  use(window);
  vtkOpenGLState* state = window->GetState();
  const SavedState saved(state);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->PushFramebufferBindings();
  allocate(viewport, format);
  const bool copied = copy(frame, viewport);
  if (copied)
  {
    frame_->Bind(GL_READ_FRAMEBUFFER);
    frame_->ActivateReadBuffer(0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, viewport.width, viewport.height, glFormat, glType, target);
  }
  state->PopFramebufferBindings();
  return copied ? "" : "The depth of the frame buffer cannot be copied (format not supported).";
}

bool SilhouettePainter::DepthFormat::operator==(const DepthFormat& other) const
{
  return exists == other.exists && type == other.type && stencil == other.stencil;
}

SilhouettePainter::DepthFormat SilhouettePainter::queryDepthFormat(unsigned int frame)
{
  // The window system's own frame buffer (0) has other names.
  const GLenum depth = frame ? GL_DEPTH_ATTACHMENT : GL_DEPTH;
  const GLenum stencil = frame ? GL_STENCIL_ATTACHMENT : GL_STENCIL;
  DepthFormat format{ isAttached(depth), vtkTextureObject::Fixed24, isAttached(stencil) };
  if (!format.exists)
  {
    return format;
  }
  const int bits = attachmentParameter(depth, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  if (attachmentParameter(depth, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT)
  {
    format.type = vtkTextureObject::Float32;
  }
  else if (bits != 24)
  {
    format.type = bits == 16 ? vtkTextureObject::Fixed16 : vtkTextureObject::Fixed32;
  }
  return format;
}

void SilhouettePainter::use(vtkOpenGLRenderWindow* window)
{
  if (window_ != window)
  {
    releaseGraphicsResources();
  }
  window_ = window;
}

void SilhouettePainter::allocate(const SilhouetteViewport& viewport, const DepthFormat& format)
{
  const unsigned int width = viewport.width;
  const unsigned int height = viewport.height;
  if (copiedDepth_ && copiedDepth_->GetWidth() == width && copiedDepth_->GetHeight() == height &&
    format_ == format)
  {
    return;
  }
  format_ = format;
  copiedDepth_ = Texture::New();
  copiedDepth_->SetContext(window_);
  format.stencil ? copiedDepth_->AllocateDepthStencil(width, height)
                 : copiedDepth_->AllocateDepth(width, height, format.type);
  copiedColor_ = Texture::New();
  copiedColor_->SetContext(window_);
  copiedColor_->Allocate2D(width, height, 4, VTK_UNSIGNED_CHAR);
  frame_ = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  frame_->SetContext(window_);
}

bool SilhouettePainter::copy(unsigned int frame, const SilhouetteViewport& viewport)
{
  while (glGetError() != GL_NO_ERROR)
  {
    // errors of others are not ours to report
  }
  vtkOpenGLState* state = window_->GetState();
  frame_->Bind();
  frame_->AddColorAttachment(0, copiedColor_);
  frame_->AddDepthAttachment(copiedDepth_);
  frame_->ActivateBuffer(0);
  // A blit, because it also resolves a multisampled buffer (depth to one of its samples).
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, frame);
  state->vtkglBlitFramebuffer(viewport.x, viewport.y, viewport.x + viewport.width,
    viewport.y + viewport.height, 0, 0, viewport.width, viewport.height,
    GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT, GL_NEAREST);
  return glGetError() == GL_NO_ERROR;
}

std::string SilhouettePainter::upload(const SilhouettePixels& pixels, int width, int height)
{
  for (Texture* texture : { &colors_, &depths_ })
  {
    if (!*texture)
    {
      *texture = Texture::New();
      (*texture)->SetContext(window_);
      (*texture)->SetMinificationFilter(vtkTextureObject::Nearest);
      (*texture)->SetMagnificationFilter(vtkTextureObject::Nearest);
    }
  }
  // VTK's interface takes a mutable pointer, but only reads.
  auto* rgba = const_cast<std::uint8_t*>(pixels.rgba.data());
  auto* depth = const_cast<float*>(pixels.depth.data());
  const bool done = colors_->Create2DFromRaw(width, height, 4, VTK_UNSIGNED_CHAR, rgba) &&
    depths_->Create2DFromRaw(width, height, 1, VTK_FLOAT, depth);
  if (!done)
  {
    return "OpenGL could not make a texture of " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels.";
  }
  if (!quad_)
  {
    quad_ = std::make_unique<vtkOpenGLQuadHelper>(window_, nullptr, vtkSilhouetteFS, nullptr);
  }
  return quad_->Program && quad_->Program->GetCompiled()
    ? ""
    : "OpenGL could not compile the program that draws silhouettes.";
}

std::string SilhouettePainter::draw(vtkOpenGLRenderWindow* window,
  const SilhouetteViewport& viewport, int margin, const SilhouettePixels& pixels,
  bool markBackground)
{
  use(window);
  const int width = viewport.width + 2 * margin, height = viewport.height + 2 * margin;
  if (std::string error = upload(pixels, width, height); !error.empty())
  {
    return error;
  }
  vtkOpenGLState* state = window->GetState();
  const SavedState saved(state);
  state->vtkglViewport(viewport.x - margin, viewport.y - margin, width, height);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(
    GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  window->GetShaderCache()->ReadyShaderProgram(quad_->Program);
  const ActiveTexture colors(quad_->Program, "colors", colors_);
  const ActiveTexture depths(quad_->Program, "depths", depths_);
  quad_->Program->SetUniformf("depthOfAll", 0);
  quad_->Render();
  if (markBackground)
  {
    const vtkOpenGLState::ScopedglColorMask colorMask(state);
    state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    state->vtkglDepthMask(GL_TRUE);
    quad_->Program->SetUniformf("depthOfAll", JustBeforeFarPlane);
    quad_->Render();
  }
  return "";
}

void SilhouettePainter::releaseGraphicsResources()
{
  *this = SilhouettePainter();
}
}
