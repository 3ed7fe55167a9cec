#include "session/hands/pointer_connection.h"

#include <utility>

#include "devices/catalogue.h"
#include "devices/mapping_file.h"

namespace icome::session {

base::Result<PointerConnection> open_connection(const std::string& address) {
  const auto mapping = devices::read_mapping(address);
  if (!mapping) return tl::unexpected(mapping.error());
  auto device = devices::open_device(address, devices::DeviceMapping{});
  if (!device) return tl::unexpected(device.error());
  std::string identity = devices::identity_of(**device);
  return PointerConnection{address, std::move(*device), *mapping, std::move(identity)};
}

}  // namespace icome::session
