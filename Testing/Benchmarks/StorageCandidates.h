// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_StorageCandidates_h
#define po_StorageCandidates_h

#include "StoredTextures.h"

#include <vector>

namespace po
{
/// The floats themselves.
[[nodiscard]] Candidate uncompressed(const Baked& baked);

/// Which ways are compared.
enum class Candidates
{
  All,        ///< which takes hours for 200,000 particles
  OfTheFilter ///< 8 bit, and the storages of the filter
};

/// The ways that are compared. They refer to `baked`.
[[nodiscard]] std::vector<Candidate> makeCandidates(const Baked& baked, Candidates which);

/// RMS difference from what was baked, over what is visible of all particles that light reaches.
[[nodiscard]] double differenceOf(const Baked& baked, const Candidate& candidate);
}

#endif
