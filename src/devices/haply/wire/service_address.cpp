#include "devices/haply/wire/service_address.h"

#include <fmt/format.h>

#include <optional>

#include "base/parse_number.h"
#include "base/shown_text.h"

namespace icome::devices {
namespace {

std::optional<std::uint16_t> port_of(std::string_view digits) {
  const auto port = base::parse_number<std::uint16_t>(digits);
  return port && *port != 0 ? port : std::nullopt;
}

}  // namespace

base::Result<ServiceAddress> parse_service_address(std::string_view text, std::uint16_t port) {
  const auto refused = [&] {
    return base::fail(fmt::format("\"{}\" is no place of a service; write HOST:PORT, such as localhost:10001",
                                  base::shown_text(text)));
  };
  std::string_view host = text;
  std::string_view rest;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return refused();
    host = text.substr(1, end - 1);
    rest = text.substr(end + 1);
  } else if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
    host = text.substr(0, colon);
    rest = text.substr(colon);
  }
  if (host.empty()) return refused();
  if (rest.empty()) return ServiceAddress{std::string(host), port};
  const auto given = rest.starts_with(':') ? port_of(rest.substr(1)) : std::nullopt;
  if (!given) return refused();
  return ServiceAddress{std::string(host), *given};
}

std::string shown_address(const ServiceAddress& address) {
  const bool numbers = address.host.find(':') != std::string::npos;
  return fmt::format(fmt::runtime(numbers ? "[{}]:{}" : "{}:{}"), address.host, address.port);
}

}  // namespace icome::devices
