//VTK::System::Dec

// SPDX-License-Identifier: BSD-3-Clause
// One texel a pixel of traced colour and depth; what is drawn already is tested by OpenGL. Passes that
// peel translucent surfaces put their code where it says so.

//VTK::Output::Dec

//VTK::DepthPeeling::Dec

uniform sampler2D colors;
uniform sampler2D depths;

in vec2 texCoord; // of the viewport: its pixels' centres are the texels' centres

void main()
{
  float depth = texture(depths, texCoord).r;
  if (depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = depth;
  //VTK::DepthPeeling::PreColor
  gl_FragData[0] = texture(colors, texCoord);
  //VTK::DepthPeeling::Impl
}
