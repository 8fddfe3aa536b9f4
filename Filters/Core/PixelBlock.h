// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PixelBlock_h
#define po_PixelBlock_h

#include "TexelLookup.h"
#include "Vec3.h"

#include <cstddef>
#include <cstdint>

namespace po
{
/// Pixels on their way from the surface that they show to its colour, lane by lane, in vector code.
/// Colours are in the order red, green, blue.
struct PixelBlock
{
  static constexpr std::size_t Size = TexelLookup::Size;

  alignas(64) float occlusion[Size];        ///< 1 where it is not used
  alignas(64) float diffuseLight[3][Size];  ///< before the surface's colours
  alignas(64) float specularLight[3][Size]; ///< the same
  alignas(64) float ambientColor[3][Size];
  alignas(64) float diffuseColor[3][Size];
  alignas(64) std::int32_t alpha[Size]; ///< opacity, 0 to 255
};

/// A light without a place, in the local coordinates of normals.
struct ParallelLight
{
  Vec3f toLight; ///< unit vector
  Vec3f color;
  const std::uint8_t* reach; ///< of each lane: 0 if the light does not reach it; null: all
};

/// Adds the diffuse light of one light.
/// @param normals local unit vectors, by x, y and z
void addLight(const ParallelLight& light, const TexelLookup& normals, PixelBlock& block);

/// What colours are made of: shares of the terms, and the colour of highlights.
struct ColorTerms
{
  bool occlusionOnly; ///< the diffuse colour times occlusion, and nothing else
  bool lit;           ///< else surfaces have the light 1, and no highlights
  bool occlusionOnDiffuse;
  float ambient, diffuse, specular;
  Vec3f specularColor;
};

/// RGBA bytes of all lanes: colours that are cut off at 1, and rounded.
/// @param shown of each lane; 0: all bytes are 0
void composeColors(
  const ColorTerms& terms, const PixelBlock& block, const std::int32_t* shown, std::uint8_t* rgba);
}

#endif
