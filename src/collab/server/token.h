#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "collab/protocol/message.h"

namespace icome::collab {

/// What a token says: whoever shows it may work on that design in that role.
struct Invitation {
  std::string id = {};  // 32 hexadecimal digits, which name the invitation in revocations and audit logs
  std::string design = {};
  Role role = Role::View;
  std::int64_t expires = 0;  // ms since 1970 (UTC), from 0 to 2^48 - 1 (the year 10889)

  bool operator==(const Invitation&) const = default;
};

/// An id that no other invitation has: 128 random bits.
base::Result<std::string> make_invitation_id();

/// Signs and checks tokens (HMAC-SHA256) with a key that only this store has.
class TokenSigner {
 public:
  static constexpr std::size_t kKeyBytes = 32;
  /// With a key of kKeyBytes, which nobody can guess.
  explicit TokenSigner(std::string key) : key_(std::move(key)) {}
  /// Reads the key from a file, which only its owner may read; makes one where there is none.
  static base::Result<TokenSigner> open(const std::filesystem::path& key);

  /// A key for another purpose, which only who has this one can know.
  std::string derived_key(std::string_view purpose) const;

  /// A token: 52 letters, digits, '-' and '_'. The name of the design is not in it, but signed with it. Fails
  /// for an invitation whose id or time is not as said there.
  base::Result<std::string> sign(const Invitation& invitation) const;
  /// What a token says, if it was signed with this key, is for this design and has not expired at `now` (ms
  /// since 1970). Takes the same time wherever a forged signature differs, and fails alike for all forgeries;
  /// a token that was genuine but has expired is told so.
  base::Result<Invitation> check(std::string_view token, std::string_view design, std::int64_t now) const;

 private:
  std::string key_;  // 32 random bytes
};

}  // namespace icome::collab
