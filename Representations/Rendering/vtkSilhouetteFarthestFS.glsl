// SPDX-License-Identifier: BSD-3-Clause
//VTK::System::Dec

// Farthest distance in a block of 8 x 8 pixels; BACKGROUND where the block has nothing else.

//VTK::Output::Dec

const float BACKGROUND = 3.4e38;
const int BLOCK = 8;

in vec2 texCoord;

uniform sampler2D distances;

void main()
{
  ivec2 size = textureSize(distances, 0);
  ivec2 blocks = (size + BLOCK - 1) / BLOCK; // what is drawn into
  ivec2 begin = ivec2(texCoord * vec2(blocks)) * BLOCK;
  ivec2 stop = min(begin + BLOCK, size);
  float farthest = BACKGROUND;
  for (int j = begin.y; j < stop.y; ++j)
  {
    for (int i = begin.x; i < stop.x; ++i)
    {
      float t = texelFetch(distances, ivec2(i, j), 0).r;
      if (t < BACKGROUND && (farthest == BACKGROUND || t > farthest))
      {
        farthest = t;
      }
    }
  }
  gl_FragData[0] = vec4(farthest, 0.0, 0.0, 1.0);
}
