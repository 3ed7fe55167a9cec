#include "collab/protocol/address.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/parse_number.h"
#include "base/shown_text.h"
#include "base/utf8.h"

namespace icome::collab {
namespace {

constexpr std::string_view kScheme = "icome://";
constexpr std::string_view kForm =
    "an address of a design looks like icome://HOST:PORT/DESIGN#token=...&key=sha256:..., as icome invite "
    "prints it";

bool is_plain_in_address(char letter) {
  const auto between = [letter](char low, char high) { return letter >= low && letter <= high; };
  return between('a', 'z') || between('A', 'Z') || between('0', '9') || letter == '-' || letter == '_' ||
         letter == '.' || letter == '~';
}

std::string percent_encoded(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    if (is_plain_in_address(letter)) {
      result += letter;
    } else {
      result += fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    }
  }
  return result;
}

base::Result<std::string> percent_decoded(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    if (text.front() != '%') {
      result += text.front();
      text.remove_prefix(1);
      continue;
    }
    const auto code = base::number_at_front<unsigned>(text.substr(1, 2), 16);
    if (text.size() < 3 || !code.good() || !code.rest.empty())
      return base::fail("'%' is followed by two hexadecimal digits");
    result += static_cast<char>(code.value);
    text.remove_prefix(3);
  }
  return result;
}

/// The text before the first of `marks`, and what is behind it; `text` becomes the latter.
std::string_view cut_at(std::string_view& text, char mark) {
  const std::size_t end = std::min(text.find(mark), text.size());
  const std::string_view before = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return before;
}

base::Result<void> read_place(std::string_view text, DesignAddress& address) {
  const bool bracketed = text.starts_with('[');
  const std::size_t colon = bracketed ? text.find("]:") : text.rfind(':');
  if (colon == std::string_view::npos) return base::fail("the port is missing: " + std::string(kForm));
  address.host = std::string(bracketed ? text.substr(1, colon - 1) : text.substr(0, colon));
  const auto port = base::number_at_front<std::uint16_t>(text.substr(colon + (bracketed ? 2 : 1)));
  if (address.host.empty()) return base::fail("the host is missing: " + std::string(kForm));
  if (!port.good() || !port.rest.empty() || port.value == 0)
    return base::fail("a port is a number from 1 to 65535");
  address.port = port.value;
  return {};
}

base::Result<void> read_secrets(std::string_view text, DesignAddress& address) {
  while (!text.empty()) {
    std::string_view part = cut_at(text, '&');
    const std::string_view name = cut_at(part, '=');
    if (name == "token") {
      address.token = std::string(part);
    } else if (name == "key") {
      std::string key(part);
      std::ranges::transform(key, key.begin(),
                             [](char it) { return it >= 'A' && it <= 'Z' ? char(it | 0x20) : it; });
      if (key != kNoTls && !is_fingerprint(key))
        return base::fail(
            "the key is no fingerprint (sha256: and 64 hexadecimal digits): was the address cut off?");
      address.fingerprint = std::move(key);
    } else {
      return base::fail("behind '#' there are only token= and key=");
    }
  }
  return {};
}

}  // namespace

bool is_fingerprint(std::string_view text) {
  constexpr std::string_view kKind = "sha256:";
  return text.starts_with(kKind) && text.size() == kKind.size() + 64 &&
         text.substr(kKind.size()).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_design_address(std::string_view text) {
  const auto is_same = [](char one, char other) { return (one | 0x20) == (other | 0x20); };
  return text.size() >= kScheme.size() && std::equal(kScheme.begin(), kScheme.end(), text.begin(), is_same);
}

base::Result<DesignAddress> design_address(std::string_view text) {
  if (!is_design_address(text)) return base::fail(std::string(kForm));
  std::string_view rest = text;
  std::string_view before_secrets = cut_at(rest, '#');
  const std::string shown = base::shown_text(before_secrets);
  const auto wrong = [&](const std::string& why) { return base::fail(shown + ": " + why); };

  before_secrets.remove_prefix(kScheme.size());
  DesignAddress address;
  if (const auto place = read_place(cut_at(before_secrets, '/'), address); !place)
    return wrong(place.error().message);
  auto design = percent_decoded(before_secrets);
  if (!design) return wrong(design.error().message);
  if (const auto good = check_design_name(*design); !good) return wrong(good.error().message);
  address.design = std::move(*design);
  if (const auto secrets = read_secrets(rest, address); !secrets) return wrong(secrets.error().message);
  return address;
}

std::string shown_address(const DesignAddress& address) {
  const bool is_ipv6 = address.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}{}:{}/{}", kScheme, is_ipv6 ? "[" : "", address.host, is_ipv6 ? "]" : "",
                     address.port, percent_encoded(address.design));
}

std::string link_text(const DesignAddress& address) {
  std::string secrets;
  if (!address.token.empty()) secrets += "token=" + address.token;
  if (!address.fingerprint.empty()) secrets += (secrets.empty() ? "key=" : "&key=") + address.fingerprint;
  return shown_address(address) + (secrets.empty() ? "" : "#" + secrets);
}

base::Result<void> check_design_name(std::string_view name) {
  constexpr std::size_t kMostBytes = 100;
  const auto at_edge = [](char letter) { return letter == ' ' || letter == '.'; };
  if (name.empty()) return base::fail("the name of the design is missing: " + std::string(kForm));
  if (name.size() > kMostBytes)
    return base::fail(fmt::format("a design's name has at most {} bytes", kMostBytes));
  if (at_edge(name.front()) || at_edge(name.back()))
    return base::fail("a design's name neither begins nor ends with a blank or a point");
  for (std::string_view rest = name; !rest.empty();) {
    const std::size_t length = base::utf8_length(rest);
    const auto first = static_cast<unsigned char>(rest.front());
    if (length == 0) return base::fail("a design's name is UTF-8");
    if (first < 0x20 || first == 0x7F || first == '/' || first == '\\')
      return base::fail("a design's name has no '/', no '\\' and no control characters");
    rest.remove_prefix(length);
  }
  return {};
}

}  // namespace icome::collab
