#pragma once
// What the fuzz tests do to the bytes of a good file.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/random.h"

namespace icome::files {

/// `words`: what parsers of the format stumble over.
inline void damage_once(std::string& bytes, std::span<const std::string_view> words, base::Random& random) {
  if (bytes.empty()) return;
  const std::size_t at = random.index(bytes.size());
  switch (random.index(7)) {
    case 0:
      bytes[at] = static_cast<char>(random.bits());
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.index(8)));
      break;
    case 2:
      bytes[at] = "0123456789"[random.index(10)];
      break;
    case 3:
      if (random.index(2) == 0) bytes.resize(at);
      break;
    case 4:
      bytes.erase(at, 1 + random.index(8));
      break;
    case 5:
      bytes.insert(at, bytes.substr(random.index(bytes.size()), random.index(80)));
      break;
    default:
      bytes.insert(at, words[random.index(words.size())]);
  }
}

inline std::string damaged(std::string bytes, std::span<const std::string_view> words, base::Random& random) {
  const std::uint64_t times = 1 + random.index(4);
  for (std::uint64_t i = 0; i < times; ++i) damage_once(bytes, words, random);
  return bytes;
}

}  // namespace icome::files
