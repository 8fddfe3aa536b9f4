// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePainter.h"

#include "vtkSilhouetteDistanceFS.h"
#include "vtkSilhouetteFarthestFS.h"
#include "vtkSilhouetteLineFS.h"

#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

namespace po
{
namespace
{
/// Side of the block that one pixel of the next level stands for, as in vtkSilhouetteFarthestFS.
constexpr int ReductionBlock = 8;

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

std::unique_ptr<vtkOpenGLQuadHelper> buildQuad(vtkOpenGLRenderWindow* window, const char* source)
{
  return std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, source, nullptr);
}

bool isCompiled(const std::unique_ptr<vtkOpenGLQuadHelper>& quad)
{
  return quad->Program && quad->Program->GetCompiled();
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

void setMatrix(vtkShaderProgram* program, const char* name, const Matrix4& matrix)
{
  std::array<float, 16> columns; // OpenGL has columns first
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      columns[4 * column + row] = static_cast<float>(matrix[4 * row + column]);
    }
  }
  program->SetUniformMatrix4x4(name, columns.data());
}

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
    , blendFunction(state)
  {
  }
  vtkOpenGLState::ScopedglViewport viewport;
  vtkOpenGLState::ScopedglScissor scissor;
  vtkOpenGLState::ScopedglEnableDisable scissorTest;
  vtkOpenGLState::ScopedglEnableDisable blend;
  vtkOpenGLState::ScopedglEnableDisable depthTest;
  vtkOpenGLState::ScopedglDepthMask depthMask;
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction;
};

void prepareToDraw(vtkOpenGLState* state)
{
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
}
}

std::string SilhouettePainter::readDepth(vtkOpenGLRenderWindow* window,
  const SilhouetteViewport& viewport, const WindowToEye& windowToEye, bool whole)
{
  GLint frame = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &frame);
  const DepthFormat format = queryDepthFormat(frame);
  if (!format.exists)
  {
    return "The frame buffer has no depth.";
  }

  vtkOpenGLState* state = window->GetState();
  const SavedState saved(state);
  prepareToDraw(state);
  state->PushFramebufferBindings();
  allocate(window, viewport, format);
  const bool built = buildPrograms();
  const bool copied = built && copyDepth(frame, viewport);
  if (copied)
  {
    computeDistances(windowToEye);
    if (whole || !farthestOfWhole_)
    {
      findFarthest();
    }
  }
  state->PopFramebufferBindings();
  if (!built)
  {
    return "The silhouette shaders do not compile.";
  }
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

SilhouettePainter::Texture SilhouettePainter::allocateFloat(int width, int height) const
{
  Texture texture = Texture::New();
  texture->SetContext(window_);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->Allocate2D(width, height, 1, VTK_FLOAT);
  return texture;
}

void SilhouettePainter::allocate(
  vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport, const DepthFormat& format)
{
  const unsigned int width = viewport.width;
  const unsigned int height = viewport.height;
  if (window_ == window && depth_ && depth_->GetWidth() == width && depth_->GetHeight() == height &&
    format_ == format)
  {
    return;
  }
  if (window_ != window)
  {
    releaseGraphicsResources();
  }
  window_ = window;
  format_ = format;

  depth_ = Texture::New();
  depth_->SetContext(window);
  depth_->SetMinificationFilter(vtkTextureObject::Nearest);
  depth_->SetMagnificationFilter(vtkTextureObject::Nearest);
  format.stencil ? depth_->AllocateDepthStencil(width, height)
                 : depth_->AllocateDepth(width, height, format.type);

  distances_ = allocateFloat(width, height);
  farthest_.clear();
  int columns = viewport.width;
  int rows = viewport.height;
  do
  {
    columns = (columns + ReductionBlock - 1) / ReductionBlock;
    rows = (rows + ReductionBlock - 1) / ReductionBlock;
    farthest_.push_back(allocateFloat(columns, rows));
  } while (columns > 1 || rows > 1);

  frame_ = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  frame_->SetContext(window);
}

