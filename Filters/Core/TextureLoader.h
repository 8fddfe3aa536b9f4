// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureLoader_h
#define po_TextureLoader_h

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace po
{
/// Textures that are kept elsewhere, in a file for instance.
class TextureSource
{
public:
  virtual ~TextureSource() = default;

  /// Stores the texels of a texture in the form that its user expects. Called on one thread at a
  /// time, which may be another than the one that made the object. Throws a std::exception whose
  /// text is for users.
  virtual void read(std::int32_t row, void* texels) const = 0;
};

/// A texture to read, and where to.
struct TextureLoad
{
  std::int32_t row;
  void* texels;
};

/// Reads textures on a thread of its own, one after the other. The first failure is the last read.
class TextureLoader
{
public:
  /// @param textureBytes what the source stores for each texture, in bytes
  /// Throws std::system_error where no thread can be started.
  TextureLoader(std::shared_ptr<const TextureSource> source, std::size_t textureBytes);

  /// Waits for the one texture that is being read.
  ~TextureLoader();
  TextureLoader(const TextureLoader&) = delete;
  TextureLoader& operator=(const TextureLoader&) = delete;

  /// Behind those that are waiting. The texels belong to the loader until the load comes back from
  /// takeLoaded() or cancel(), or the loader has failed.
  void add(const std::vector<TextureLoad>& loads);

  /// Takes back the loads that are not completed; none has written to its texels.
  [[nodiscard]] std::vector<TextureLoad> cancel();

  /// The loads that were completed since the last call.
  [[nodiscard]] std::vector<TextureLoad> takeLoaded();

  /// Until all loads are completed or one has failed.
  void wait() const;

  /// Is there anything to take, or has a load failed?
  [[nodiscard]] bool hasNews() const;

  /// Why nothing more is read; empty while all is well. What waited then never comes.
  [[nodiscard]] std::string error() const;

private:
  void run();
  void readNext(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] std::string read(std::int32_t row);

  const std::shared_ptr<const TextureSource> source_;
  std::vector<std::byte> texels_; ///< of the thread: of the texture that is being read
  mutable std::mutex mutex_;      ///< of all below
  mutable std::condition_variable changed_;
  std::deque<TextureLoad> waiting_;
  std::vector<TextureLoad> loaded_;
  std::string error_;
  std::optional<TextureLoad> reading_;
  bool isReading_ = false; ///< also when what is being read was cancelled
  bool isEnding_ = false;
  std::thread thread_; ///< the last member: it uses the others
};
}

#endif
