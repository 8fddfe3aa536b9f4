// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePainter.h"

#include "vtkSilhouetteDistanceFS.h"
#include "vtkSilhouetteFarthestFS.h"
#include "vtkSilhouetteLineFS.h"

#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

namespace
{

/// Side of the block that one pixel of the next level stands for, as in vtkSilhouetteFarthestFS.
constexpr int ReductionBlock = 8;

int AttachmentParameter(GLenum attachment, GLenum parameter)
{
  GLint value = 0;
  glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, parameter, &value);
  return value;
}

bool IsAttached(GLenum attachment)
{
  return AttachmentParameter(attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE;
}

std::unique_ptr<vtkOpenGLQuadHelper> BuildQuad(vtkOpenGLRenderWindow* window, const char* source)
{
  return std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, source, nullptr);
}

bool IsCompiled(const std::unique_ptr<vtkOpenGLQuadHelper>& quad)
{
  return quad->Program && quad->Program->GetCompiled();
}

/// A texture that is readable by shaders while this object lives.
class ActiveTexture
{
public:
  ActiveTexture(vtkShaderProgram* program, const char* name, vtkTextureObject* texture)
    : Texture(texture)
  {
    this->Texture->Activate();
    program->SetUniformi(name, this->Texture->GetTextureUnit());
  }
  ~ActiveTexture() { this->Texture->Deactivate(); }
  ActiveTexture(const ActiveTexture&) = delete;
  void operator=(const ActiveTexture&) = delete;

private:
  vtkTextureObject* Texture;
};

void SetMatrix(vtkShaderProgram* program, const char* name, const po::Matrix4& matrix)
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
    : Viewport(state)
    , Scissor(state)
    , ScissorTest(state, GL_SCISSOR_TEST)
    , Blend(state, GL_BLEND)
    , DepthTest(state, GL_DEPTH_TEST)
    , DepthMask(state)
    , BlendFunction(state)
  {
  }
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglScissor Scissor;
  vtkOpenGLState::ScopedglEnableDisable ScissorTest;
  vtkOpenGLState::ScopedglEnableDisable Blend;
  vtkOpenGLState::ScopedglEnableDisable DepthTest;
  vtkOpenGLState::ScopedglDepthMask DepthMask;
  vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunction;
};

void PrepareToDraw(vtkOpenGLState* state)
{
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
}

} // namespace

