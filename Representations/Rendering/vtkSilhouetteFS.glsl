// SPDX-License-Identifier: BSD-3-Clause
//VTK::System::Dec

// Lines over a picture: colour with strength in alpha, and the depth of what is in front of them.

//VTK::Output::Dec

in vec2 texCoord; // of the viewport: its pixels' centres are the texels' centres

uniform sampler2D colors;
uniform sampler2D depths;
uniform float depthOfAll; // in place of that of the texture; 0: none

void main()
{
  float depth = texture(depths, texCoord).r;
  if (depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = depthOfAll > 0.0 ? depthOfAll : depth;
  gl_FragData[0] = texture(colors, texCoord);
}
