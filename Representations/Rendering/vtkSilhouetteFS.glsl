// SPDX-License-Identifier: BSD-3-Clause
//VTK::System::Dec

// Lines over a picture: colour with strength in alpha, and the depth of what is in front of them.

//VTK::Output::Dec

in vec2 texCoord; // of the viewport: its pixels' centres are the texels' centres

uniform sampler2D colors;
uniform sampler2D depths;

void main()
{
  float depth = texture(depths, texCoord).r;
  if (depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = depth;
  gl_FragData[0] = texture(colors, texCoord);
}