std::string SilhouettePainter::ReadDepth(vtkOpenGLRenderWindow* window,
  const SilhouetteViewport& viewport, const po::WindowToEye& windowToEye, bool whole)
{
  GLint frame = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &frame);
  const DepthFormat format = QueryDepthFormat(frame);
  if (!format.Exists)
  {
    return "The frame buffer has no depth.";
  }

  vtkOpenGLState* state = window->GetState();
  const SavedState saved(state);
  PrepareToDraw(state);
  state->PushFramebufferBindings();
  this->Allocate(window, viewport, format);
  const bool built = this->BuildPrograms();
  const bool copied = built && this->CopyDepth(frame, viewport);
  if (copied)
  {
    this->ComputeDistances(windowToEye);
    if (whole || !this->FarthestOfWhole)
    {
      this->FindFarthest();
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
  return this->Exists == other.Exists && this->Type == other.Type && this->Stencil == other.Stencil;
}

SilhouettePainter::DepthFormat SilhouettePainter::QueryDepthFormat(unsigned int frame)
{
  // The window system's own frame buffer (0) has other names.
  const GLenum depth = frame ? GL_DEPTH_ATTACHMENT : GL_DEPTH;
  const GLenum stencil = frame ? GL_STENCIL_ATTACHMENT : GL_STENCIL;
  DepthFormat format{ IsAttached(depth), vtkTextureObject::Fixed24, IsAttached(stencil) };
  if (!format.Exists)
  {
    return format;
  }
  const int bits = AttachmentParameter(depth, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  if (AttachmentParameter(depth, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT)
  {
    format.Type = vtkTextureObject::Float32;
  }
  else if (bits != 24)
  {
    format.Type = bits == 16 ? vtkTextureObject::Fixed16 : vtkTextureObject::Fixed32;
  }
  return format;
}

SilhouettePainter::Texture SilhouettePainter::AllocateFloat(int width, int height) const
{
  Texture texture = Texture::New();
  texture->SetContext(this->Window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->Allocate2D(width, height, 1, VTK_FLOAT);
  return texture;
}

void SilhouettePainter::Allocate(
  vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport, const DepthFormat& format)
{
  const unsigned int width = viewport.Width;
  const unsigned int height = viewport.Height;
  if (this->Window == window && this->Depth && this->Depth->GetWidth() == width &&
    this->Depth->GetHeight() == height && this->Format == format)
  {
    return;
  }
  if (this->Window != window)
  {
    this->ReleaseGraphicsResources();
  }
  this->Window = window;
  this->Format = format;

  this->Depth = Texture::New();
  this->Depth->SetContext(window);
  this->Depth->SetMinificationFilter(vtkTextureObject::Nearest);
  this->Depth->SetMagnificationFilter(vtkTextureObject::Nearest);
  format.Stencil ? this->Depth->AllocateDepthStencil(width, height)
                 : this->Depth->AllocateDepth(width, height, format.Type);

  this->Distances = this->AllocateFloat(width, height);
  this->Farthest.clear();
  int columns = viewport.Width;
  int rows = viewport.Height;
  do
  {
    columns = (columns + ReductionBlock - 1) / ReductionBlock;
    rows = (rows + ReductionBlock - 1) / ReductionBlock;
    this->Farthest.push_back(this->AllocateFloat(columns, rows));
  } while (columns > 1 || rows > 1);

  this->Frame = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  this->Frame->SetContext(window);
}

bool SilhouettePainter::BuildPrograms()
{
  if (!this->DistanceQuad)
  {
    this->DistanceQuad = BuildQuad(this->Window, vtkSilhouetteDistanceFS);
    this->FarthestQuad = BuildQuad(this->Window, vtkSilhouetteFarthestFS);
    this->LineQuad = BuildQuad(this->Window, vtkSilhouetteLineFS);
  }
  return IsCompiled(this->DistanceQuad) && IsCompiled(this->FarthestQuad) &&
    IsCompiled(this->LineQuad);
}

bool SilhouettePainter::CopyDepth(unsigned int frame, const SilhouetteViewport& viewport)
{
  while (glGetError() != GL_NO_ERROR)
  {
    // errors of others are not ours to report
  }
  vtkOpenGLState* state = this->Window->GetState();
  this->Frame->Bind();
  this->Frame->AddColorAttachment(0, this->Distances);
  this->Frame->AddDepthAttachment(this->Depth);
  this->Frame->ActivateBuffer(0);
  // A blit, because it also resolves a multisampled buffer (to one of its samples).
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, frame);
  state->vtkglBlitFramebuffer(viewport.X, viewport.Y, viewport.X + viewport.Width,
    viewport.Y + viewport.Height, 0, 0, viewport.Width, viewport.Height, GL_DEPTH_BUFFER_BIT,
    GL_NEAREST);
  // A texture that is attached must not be read.
  this->Frame->RemoveDepthAttachment();
  return glGetError() == GL_NO_ERROR;
}

void SilhouettePainter::DrawInto(vtkTextureObject* target, vtkOpenGLQuadHelper& quad)
{
  this->Frame->Bind();
  this->Frame->AddColorAttachment(0, target);
  this->Frame->ActivateBuffer(0);
  this->Window->GetState()->vtkglViewport(0, 0, target->GetWidth(), target->GetHeight());
  quad.Render();
}

void SilhouettePainter::ComputeDistances(const po::WindowToEye& windowToEye)
{
  vtkShaderProgram* program = this->DistanceQuad->Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  const ActiveTexture depth(program, "zBuffer", this->Depth);
  program->SetUniformi("perspective", windowToEye.Perspective ? 1 : 0);
  SetMatrix(program, "windowToEye", windowToEye.Matrix);
  this->DrawInto(this->Distances, *this->DistanceQuad);
}

void SilhouettePainter::FindFarthest()
{
  vtkShaderProgram* program = this->FarthestQuad->Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  vtkTextureObject* source = this->Distances;
  for (const Texture& level : this->Farthest)
  {
    const ActiveTexture distances(program, "distances", source);
    this->DrawInto(level, *this->FarthestQuad);
    source = level;
  }
  this->FarthestOfWhole = source;
}

void SilhouettePainter::DrawLines(
  const SilhouetteViewport& viewport, int margin, const SilhouetteStyle& style)
{
  vtkOpenGLState* state = this->Window->GetState();
  const SavedState saved(state);
  PrepareToDraw(state);
  state->vtkglViewport(viewport.X, viewport.Y, viewport.Width, viewport.Height);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(
    GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  vtkShaderProgram* program = this->LineQuad->Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  const ActiveTexture distances(program, "distances", this->Distances);
  const ActiveTexture farthest(program, "farthestDistance", this->FarthestOfWhole);
  program->SetUniformi("margin", margin);
  program->SetUniformf("threshold", static_cast<float>(style.Edges.Threshold));
  program->SetUniformf("backgroundDepth", static_cast<float>(style.Edges.BackgroundDepth));
  program->SetUniformf("automaticShare", static_cast<float>(po::AutomaticThresholdShare));
  program->SetUniformf("backgroundMargin", static_cast<float>(po::BackgroundMargin));
  program->SetUniform4f("lineColor", style.Color.data());
  this->LineQuad->Render();
}

void SilhouettePainter::ReleaseGraphicsResources()
{
  *this = SilhouettePainter();
}
