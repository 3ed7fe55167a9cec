#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::collab {

/// The port that servers listen at where nothing else is said.
inline constexpr std::uint16_t kUsualPort = 4263;

/// In the place of a fingerprint: the server speaks without TLS, which only servers on this machine do.
inline constexpr std::string_view kNoTls = "none";

/// The address of a design on a server, as `icome invite` prints it:
/// icome://HOST:PORT/DESIGN#token=TOKEN&key=sha256:DIGITS
struct DesignAddress {
  std::string host = {};  // IPv6 without brackets
  std::uint16_t port = 0;
  std::string design = {};
  std::string token = {};        // secret: whoever has it may come in
  std::string fingerprint = {};  // of the server's certificate, "sha256:" and 64 hexadecimal digits; empty:
                                 // authorities vouch for it
};

/// Is it "sha256:" and 64 hexadecimal digits, which name a certificate?
bool is_fingerprint(std::string_view text);

/// Does the text begin as an address does, "icome://", so that it is not taken for a file?
bool is_design_address(std::string_view text);

/// Fails with a sentence that says which part is wrong and shows no token.
base::Result<DesignAddress> design_address(std::string_view text);

/// The whole address, with its secret.
std::string link_text(const DesignAddress& address);
/// "icome://HOST:PORT/DESIGN", for people and logs.
std::string shown_address(const DesignAddress& address);

/// Fails for a name that no design can have: 1 to 100 bytes of UTF-8 without '/', '\' and control characters,
/// neither beginning nor ending with a blank or a point.
base::Result<void> check_design_name(std::string_view name);

}  // namespace icome::collab
