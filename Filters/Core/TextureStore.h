// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureStore_h
#define po_TextureStore_h

#include "BakeSettings.h"
#include "ProcessGroup.h"
#include "TextureTable.h"

#include <cstdint>
#include <vector>

namespace po
{
/// Brings the textures of a bake into the form that the settings ask for.
///
/// @param rowOf the row of each particle, changed to the rows of the result; negative ones stay
/// @param maximum the scale of UInt8Gamma2, the same on all processes
/// @param noise RMS error of the bake, or less; 0 if it is not known. Of all processes the RMS
/// counts, rounded down to 0.001, so that the order of sums does not matter.
/// Throws WorkStopped.
[[nodiscard]] EncodedTable storeTextures(TextureTable&& table, const BakeSettings& settings,
  double maximum, double noise, const ProcessGroup& group, std::vector<std::int32_t>& rowOf);
}

#endif
