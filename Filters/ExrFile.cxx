// SPDX-License-Identifier: BSD-3-Clause
#include "ExrFile.h"

#include <Iex.h>
#include <openexr.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>

namespace fs = std::filesystem;

namespace po
{
namespace
{
std::uintmax_t sizeOfRegularFile(const std::string& fileName)
{
  std::error_code error;
  const fs::file_status status = fs::status(fileName, error);
  if (!fs::exists(status))
  {
    refuseExr(fileName, "there is no such file; check the name.");
  }
  if (!fs::is_regular_file(status))
  {
    refuseExr(fileName, "it is not a file; choose an OpenEXR file (.exr).");
  }
  const std::uintmax_t size = fs::file_size(fileName, error);
  if (error)
  {
    refuseExr(fileName, error.message() + ".");
  }
  return size;
}

void requireMagicNumber(const std::string& fileName)
{
  // First four bytes of every OpenEXR file (OpenEXR file layout, "magic number").
  constexpr std::array<char, 4> Magic = { 0x76, 0x2f, 0x31, 0x01 };
  std::array<char, 4> bytes = {};
  std::ifstream stream(fileName, std::ios::binary);
  if (!stream)
  {
    refuseExr(fileName, "it cannot be opened; check its permissions.");
  }
  stream.read(bytes.data(), bytes.size());
  if (stream.gcount() != static_cast<std::streamsize>(bytes.size()) || bytes != Magic)
  {
    refuseExr(fileName, "it is not an OpenEXR file; convert the image to .exr first.");
  }
}

/// The C reader prints its errors unless given a handler; the last one says what was wrong.
void keepMessage(exr_const_context_t context, exr_result_t, const char* message)
{
  void* kept = nullptr;
  if (exr_get_user_data(context, &kept) == EXR_ERR_SUCCESS && kept)
  {
    auto& text = *static_cast<std::string*>(kept);
    text = message;
    // Names from a damaged file may hold anything.
    std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  }
}

struct ContextCloser
{
  void operator()(exr_context_t context) const { exr_finish(&context); }
};
using ContextPointer = std::unique_ptr<std::remove_pointer_t<exr_context_t>, ContextCloser>;

/// `message` must outlive the result.
ContextPointer openHeaders(
  const std::string& fileName, const ExrLimits& limits, std::string& message)
{
  exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
  options.error_handler_fn = keepMessage;
  options.user_data = &message;
  // Otherwise it makes up for what is damaged, and the C++ reader meets that.
  options.flags = EXR_CONTEXT_FLAG_STRICT_HEADER;
  options.max_image_width = limits.width;
  options.max_image_height = limits.height;
  options.max_tile_width = limits.tileSide;
  options.max_tile_height = limits.tileSide;
  exr_context_t context = nullptr;
  const exr_result_t result = exr_start_read(&context, fileName.c_str(), &options);
  ContextPointer opened(result == EXR_ERR_SUCCESS ? context : nullptr);
  // An attribute that is damaged is reported but does not make the C reader fail.
  if (!opened || !message.empty())
  {
    refuseExr(fileName,
      "its header is damaged or asks for more than is allowed (" +
        (message.empty() ? exr_get_default_error_message(result) : message) +
        "); write the file again.");
  }
  return opened;
}

void checkPart(const std::string& fileName, exr_context_t context, int part,
  const ExrLimits& limits, std::uintmax_t fileSize)
{
  exr_attr_box2i_t window = {};
  std::int32_t chunks = 0;
  if (exr_get_data_window(context, part, &window) != EXR_ERR_SUCCESS ||
    exr_get_chunk_count(context, part, &chunks) != EXR_ERR_SUCCESS)
  {
    refuseExr(fileName, "its header lacks the size of the image; write the file again.");
  }
  const std::int64_t width = std::int64_t{ window.max.x } - window.min.x + 1;
  const std::int64_t height = std::int64_t{ window.max.y } - window.min.y + 1;
  if (width < 1 || height < 1)
  {
    refuseExr(fileName, "its data window is empty; write the file again with pixels.");
  }
  if (width > limits.width || height > limits.height || width > limits.pixels / height)
  {
    refuseExr(fileName,
      "it has " + std::to_string(width) + " x " + std::to_string(height) +
        " pixels, more than is allowed (" + std::to_string(limits.pixels) +
        "); scale the image down.");
  }
  // Every chunk has an offset of 8 bytes in the file.
  if (chunks < 1 || static_cast<std::uintmax_t>(chunks) > fileSize / 8)
  {
    refuseExr(fileName,
      "it is too short (" + std::to_string(fileSize) + " bytes) for its " + std::to_string(width) +
        " x " + std::to_string(height) +
        " pixels; it is damaged or incomplete, copy or write it again.");
  }
}

class AtomicExrStream : public OPENEXR_IMF_NAMESPACE::OStream
{
public:
  AtomicExrStream(AtomicFile& file, const std::string& fileName)
    : OStream(fileName.c_str())
    , file_(file)
  {
  }
  void write(const char bytes[], int count) override { file_.write(bytes, count); }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(file_.position()); }
  void seekp(std::uint64_t position) override { file_.seek(static_cast<std::streamoff>(position)); }

private:
  AtomicFile& file_;
};
}

void refuseExr(const std::string& fileName, const std::string& reason)
{
  throw ExrError("Cannot read \"" + fileName + "\": " + reason);
}

void checkExrFile(const std::string& fileName, const ExrLimits& limits)
{
  const std::uintmax_t fileSize = sizeOfRegularFile(fileName);
  requireMagicNumber(fileName);
  std::string message;
  const ContextPointer context = openHeaders(fileName, limits, message);
  int parts = 0;
  exr_get_count(context.get(), &parts);
  for (int part = 0; part < parts; ++part)
  {
    checkPart(fileName, context.get(), part, limits, fileSize);
  }
}

void withExrReadErrors(const std::string& fileName, const std::function<void()>& read)
{
  std::string reason;
  try
  {
    read();
    return;
  }
  catch (const std::bad_alloc&)
  {
    reason = "there is not enough memory for it; close other data or scale it down.";
  }
  catch (const ExrError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    reason =
      std::string("it is damaged or incomplete (") + error.what() + "); copy or write it again.";
  }
  refuseExr(fileName, reason);
}

void writeExrFile(
  const std::string& fileName, const std::function<void(OPENEXR_IMF_NAMESPACE::OStream&)>& write)
{
  AtomicFile file(fileName);
  AtomicExrStream stream(file, fileName);
  try
  {
    write(stream);
  }
  catch (const Iex::BaseExc& error)
  {
    throw ExrError("Cannot write \"" + fileName + "\": " + error.what() + ".");
  }
  file.commit();
}
}
