#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "devices/mapped_device.h"
#include "devices/pointer_device.h"

namespace icome::session {

/// A device with the mapping that it is to be used through.
struct PointerConnection {
  std::string address = {};                                  // by which it was opened, such as "haply:049D"
  std::unique_ptr<devices::PointerDevice> device = nullptr;  // in its own frame
  devices::DeviceMapping mapping = {};
  std::string identity = {};  // devices::identity_of(device)
};

/// Opens a pointer device by its address, with the mapping of its profile file. May take seconds. Fails as
/// devices::open_device() does. Any thread.
base::Result<PointerConnection> open_connection(const std::string& address);

}  // namespace icome::session
