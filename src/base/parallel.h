#pragma once
#include <algorithm>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace icome::base {

/// Calls `body(begin, end)` on consecutive parts of [0, count), one thread a part, and waits for all.
/// Fewer than `grain` items stay on the calling thread, as do parts that the system gives no thread for. An
/// exception of a part is rethrown here when all have ended: the first part's, if several throw. The split
/// never changes results: parts are independent. Not for the servo (it starts threads).
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, Body&& body) {
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t parts =
      std::min(cores, std::max<std::size_t>(1, count / std::max<std::size_t>(1, grain)));
  if (parts == 1) {
    body(std::size_t{0}, count);
    return;
  }
  std::vector<std::exception_ptr> failures(parts);
  const auto work = [&](std::size_t part) {
    try {
      body(count * part / parts, count * (part + 1) / parts);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(parts - 1);
  std::size_t part = 1;
  try {
    for (; part < parts; ++part) others.emplace_back(work, part);
  } catch (...) {
    for (; part < parts; ++part) work(part);
  }
  work(0);
  for (std::thread& thread : others) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace icome::base
