// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Digest_h
#define po_Digest_h

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

struct vtksysMD5_s;

namespace po
{
/// 128 bits that stand for what was added, made of MD5. They tell data sets apart and find damage;
/// they are no protection against forgery.
///
/// Large arrays are cut into blocks, whose own digests are found in parallel and added: the result
/// does not depend on the number of threads, but on what was added in one call.
class Digest
{
public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  void add(const void* data, std::size_t bytes);

  /// The bytes of an array, after its length.
  template <typename Element>
  void add(const std::vector<Element>& elements)
  {
    const std::size_t count = elements.size();
    add(&count, sizeof(count));
    add(elements.data(), count * sizeof(Element));
  }

  /// 32 hexadecimal digits of all that was added; nothing can be added any more.
  [[nodiscard]] std::string text();

private:
  struct Deleter
  {
    void operator()(vtksysMD5_s* state) const;
  };
  std::unique_ptr<vtksysMD5_s, Deleter> state_;
};
}

#endif
