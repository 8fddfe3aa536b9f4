// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeEntry_h
#define po_BakeEntry_h

#include "BakeMethods.h"

#include <string>

// One result of a bake in a file: what BakeCache keeps.
//
// Bytes as they are in memory, after a line that names the format, the key, and a digest of what
// follows. EXR texture files would do, but take 40 us a texture to write where a bake may take 8:
// they are for keeping and exchange, entries for being fast.
namespace po
{
/// Size of the file that writeEntry makes, within 1 KiB.
[[nodiscard]] double bytesOfEntry(const BakeResult& result);

/// Writes the table, rows and means, and of the report what bakeByMethod fills. The file appears
/// when it is complete. Throws a std::runtime_error that names it.
void writeEntry(const std::string& fileName, const std::string& key, const BakeResult& result,
  const BakeReport& report);

/// The inverse. Throws a std::runtime_error that names the file if it is not such an entry,
/// damaged, of another key, or not of so many particles; nothing is changed then.
void readEntry(const std::string& fileName, const std::string& key, std::size_t particles,
  BakeResult& result, BakeReport& report);
}

#endif
