// SPDX-License-Identifier: BSD-3-Clause
#include "BakeEntry.h"

#include "AtomicFile.h"
#include "Digest.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace po
{
namespace
{
const std::string FormatLine = "ParticleOcclusion bake 3\n";
constexpr std::size_t DigestCharacters = 32;

/// The format, the key and the digest of the rest, a line each.
std::string headOf(const std::string& key, const std::string& digest)
{
  return FormatLine + key + '\n' + digest + '\n';
}

/// Writes what visit() goes through.
class EntryWriter
{
public:
  explicit EntryWriter(AtomicFile& file)
    : file_(file)
  {
  }

  void bytes(const void* data, std::size_t count)
  {
    file_.write(static_cast<const char*>(data), static_cast<std::streamsize>(count));
    digest_.add(data, count);
  }

  template <typename Element>
  void array(const std::vector<Element>& elements)
  {
    const std::uint64_t count = elements.size();
    bytes(&count, sizeof(count));
    bytes(elements.data(), elements.size() * sizeof(Element));
  }

  template <typename Element>
  void arrays(const std::vector<std::vector<Element>>& list)
  {
    const std::uint64_t count = list.size();
    bytes(&count, sizeof(count));
    for (const std::vector<Element>& elements : list)
    {
      array(elements);
    }
  }

  [[nodiscard]] std::string digest() { return digest_.text(); }

private:
  AtomicFile& file_;
  Digest digest_;
};

/// Reads what EntryWriter has written. Nothing larger than the file is allocated.
class EntryReader
{
public:
  EntryReader(std::istream& stream, std::uintmax_t size)
    : stream_(stream)
    , left_(size)
  {
  }

  void bytes(void* data, std::size_t count)
  {
    require(count);
    stream_.read(static_cast<char*>(data), static_cast<std::streamsize>(count));
    if (stream_.gcount() != static_cast<std::streamsize>(count))
    {
      throw std::runtime_error("it cannot be read to its end");
    }
    left_ -= count;
    digest_.add(data, count);
  }

  template <typename Element>
  void array(std::vector<Element>& elements)
  {
    std::uint64_t count = 0;
    bytes(&count, sizeof(count));
    if (count > left_ / sizeof(Element))
    {
      throw std::runtime_error("it is too short for what it announces");
    }
    elements.resize(static_cast<std::size_t>(count));
    bytes(elements.data(), elements.size() * sizeof(Element));
  }

  template <typename Element>
  void arrays(std::vector<std::vector<Element>>& list)
  {
    std::uint64_t count = 0;
    bytes(&count, sizeof(count));
    require(count); // an array takes more than a byte
    list.resize(static_cast<std::size_t>(count));
    for (std::vector<Element>& elements : list)
    {
      array(elements);
    }
  }

  [[nodiscard]] std::string digest() { return digest_.text(); }

private:
  void require(std::size_t count) const
  {
    if (count > left_)
    {
      throw std::runtime_error("it is too short");
    }
  }

  std::istream& stream_;
  std::uintmax_t left_;
  Digest digest_;
};

// What an entry holds, for writing and reading alike. Members are taken apart by structured
// bindings, so that none that is added later is forgotten.

template <typename Archive, typename... Numbers>
void visitNumbers(Archive& archive, Numbers&... numbers)
{
  static_assert(((std::is_arithmetic_v<Numbers> || std::is_enum_v<Numbers>)&&...));
  (archive.bytes(&numbers, sizeof(numbers)), ...);
}

template <typename Archive, typename Counters>
void visitCounters(Archive& archive, Counters& counters)
{
  auto& [particles, texels, rays, samplesInside, texelsInside, particlesBuried, particlesAlone,
    particlesDark, texturesStored, spheresClosed, spheresNeverSeen, directionsBlack, threads] =
    counters;
  visitNumbers(archive, particles, texels, rays, samplesInside, texelsInside, particlesBuried,
    particlesAlone, particlesDark, texturesStored, spheresClosed, spheresNeverSeen, directionsBlack,
    threads);
}

template <typename Archive, typename Format>
void visitFormat(Archive& archive, Format& format)
{
  auto& [resolution, maximum, basis, classBits] = format;
  auto& [basisResolution, scale, numbers] = basis;
  visitNumbers(archive, resolution, maximum, basisResolution, scale);
  archive.array(numbers);
  archive.arrays(classBits);
}

template <typename Archive, typename Table>
void visitTable(Archive& archive, Table& table)
{
  auto& [storage, encoding, resolution, rows, textures, maximum, bytes, floats, packed, difference,
    comparedArea] = table;
  visitNumbers(
    archive, storage, encoding, resolution, rows, textures, maximum, difference, comparedArea);
  archive.array(bytes);
  archive.array(floats);
  visitFormat(archive, packed);
}

template <typename Archive, typename Result, typename Report>
void visitEntry(Archive& archive, Result& result, Report& report)
{
  // The report has the counters of all processes; an aborted result is not kept.
  auto& [table, rowOf, mean, ownCounters, aborted] = result;
  visitTable(archive, table);
  archive.array(rowOf);
  archive.array(mean);
  // The numbers of the input are known without a bake.
  auto& [counters, method, directions, samplesUsed, estimatedError, storageDifference, maximum,
    refined, reused, leftOut, textureBytes, occluderSpheres, occluderTriangles, loaded] = report;
  visitCounters(archive, counters);
  visitNumbers(archive, method, directions, samplesUsed, estimatedError, storageDifference, maximum,
    refined, reused);
}

std::string readHead(std::istream& stream, const std::string& key)
{
  const std::size_t length = headOf(key, std::string(DigestCharacters, '0')).size();
  std::string head(length, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(length));
  if (!stream || head.compare(0, FormatLine.size(), FormatLine) != 0)
  {
    throw std::runtime_error("it is no entry of this version");
  }
  const std::string digest = head.substr(length - 1 - DigestCharacters, DigestCharacters);
  if (head != headOf(key, digest))
  {
    throw std::runtime_error("it is of other particles or parameters");
  }
  return digest;
}

void readChecked(const std::string& fileName, const std::string& key, std::size_t particles,
  BakeResult& result, BakeReport& report)
{
  std::ifstream stream(fileName, std::ios::binary);
  if (!stream)
  {
    throw std::runtime_error("it cannot be opened");
  }
  const std::string digest = readHead(stream, key);
  EntryReader reader(stream, std::filesystem::file_size(fileName));
  visitEntry(reader, result, report);
  if (reader.digest() != digest || stream.get() != std::istream::traits_type::eof())
  {
    throw std::runtime_error("it is damaged");
  }
  if (result.rowOf.size() != particles || result.mean.size() != particles)
  {
    throw std::runtime_error("it is of another number of particles");
  }
}
}

double bytesOfEntry(const BakeResult& result)
{
  return static_cast<double>(result.table.size()) +
    static_cast<double>(sizeof(std::int32_t) + sizeof(float)) *
    static_cast<double>(result.rowOf.size());
}

void writeEntry(const std::string& fileName, const std::string& key, const BakeResult& result,
  const BakeReport& report)
{
  AtomicFile file(fileName);
  const auto writeHead = [&](const std::string& digest)
  {
    const std::string head = headOf(key, digest);
    file.seek(0);
    file.write(head.data(), static_cast<std::streamsize>(head.size()));
  };
  writeHead(std::string(DigestCharacters, '0'));
  EntryWriter writer(file);
  visitEntry(writer, result, report);
  writeHead(writer.digest());
  file.commit();
}

void readEntry(const std::string& fileName, const std::string& key, std::size_t particles,
  BakeResult& result, BakeReport& report)
{
  BakeResult read;
  BakeReport readReport = report;
  try
  {
    readChecked(fileName, key, particles, read, readReport);
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("The cache entry \"" + fileName + "\" is not used, since " +
      error.what() + "; it will be replaced.");
  }
  result = std::move(read);
  report = readReport;
}
}
