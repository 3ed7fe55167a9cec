#pragma once
#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace icome::base {

/// Calls `body(begin, end)` on consecutive parts of [0, count), one thread a part, and waits for all.
/// Fewer than `grain` items stay on the calling thread. The split never changes results: parts are
/// independent. Not for the servo (it starts threads).
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, Body&& body) {
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t parts =
      std::min(cores, std::max<std::size_t>(1, count / std::max<std::size_t>(1, grain)));
  const auto edge = [&](std::size_t part) { return count * part / parts; };
  std::vector<std::thread> others;
  others.reserve(parts - 1);
  for (std::size_t part = 1; part < parts; ++part) {
    others.emplace_back([&body, begin = edge(part), end = edge(part + 1)] { body(begin, end); });
  }
  body(std::size_t{0}, edge(1));
  for (std::thread& thread : others) thread.join();
}

}  // namespace icome::base
