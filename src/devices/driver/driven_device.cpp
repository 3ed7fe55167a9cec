#include "devices/driver/driven_device.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "base/clock.h"
#include "realtime/this_thread.h"

namespace icome::devices {

base::Result<std::unique_ptr<DrivenDevice>> DrivenDevice::create(std::unique_ptr<Driver> driver,
                                                                 const DrivenSettings& settings) {
  auto info = driver->open();
  if (!info) return tl::unexpected(info.error());
  std::unique_ptr<DrivenDevice> device(new DrivenDevice(std::move(driver), std::move(*info), settings));
  try {
    device->thread_ = std::thread([it = device.get()] { it->run(); });
  } catch (const std::system_error& error) {
    device->driver_->close();
    return base::fail(device->info_.name + ": the system gives no thread for it (" + error.what() +
                      "); close other programs and try again");
  }
  return device;
}

DrivenDevice::DrivenDevice(std::unique_ptr<Driver> driver, DeviceInfo info, const DrivenSettings& settings)
    : driver_(std::move(driver)),
      info_(std::move(info)),
      identity_(driver_->identity()),
      settings_(settings),
      link_(info_) {
  settings_.retry = std::clamp(settings_.retry, 0.01, 60.0);
  // Before the thread runs, so that a first reading is awaited, not missed.
  link_.connect(info_);
}

DrivenDevice::~DrivenDevice() {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

DeviceStatus DrivenDevice::write(const Vector3& force) {
  return link_.write(force, base::steady_nanoseconds());
}

void DrivenDevice::run() {
  static_cast<void>(realtime::ask_for_realtime_priority(settings_.priority));
  while (true) {
    const std::string why = driver_->run(link_, stop_);
    driver_->close();
    if (stop_.load(std::memory_order_relaxed)) return;
    link_.disconnect(why);
    base::Result<DeviceInfo> info = base::fail("");
    while (!info) {
      pause();
      if (stop_.load(std::memory_order_relaxed)) return;
      info = driver_->open();
    }
    link_.connect(*info);
  }
}

void DrivenDevice::pause() const {
  constexpr auto kStep = std::chrono::milliseconds(10);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(settings_.retry);
  while (std::chrono::steady_clock::now() < end && !stop_.load(std::memory_order_relaxed))
    std::this_thread::sleep_for(kStep);
}

}  // namespace icome::devices
