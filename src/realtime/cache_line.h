#pragma once
#include <cstddef>

namespace icome::realtime {

/// Bytes that processors hand to each other as one piece. Data that different threads write lies this far
/// apart, or each write would take the other's line away. (64 on x86-64 and on common ARM; the
/// standard's own constant changes with compiler flags and so cannot stand in a header.)
inline constexpr std::size_t kCacheLine = 64;

}  // namespace icome::realtime
