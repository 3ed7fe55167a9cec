#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "devices/haply/wire/service_address.h"
#include "devices/haply/wire/service_state.h"

namespace icome::devices {

/// The service's events about one Inverse3, read on a thread of its own, as they come seldom and nobody shall
/// wait for them. Without their channel there are none; it is looked for now and then. Owns the thread.
class ServiceEvents {
 public:
  /// Begins to listen to events about the device of that id.
  ServiceEvents(ServiceAddress channel, std::string device_id);
  ~ServiceEvents();
  ServiceEvents(const ServiceEvents&) = delete;
  ServiceEvents& operator=(const ServiceEvents&) = delete;

  /// A number that changes with the sentence. Any thread; real-time safe.
  std::uint64_t version() const { return version_.load(std::memory_order_acquire); }
  /// The sentence that people should know now; empty: none. Any thread.
  std::string sentence() const;
  /// Has the device stopped for safety, without a word since that this is over? Any thread; real-time safe.
  bool is_safety_stop() const { return is_safety_stop_.load(std::memory_order_acquire); }
  /// The reason of that stop, and what to do; valid after is_safety_stop(). Any thread.
  std::string safety_stop() const;
  /// The stop is over, as the device was switched off and on. Any thread; real-time safe.
  void forget_safety_stop() { is_safety_stop_.store(false, std::memory_order_release); }
  /// Number of times that the device was said to be disconnected. Any thread; real-time safe.
  std::uint64_t disconnections() const { return disconnections_.load(std::memory_order_acquire); }

 private:
  void listen();
  void hear_out();
  void take(const ServiceEvent& event);
  void say(std::string sentence);
  void stop_for_safety(const ServiceEvent& event);
  bool concerns_device(const ServiceEvent& event) const;

  const ServiceAddress channel_;
  const std::string device_id_;
  std::atomic<bool> stop_ = false;
  std::atomic<std::uint64_t> version_ = 0;
  std::atomic<std::uint64_t> disconnections_ = 0;
  std::atomic<bool> is_safety_stop_ = false;
  mutable std::mutex guard_;
  std::string sentence_;
  std::string safety_stop_;
  std::thread thread_;
};

}  // namespace icome::devices
