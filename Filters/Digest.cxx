// SPDX-License-Identifier: BSD-3-Clause
#include "Digest.h"

#include <tbb/parallel_for.h>
#include <vtksys/MD5.h>

#include <algorithm>
#include <array>

namespace po
{
namespace
{
using Block = std::array<unsigned char, 16>;

/// Large enough that threads have something to do, and within MD5's int.
constexpr std::size_t BlockBytes = std::size_t(1) << 20;

const unsigned char* bytesOf(const void* data)
{
  return static_cast<const unsigned char*>(data);
}

Block digestOfBlock(const unsigned char* data, std::size_t bytes)
{
  Block block;
  vtksysMD5* state = vtksysMD5_New();
  vtksysMD5_Initialize(state);
  vtksysMD5_Append(state, data, static_cast<int>(bytes));
  vtksysMD5_Finalize(state, block.data());
  vtksysMD5_Delete(state);
  return block;
}
}

void Digest::Deleter::operator()(vtksysMD5_s* state) const
{
  vtksysMD5_Delete(state);
}

Digest::Digest()
  : state_(vtksysMD5_New())
{
  vtksysMD5_Initialize(state_.get());
}

Digest::~Digest() = default;

void Digest::add(const void* data, std::size_t bytes)
{
  if (bytes <= BlockBytes)
  {
    vtksysMD5_Append(state_.get(), bytesOf(data), static_cast<int>(bytes));
    return;
  }
  std::vector<Block> blocks((bytes + BlockBytes - 1) / BlockBytes);
  tbb::parallel_for(std::size_t(0), blocks.size(),
    [&](std::size_t i)
    {
      const std::size_t first = i * BlockBytes;
      blocks[i] = digestOfBlock(bytesOf(data) + first, std::min(BlockBytes, bytes - first));
    });
  add(blocks.data(), blocks.size() * sizeof(Block));
}

std::string Digest::text()
{
  std::string digits(32, '0');
  vtksysMD5_FinalizeHex(state_.get(), digits.data());
  return digits;
}
}
