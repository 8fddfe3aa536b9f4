// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ExrTestSupport_h
#define po_ExrTestSupport_h

#include "TemporaryFolder.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#endif

using Bytes = std::vector<char>;

inline Bytes readBytes(const std::string& fileName)
{
  std::ifstream stream(fileName, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(stream), {});
}

inline void writeBytes(const std::string& fileName, const Bytes& bytes)
{
  std::ofstream(fileName, std::ios::binary).write(bytes.data(), bytes.size());
}

/// Collects the errors and warnings of an object instead of printing them.
class Messages
{
public:
  explicit Messages(vtkObject* object)
  {
    error_->SetClientData(&errors);
    error_->SetCallback(Messages::keep);
    warning_->SetClientData(&warnings);
    warning_->SetCallback(Messages::keep);
    object->AddObserver(vtkCommand::ErrorEvent, error_);
    object->AddObserver(vtkCommand::WarningEvent, warning_);
  }

  std::vector<std::string> errors;
  std::vector<std::string> warnings;

private:
  static void keep(vtkObject*, unsigned long, void* list, void* text)
  {
    static_cast<std::vector<std::string>*>(list)->push_back(static_cast<const char*>(text));
  }
  vtkNew<vtkCallbackCommand> error_;
  vtkNew<vtkCallbackCommand> warning_;
};

inline ::testing::AssertionResult oneMessage(
  const std::vector<std::string>& messages, const std::string& part)
{
  if (messages.size() == 1 && messages[0].find(part) != std::string::npos)
  {
    return ::testing::AssertionSuccess();
  }
  auto failure = ::testing::AssertionFailure()
    << "expected one message with \"" << part << "\", got " << messages.size();
  for (const std::string& message : messages)
  {
    failure << '\n' << message;
  }
  return failure;
}

/// What `act` throws, or an empty string.
template <typename Act>
std::string whatIsThrown(const Act& act)
{
  try
  {
    act();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return {};
}

#define EXPECT_HAS(text, part) EXPECT_PRED_FORMAT2(has, text, part)

inline ::testing::AssertionResult has(
  const char*, const char*, const std::string& text, const std::string& part)
{
  if (text.find(part) != std::string::npos)
  {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "\"" << text << "\" lacks \"" << part << "\"";
}

/// Damaged copies of a file: truncated at `count` lengths, and with 1 to 8 bytes changed at `count`
/// random places, half of them in the first kilobyte, where the header is.
template <typename Try>
void forEachDamage(const Bytes& whole, int count, const Try& attempt)
{
  std::mt19937 random(20260101);
  const auto below = [&](std::size_t limit)
  { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random); };
  for (int i = 0; i < count; ++i)
  {
    attempt(Bytes(whole.begin(), whole.begin() + whole.size() * i / count));
    Bytes changed = whole;
    const std::size_t changes = 1 + below(8);
    const std::size_t range = i % 2 ? whole.size() : std::min<std::size_t>(1024, whole.size());
    for (std::size_t change = 0; change < changes; ++change)
    {
      changed[below(range)] = static_cast<char>(below(256));
    }
    attempt(changed);
  }
}

#ifdef __linux__
/// The most memory that this process ever had, in megabytes.
inline long peakMegabytes()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}
#else
inline long peakMegabytes()
{
  return 0;
}
#endif

#ifndef _WIN32
/// While alive, no file of this process can grow beyond `bytes`, as on a full disk.
class FileSizeLimit
{
public:
  explicit FileSizeLimit(rlim_t bytes)
    : handler_(std::signal(SIGXFSZ, SIG_IGN))
  {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = { bytes, before_.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

private:
  rlimit before_ = {};
  void (*handler_)(int);
};
#endif

#endif
