#include "io/host_port.h"

#include "base/parse_number.h"
#include "base/shown_text.h"

namespace icome::io {

base::Result<HostPort> parse_host_port(std::string_view text, const HostPort& usual) {
  const auto refused = [text](const char* why) {
    return base::fail("'" + base::shown_text(text) + "': " + why);
  };
  HostPort place = usual;
  const bool brackets = text.starts_with('[');
  const std::size_t end = brackets ? text.find(']') : text.find(':');
  if (brackets && end == std::string_view::npos) return refused("there is no ] behind the address");
  const std::string_view host = brackets ? text.substr(1, end - 1) : text.substr(0, end);
  std::string_view rest =
      end == std::string_view::npos ? std::string_view() : text.substr(end + (brackets ? 1 : 0));
  if (!host.empty()) place.host = host;
  if (rest.empty()) return place;
  if (!rest.starts_with(':')) return refused("behind the ] comes :PORT, or nothing");
  rest.remove_prefix(1);
  if (rest.find(':') != std::string_view::npos) return refused("an address of IPv6 is written in brackets");
  const auto port = base::parse_number<int>(rest);
  if (!port || *port < 0 || *port > 65535) return refused("a port is a number up to 65535");
  place.port = *port;
  return place;
}

}  // namespace icome::io
