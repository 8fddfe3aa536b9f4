// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ProgressiveSweep_h
#define po_ProgressiveSweep_h

#include "OcclusionEstimator.h"
#include "SphereSweep.h"
#include "SweepScene.h"
#include "SweepTexels.h"
#include "SweepTextures.h"
#include "TextureFormula.h"
#include "VisibilityRecords.h"

#include <vector>

namespace po
{
/// Textures that were found in another way.
struct TextureReplacements
{
  std::vector<std::size_t> places; ///< of their particles in the list, ascending
  std::vector<float> values;       ///< T * T each
  std::vector<float> shares;       ///< as many
};

/// A sweep that goes on for as long as its owner wants: its textures may be handed out after any
/// number of directions (16 make a preview) and refined later.
///
/// The result depends on the scene, the settings and the sequence of refinements, not on threads.
class ProgressiveSweep
{
public:
  /// The particles that error bars come from.
  enum class Watch
  {
    Some, ///< up to 256 of them, drawn by the seed
    All   ///< which takes 16 bytes a texel more
  };

  /// Where what is seen is kept until it is handed out.
  enum class Records
  {
    InMemory,
    OutOfCore ///< in a temporary file; error bars are known when all is handed out
  };

  struct Options
  {
    SweepSkips skips = {};
    Watch watch = Watch::Some;
    Records records = Records::InMemory;
    bool smooth = true; ///< textures, see TextureSmoothing
  };

  /// @param particles whose textures are wanted, by their index in the cloud; all others occlude.
  /// It, the scene and the settings must outlive this.
  ProgressiveSweep(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, const Options& options);

  /// How further directions are spread.
  enum class Spread
  {
    Evenly,   ///< one lattice, which leaves the smallest error
    InSubsets ///< four lattices turned at random, whose spread is an honest error bar
  };

  /// Sweeps that many more directions, rounded up to whole axes (two opposite directions) and
  /// subsets. Returns early when `progress` says so; the sweep cannot go on then.
  void refine(int directions, Progress& progress, Spread spread = Spread::Evenly);

  /// Gives back the memory that only refine() needs: it may not be called any more.
  void end();

  /// Swept so far, without those that the background makes black.
  [[nodiscard]] int directions() const;

  /// Squared errors of linear visibility, from the spread of four subsets of the directions: of the
  /// watched particles, with Watch::All in the order of the list. Subsets of one lattice complement
  /// each other: with Spread::Evenly the estimate is too large, up to three times where much is
  /// hidden. 0 where a subset is still empty.
  [[nodiscard]] std::vector<SquaredError> squaredErrors() const;

  /// The RMS of these, weighted by area.
  [[nodiscard]] double estimatedError() const;

  /// Work of one direction: the spheres that take part, whatever is listed.
  [[nodiscard]] std::size_t spheres() const { return sweep_.spheres(); }

  /// Hands the textures out in the order of the particles, on the calling thread.
  /// @param replacements take the place of what was swept
  void handOut(const OcclusionEstimator::Sink& sink, Progress& progress, BakeCounters& counters,
    const TextureReplacements& replacements = {}) const;

private:
  [[nodiscard]] SweepTextures textures() const;
  [[nodiscard]] std::size_t loadFor(std::size_t place) const;

  const BakeSettings& settings_;
  const std::vector<unsigned>& particles_;
  SweepScene order_;
  SweepTexels texels_;
  std::vector<unsigned> watched_;   ///< by index in `order_`
  std::vector<std::uint8_t> alone_; ///< flags, by index in `order_`
  VisibilityRecords records_;
  SphereSweep sweep_;
  bool smooth_;
  std::uint64_t rounds_ = 0;
};
}

#endif
