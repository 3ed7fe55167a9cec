#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>

#include "base/parallel.h"

namespace icome::geometry {

/// Receives the part of a stage that is done, in [0, 1]; returns whether to go on.
using ContourProgress = std::function<bool(double part)>;

/// Progress of a part of the stage: from `begin` on, `share` of it.
inline ContourProgress contour_share(const ContourProgress& stage, double begin, double share) {
  return [&stage, begin, share](double part) { return stage(begin + share * part); };
}

/// Calls `body(begin, end)` on parts of [0, count) in parallel, and `go_on` on this thread now and then.
/// False when that stopped it.
template <typename Body>
bool contour_in_batches(std::size_t count, const ContourProgress& go_on, const Body& body) {
  constexpr std::size_t kBatch = 1 << 16, kGrain = 256;
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    if (!go_on(static_cast<double>(begin) / static_cast<double>(count))) return false;
    base::parallel_for(std::min(kBatch, count - begin), kGrain,
                       [&](std::size_t from, std::size_t to) { body(begin + from, begin + to); });
  }
  return true;
}

}  // namespace icome::geometry
