#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::devices {

/// The place of a service on the network.
struct ServiceAddress {
  std::string host = "localhost";  // a name or a number, IPv6 ones without brackets
  std::uint16_t port = 0;
};

/// "HOST:PORT", "HOST" or "[IPV6]:PORT"; without a port, it is `port`. The error is a sentence.
base::Result<ServiceAddress> parse_service_address(std::string_view text, std::uint16_t port);

/// The address as people write it: "localhost:10001", "[::1]:10001".
std::string shown_address(const ServiceAddress& address);

}  // namespace icome::devices
