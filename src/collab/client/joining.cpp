#include "collab/client/joining.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "base/version.h"
#include "collab/storage/random_bytes.h"

namespace icome::collab {
namespace {

/// Can be told apart, also by people who see few colours, and seen on light and dark grounds (Okabe and Ito
/// 2008, without black and yellow).
constexpr std::array<std::uint32_t, 6> kColours{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9};

std::string person_of_this_machine() {
  for (const char* const name : {"ICOME_NAME", "USER", "LOGNAME"})
    if (const char* const value = std::getenv(name); value != nullptr && *value != '\0') return value;
  return "Somebody";
}

}  // namespace

base::Result<std::string> make_client_key() {
  const auto bytes = random_bytes(16);
  if (!bytes) return bytes;
  return hex_text(*bytes);
}

base::Result<ClientIdentity> new_identity(const std::string& name) {
  auto key = make_client_key();
  if (!key) return tl::unexpected(key.error());
  ClientIdentity identity;
  identity.key = std::move(*key);
  identity.name = name.empty() ? person_of_this_machine() : name;
  identity.program = fmt::format("icome {}", base::kVersion);
  return identity;
}

base::Result<DesignAddress> address_to_join(std::string_view text) {
  auto address = design_address(text);
  if (!address) return address;
  if (const char* const token = std::getenv("ICOME_TOKEN"); token != nullptr && address->token.empty())
    address->token = token;
  return address;
}

std::uint32_t shown_colour(const Person& person) {
  return person.colour != 0 ? person.colour : kColours[person.author % kColours.size()];
}

}  // namespace icome::collab
