// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BenchmarkScenes_h
#define po_BenchmarkScenes_h

#include "Background.h"
#include "SphereCloud.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace po
{
/// The spheres of a benchmark by name: the same bits on every run.
///
/// - a family of SyntheticSpheres: "pack", "overlap", "gas", "shell", "foam";
/// - "ratio:R": a gas of log-uniform radii, the largest R times the smallest, that fill
///   GasVolumeFraction of a cube;
/// - "lattice:R": the jittered lattice of the family Overlap with another radius, in spacings:
///   apart below 0.45, touching about 0.5, ever deeper overlap above;
/// - a file that ends in ".vtp", points with an array "radius"; `count` is then of no account.
///
/// Throws std::runtime_error if there is no such scene.
[[nodiscard]] SphereCloud makeBenchmarkScene(const std::string& name, std::size_t count);

/// The background of a benchmark by name: "half" is 1 above the horizon (a band of 3 degrees leads
/// up to it) and exactly 0 below. Throws std::runtime_error if there is no such background.
[[nodiscard]] Background makeBenchmarkBackground(const std::string& name);

/// Tells whether two clouds have the same spheres (FNV-1a of their bits).
[[nodiscard]] std::uint64_t checksum(const SphereCloud& cloud);

/// `count` different particles out of `particles`, or all if there are fewer. A longer draw begins
/// with the shorter one.
[[nodiscard]] std::vector<unsigned> drawParticles(std::size_t particles, std::size_t count);
}

#endif
