#pragma once
// How often tests repeat what they try at random: less often where sanitizers slow the code.
#include <algorithm>

namespace icome {

#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
inline constexpr int kSanitizerShare = 20;  // sanitizers slow the code by about this much
#else
inline constexpr int kSanitizerShare = 1;
#endif

/// A number of repetitions, fewer where a sanitizer makes each slow.
constexpr int repeats(int count) { return std::max(1, count / kSanitizerShare); }

}  // namespace icome
