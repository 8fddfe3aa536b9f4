// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ExrFile_h
#define po_ExrFile_h

#include "AtomicFile.h"

#include <ImfIO.h>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

// What all OpenEXR input and output of this module shares. Internal to the module: includes
// OpenEXR.
namespace po
{
/// Says everything the user needs to know; passes through this module unchanged.
struct ExrError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Throws the ExrError `Cannot read "<file>": <reason>`.
[[noreturn]] void refuseExr(const std::string& fileName, const std::string& reason);

/// Sizes above which a file is refused before anything is allocated for it.
struct ExrLimits
{
  int width = 0;           ///< widest data window, in pixels
  int height = 0;          ///< highest data window, in pixels
  int tileSide = 0;        ///< largest side of a tile, in pixels
  std::int64_t pixels = 0; ///< largest data window, in pixels
};

/// Refuses, with an ExrError, what must not reach OpenEXR's C++ reader:
/// missing, empty and foreign files, headers that are damaged, sizes beyond the limits, and files
/// too short to hold even the offsets of the pixels that they announce.
///
/// OpenEXR's C++ reader believes the sizes in a header and allocates accordingly; its C reader
/// compares them with the size of the file, and takes limits per file rather than per process.
void checkExrFile(const std::string& fileName, const ExrLimits& limits);

/// Runs `read`; what OpenEXR throws becomes one ExrError that names the file.
void withExrReadErrors(const std::string& fileName, const std::function<void()>& read);

/// Runs `write` on a stream beside the target and renames on success (see AtomicFile). `write` must
/// have destroyed OpenEXR's objects when it returns: they write their offset tables in destructors.
void writeExrFile(
  const std::string& fileName, const std::function<void(OPENEXR_IMF_NAMESPACE::OStream&)>& write);
}

#endif
