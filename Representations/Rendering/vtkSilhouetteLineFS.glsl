// SPDX-License-Identifier: BSD-3-Clause
//VTK::System::Dec

// Draws the pixels whose Laplacian of distance exceeds the threshold: the rule of
// po::ResolveEdgeRule and po::DepthLaplacian, step by step.

//VTK::Output::Dec

const float BACKGROUND = 3.4e38;

in vec2 texCoord;

uniform sampler2D distances;
uniform sampler2D farthestDistance; // one texel; read if threshold or background is automatic
uniform int margin; // pixels of `distances` beyond the picture on each side
uniform float threshold;            // 0: automatic
uniform float backgroundDepth;      // 0: automatic
uniform float automaticShare;
uniform float backgroundMargin;
uniform vec4 lineColor;

float distanceAt(ivec2 pixel, float background)
{
  ivec2 inside = clamp(pixel, ivec2(0), textureSize(distances, 0) - 1);
  float t = texelFetch(distances, inside, 0).r;
  return t < BACKGROUND ? t : background;
}

float laplacian(ivec2 pixel, float background)
{
  float center = distanceAt(pixel, background);
  float sum = 0.0;
  for (int j = -1; j <= 1; ++j)
  {
    for (int i = -1; i <= 1; ++i)
    {
      sum += center - distanceAt(pixel + ivec2(i, j), background);
    }
  }
  return sum;
}

void main()
{
  float edge = threshold;
  float background = backgroundDepth;
  if (edge == 0.0 || background == 0.0)
  {
    float farthest = texelFetch(farthestDistance, ivec2(0), 0).r;
    if (farthest == BACKGROUND)
    {
      discard; // nothing is visible
    }
    float automatic = automaticShare * abs(farthest);
    edge = threshold > 0.0 ? threshold : automatic;
    background =
      backgroundDepth > 0.0 ? backgroundDepth : farthest + backgroundMargin * max(edge, automatic);
  }
  ivec2 picture = textureSize(distances, 0) - 2 * margin;
  ivec2 pixel = ivec2(texCoord * vec2(picture)) + margin;
  if (!(laplacian(pixel, background) > edge))
  {
    discard;
  }
  gl_FragData[0] = lineColor;
}
