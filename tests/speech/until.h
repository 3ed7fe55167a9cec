#pragma once
#include <chrono>
#include <thread>

namespace icome::speech {

/// Waits until something has come about on another thread, for half a minute at most.
template <typename Come>
bool until(const Come& come) {
  const auto begun = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begun < std::chrono::seconds(30)) {
    if (come()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace icome::speech