bool SilhouettePainter::buildPrograms()
{
  if (!distanceQuad_)
  {
    distanceQuad_ = buildQuad(window_, vtkSilhouetteDistanceFS);
    farthestQuad_ = buildQuad(window_, vtkSilhouetteFarthestFS);
    lineQuad_ = buildQuad(window_, vtkSilhouetteLineFS);
  }
  return isCompiled(distanceQuad_) && isCompiled(farthestQuad_) && isCompiled(lineQuad_);
}

bool SilhouettePainter::copyDepth(unsigned int frame, const SilhouetteViewport& viewport)
{
  while (glGetError() != GL_NO_ERROR)
  {
    // errors of others are not ours to report
  }
  vtkOpenGLState* state = window_->GetState();
  frame_->Bind();
  frame_->AddColorAttachment(0, distances_);
  frame_->AddDepthAttachment(depth_);
  frame_->ActivateBuffer(0);
  // A blit, because it also resolves a multisampled buffer (to one of its samples).
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, frame);
  state->vtkglBlitFramebuffer(viewport.x, viewport.y, viewport.x + viewport.width,
    viewport.y + viewport.height, 0, 0, viewport.width, viewport.height, GL_DEPTH_BUFFER_BIT,
    GL_NEAREST);
  // A texture that is attached must not be read.
  frame_->RemoveDepthAttachment();
  return glGetError() == GL_NO_ERROR;
}

void SilhouettePainter::drawInto(vtkTextureObject* target, vtkOpenGLQuadHelper& quad)
{
  frame_->Bind();
  frame_->AddColorAttachment(0, target);
  frame_->ActivateBuffer(0);
  window_->GetState()->vtkglViewport(0, 0, target->GetWidth(), target->GetHeight());
  quad.Render();
}

void SilhouettePainter::computeDistances(const WindowToEye& windowToEye)
{
  vtkShaderProgram* program = distanceQuad_->Program;
  window_->GetShaderCache()->ReadyShaderProgram(program);
  const ActiveTexture depth(program, "zBuffer", depth_);
  program->SetUniformi("perspective", windowToEye.perspective ? 1 : 0);
  setMatrix(program, "windowToEye", windowToEye.matrix);
  drawInto(distances_, *distanceQuad_);
}

void SilhouettePainter::findFarthest()
{
  vtkShaderProgram* program = farthestQuad_->Program;
  window_->GetShaderCache()->ReadyShaderProgram(program);
  vtkTextureObject* source = distances_;
  for (const Texture& level : farthest_)
  {
    const ActiveTexture distances(program, "distances", source);
    drawInto(level, *farthestQuad_);
    source = level;
  }
  farthestOfWhole_ = source;
}

void SilhouettePainter::drawLines(
  const SilhouetteViewport& viewport, int margin, const SilhouetteStyle& style)
{
  vtkOpenGLState* state = window_->GetState();
  const SavedState saved(state);
  prepareToDraw(state);
  state->vtkglViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(
    GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  vtkShaderProgram* program = lineQuad_->Program;
  window_->GetShaderCache()->ReadyShaderProgram(program);
  const ActiveTexture distances(program, "distances", distances_);
  const ActiveTexture farthest(program, "farthestDistance", farthestOfWhole_);
  program->SetUniformi("margin", margin);
  program->SetUniformf("threshold", static_cast<float>(style.edges.threshold));
  program->SetUniformf("backgroundDepth", static_cast<float>(style.edges.backgroundDepth));
  program->SetUniformf("automaticShare", static_cast<float>(AutomaticThresholdShare));
  program->SetUniformf("backgroundMargin", static_cast<float>(BackgroundMargin));
  program->SetUniform4f("lineColor", style.color.data());
  lineQuad_->Render();
}

void SilhouettePainter::releaseGraphicsResources()
{
  *this = SilhouettePainter();
}
}
