// SPDX-License-Identifier: BSD-3-Clause
//VTK::System::Dec

// z-buffer to distance in world units (po::EyeDistance); BACKGROUND where nothing was drawn.

//VTK::Output::Dec

const float BACKGROUND = 3.4e38;

in vec2 texCoord;

uniform sampler2D zBuffer;
uniform mat4 windowToEye;
uniform int perspective;

void main()
{
  vec2 size = vec2(textureSize(zBuffer, 0));
  ivec2 pixel = ivec2(texCoord * size);
  float z = texelFetch(zBuffer, pixel, 0).r;
  float t = BACKGROUND;
  if (z < 1.0)
  {
    vec2 position = (2.0 * vec2(pixel) + 1.0) / size - 1.0;
    vec4 eye = windowToEye * vec4(position, 1.0 - z, 1.0);
    t = perspective != 0 ? length(eye.xyz) / abs(eye.w) : -eye.z / eye.w;
  }
  gl_FragData[0] = vec4(t, 0.0, 0.0, 1.0);
}
