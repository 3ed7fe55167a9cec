#pragma once
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::io {

/// A computer, or an address of this one, and a port there.
struct HostPort {
  std::string host;  // a name or a number, IPv6 ones without brackets
  int port = 0;      // 0 to 65535
};

/// "HOST:PORT", "HOST", ":PORT", "[IPV6]:PORT" or nothing; what is left out is as `usual`. The error says
/// what is wrong with the text.
base::Result<HostPort> parse_host_port(std::string_view text, const HostPort& usual);

}  // namespace icome::io
