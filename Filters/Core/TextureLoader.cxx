// SPDX-License-Identifier: BSD-3-Clause
#include "TextureLoader.h"

#include <cstring>
#include <exception>
#include <utility>

namespace po
{
TextureLoader::TextureLoader(std::shared_ptr<const TextureSource> source, std::size_t textureBytes)
  : source_(std::move(source))
  , texels_(textureBytes)
  , thread_([this] { run(); })
{
}

TextureLoader::~TextureLoader()
{
  {
    const std::lock_guard lock(mutex_);
    isEnding_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void TextureLoader::add(const std::vector<TextureLoad>& loads)
{
  {
    const std::lock_guard lock(mutex_);
    if (error_.empty())
    {
      waiting_.insert(waiting_.end(), loads.begin(), loads.end());
    }
  }
  changed_.notify_all();
}

std::vector<TextureLoad> TextureLoader::cancel()
{
  const std::lock_guard lock(mutex_);
  std::vector<TextureLoad> cancelled(waiting_.begin(), waiting_.end());
  waiting_.clear();
  if (reading_)
  {
    cancelled.push_back(*reading_);
    reading_.reset();
  }
  return cancelled;
}

std::vector<TextureLoad> TextureLoader::takeLoaded()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(loaded_, {});
}

void TextureLoader::wait() const
{
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty() && !isReading_; });
}

bool TextureLoader::hasNews() const
{
  const std::lock_guard lock(mutex_);
  return !loaded_.empty() || !error_.empty();
}

std::string TextureLoader::error() const
{
  const std::lock_guard lock(mutex_);
  return error_;
}

void TextureLoader::run()
{
  std::unique_lock lock(mutex_);
  while (!isEnding_)
  {
    if (waiting_.empty())
    {
      changed_.wait(lock);
    }
    else
    {
      readNext(lock);
    }
  }
}

/// Nobody waits for the mutex while the texture is read.
void TextureLoader::readNext(std::unique_lock<std::mutex>& lock)
{
  const std::int32_t row = waiting_.front().row;
  reading_ = waiting_.front();
  waiting_.pop_front();
  isReading_ = true;
  lock.unlock();
  const std::string error = read(row);
  lock.lock();
  isReading_ = false;
  if (!error.empty())
  {
    error_ = error;
    waiting_.clear();
  }
  else if (reading_)
  {
    std::memcpy(reading_->texels, texels_.data(), texels_.size());
    loaded_.push_back(*reading_);
  }
  reading_.reset();
  if (waiting_.empty())
  {
    changed_.notify_all();
  }
}

/// @return what went wrong, or nothing
std::string TextureLoader::read(std::int32_t row)
{
  try
  {
    source_->read(row, texels_.data());
    return {};
  }
  catch (const std::exception& fault)
  {
    return fault.what();
  }
}
}
