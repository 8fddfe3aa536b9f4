// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_LoggedRims_h
#define po_LoggedRims_h

#include "ScratchFile.h"
#include "TexelRims.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// What cuts the particles of a list, in a temporary file, while their textures are made: a part of
/// the list is in memory at a time. Throws what ScratchFile throws.
class LoggedRims
{
public:
  /// @param groups of the masks
  LoggedRims(std::size_t groups, std::size_t placesPerPart)
    : groups_(groups)
    , placesPerPart_(placesPerPart)
  {
  }

  /// Those of the next particle of the list.
  /// @param rims null: none
  void append(const TexelRims* rims);

  /// Reads a part of the list, of which all was appended.
  void load(std::size_t part);

  /// Of a place in that part: null where there are none. Good until another part is loaded.
  [[nodiscard]] const TexelRims* find(std::size_t place) const
  {
    return rims_[place].outside != nullptr ? &rims_[place] : nullptr;
  }

private:
  /// Of a part, in the file.
  struct Extent
  {
    std::uint64_t position;
    std::size_t words;
  };

  void writePart();

  std::size_t groups_;
  std::size_t placesPerPart_;
  std::size_t waiting_ = 0; ///< places whose words are not in the file
  std::vector<std::uint32_t> words_;
  std::vector<Extent> parts_;
  std::vector<TexelRims> rims_; ///< by place in the part
  ScratchFile file_;
};
}

#endif
