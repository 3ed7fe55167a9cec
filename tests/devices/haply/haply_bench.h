#pragma once
#include <functional>
#include <memory>
#include <string>

#include "devices/driver/driven_device.h"
#include "devices/driver_suite.h"
#include "devices/fakes/fake_inverse_service.h"
#include "devices/haply/haply_driver.h"

namespace icome::devices {

/// Settings for a fake: nothing is lost because the machine stood still.
inline HaplySettings settings_for(const fakes::FakeInverseService& fake) {
  HaplySettings settings;
  settings.service = {"127.0.0.1", fake.port()};
  settings.events_port = fake.events_port();
  settings.patience = 20.0;
  settings.connect_patience = 20.0;
  return settings;
}

inline base::Result<std::unique_ptr<DrivenDevice>> open_haply_at(const HaplySettings& settings,
                                                                 const std::string& id = {}) {
  DrivenSettings driven;
  driven.retry = 0.02;
  return DrivenDevice::create(std::make_unique<HaplyDriver>(settings, id), driven);
}

/// Does the device give a reading that fulfils the condition, in time?
inline bool haply_reads_soon(PointerDevice& device,
                             const std::function<bool(const PointerState&)>& condition) {
  PointerState state;
  return suite::holds_soon([&] { return device.read(state) == DeviceStatus::Ok && condition(state); });
}

inline bool haply_reads_soon(PointerDevice& device) {
  return haply_reads_soon(device, [](const PointerState&) { return true; });
}

/// Is the force (N) held until a condition is fulfilled, in time?
inline bool haply_holds_until(PointerDevice& device, const Vector3& force,
                              const std::function<bool()>& condition) {
  return suite::holds_soon([&] {
    device.write(force);
    return condition();
  });
}

inline bool haply_is_lost_soon(PointerDevice& device) {
  PointerState state;
  return suite::holds_soon([&] { return device.read(state) == DeviceStatus::Lost; });
}

inline bool haply_tells_soon(const PointerDevice& device, const std::string& words) {
  return suite::holds_soon([&] { return device.condition().find(words) != std::string::npos; });
}

}  // namespace icome::devices
