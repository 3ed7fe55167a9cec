#pragma once
// Bytes as a hostile or broken peer might send them, and how many of them tests try.
#include <cstdlib>
#include <string>

#include "base/random.h"
#include "repeats.h"

namespace icome::collab {

/// As many as the environment variable ICOME_MUTATIONS says, also under sanitizers; else `usual`, fewer
/// there.
inline int mutations(int usual) {
  const char* const count = std::getenv("ICOME_MUTATIONS");
  return count != nullptr ? std::atoi(count) : repeats(usual);
}

/// The bytes with one to five of them changed, and sometimes cut off.
inline std::string mutated(std::string bytes, base::Random& random) {
  if (bytes.empty()) return bytes;
  for (std::uint64_t change = 0; change <= random.index(4); ++change) {
    const std::size_t at = random.index(bytes.size());
    bytes[at] = random.index(2) == 0 ? char(random.bits()) : char(bytes[at] ^ (1 << random.index(8)));
  }
  if (random.index(4) == 0) bytes.resize(random.index(bytes.size()));
  return bytes;
}

}  // namespace icome::collab
