#include "collab/client/joining.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "base/version.h"
#include "collab/storage/random_bytes.h"

namespace icome::collab {
namespace {

std::string person_of_this_machine() {
  for (const char* const name : {"ICOME_NAME", "USER", "LOGNAME"})
    if (const char* const value = std::getenv(name); value != nullptr && *value != '\0') return value;
  passwd account = {}, *found = nullptr;
  std::array<char, 4096> names = {};
  if (::getpwuid_r(::getuid(), &account, names.data(), names.size(), &found) == 0 && found != nullptr)
    return found->pw_name;
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

}  // namespace icome::collab
