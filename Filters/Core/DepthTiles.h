// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DepthTiles_h
#define po_DepthTiles_h

#include "Sphere.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Spheres sorted into octaves of their radii, so that a few large ones do not make the tiles and
/// cells of the many small ones large.
class RadiusOctaves
{
public:
  explicit RadiusOctaves(const std::vector<Sphere>& spheres);

  [[nodiscard]] std::size_t size() const { return largestRadius_.size(); }
  [[nodiscard]] std::uint8_t of(unsigned sphere) const { return octaveOf_[sphere]; }
  /// Octaves are numbered upward; each holds at least one sphere.
  [[nodiscard]] float largestRadius(std::size_t octave) const { return largestRadius_[octave]; }

private:
  std::vector<std::uint8_t> octaveOf_;
  std::vector<float> largestRadius_;
};

/// A sphere seen along a direction: x, y across, z towards the light.
struct ProjectedSphere
{
  float x, y, z, radius;
  unsigned id;
};

/// What a sphere is to a tile.
enum class TileRole : std::uint8_t
{
  Receiver, ///< its centre lies in the tile
  Halo,     ///< of the tile's octave, centre outside: may hide receivers
  Other,    ///< of another octave: may hide receivers
};

struct TileSphere
{
  ProjectedSphere sphere;
  TileRole role;
};

/// A square of the projection with all spheres that can hide its receivers.
struct DepthTile
{
  float x, y, width;
  const TileSphere* first;
  const TileSphere* last;
};

/// The spheres of one octave, as receivers, cut into square tiles; each receiver is in one tile.
class DepthTiles
{
public:
  /// @param hidden flags by sphere: those of other octaves that are set are left out
  void build(const std::vector<ProjectedSphere>& spheres, const RadiusOctaves& octaves,
    std::size_t octave, const std::vector<std::uint8_t>& hidden);

  [[nodiscard]] std::size_t size() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  [[nodiscard]] DepthTile tile(std::size_t index) const;

private:
  void layOut(std::size_t receivers);
  void sortIntoTiles();

  /// Half-open range of tiles.
  struct Range
  {
    int left, right, bottom, top;
  };
  [[nodiscard]] Range tilesWithin(const ProjectedSphere& sphere, float reach) const;

  struct Member
  {
    const ProjectedSphere* sphere;
    bool sameOctave;
  };
  std::vector<Member> members_;
  std::vector<std::uint8_t> hasReceivers_; ///< by tile
  std::vector<std::size_t> starts_;
  std::vector<TileSphere> entries_;
  float lowX_ = 0, lowY_ = 0, highX_ = 0, highY_ = 0; ///< of the receivers' centres
  float reach_ = 0;                                   ///< largest radius of a receiver
  float width_ = 0;
  int columns_ = 0, rows_ = 0;
};

/// Order of a tile's spheres from the light downward; equal heights by id.
void sortByDepth(
  const DepthTile& tile, std::vector<std::uint64_t>& scratch, std::vector<std::uint32_t>& order);
}

#endif
