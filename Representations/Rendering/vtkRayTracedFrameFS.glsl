//VTK::System::Dec

// SPDX-License-Identifier: BSD-3-Clause
// One texel a pixel of traced colour and depth; what is drawn already is tested by OpenGL.

//VTK::Output::Dec

uniform sampler2D colors;
uniform sampler2D depths;
uniform ivec2 origin; // of the viewport in the frame buffer

in vec2 texCoord;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy) - origin;
  float depth = texelFetch(depths, pixel, 0).r;
  if (depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = depth;
  gl_FragData[0] = texelFetch(colors, pixel, 0);
}
