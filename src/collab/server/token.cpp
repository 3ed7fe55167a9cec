#include "collab/server/token.h"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <optional>

#include "base/shown_text.h"
#include "collab/storage/private_file.h"
#include "collab/storage/random_bytes.h"
#include "io/file_bytes.h"

namespace icome::collab {
namespace {

// The bytes of a token: version and role in one, time of expiry (ms, big-endian), id, and the first half of
// the HMAC-SHA256 of these, with the design behind them. Half of it still is 128 bits, which nobody guesses,
// and makes tokens short (RFC 2104, section 5). 39 bytes are 52 characters without bits to spare, so that a
// token is written in one way only.
constexpr unsigned kTokenVersion = 1;
constexpr std::size_t kExpiryBytes = 6, kIdBytes = 16, kMacBytes = 16;
constexpr std::size_t kPayloadBytes = 1 + kExpiryBytes + kIdBytes;
constexpr std::size_t kTokenBytes = kPayloadBytes + kMacBytes;
constexpr std::size_t kTokenCharacters = kTokenBytes / 3 * 4;
static_assert(kTokenBytes % 3 == 0);

constexpr std::int64_t kLatestExpiry = (std::int64_t{1} << (8 * kExpiryBytes)) - 1;

constexpr std::string_view kTokenAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr std::string_view kHexDigits = "0123456789abcdef";

tl::unexpected<base::Error> not_valid() {
  return base::fail("The link is not valid here, or not any more. Ask for a new one.");
}

std::string token_text(std::string_view bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8U | static_cast<unsigned char>(bytes[i + k]);
    for (unsigned shift = 24; shift > 0;) text += kTokenAlphabet[three >> (shift -= 6U) & 63U];
  }
  return text;
}

/// Nothing for what is no token by its form.
std::optional<std::string> token_bytes(std::string_view text) {
  if (text.size() != kTokenCharacters) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    unsigned three = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t digit = kTokenAlphabet.find(text[i + k]);
      if (digit == kTokenAlphabet.npos) return std::nullopt;
      three = three << 6U | unsigned(digit);
    }
    for (unsigned shift = 24; shift > 0;) bytes += char(three >> (shift -= 8U) & 0xffU);
  }
  return bytes;
}

/// Nothing for what is no id of an invitation.
std::optional<std::string> id_bytes(std::string_view text) {
  if (text.size() != 2 * kIdBytes) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const std::size_t high = kHexDigits.find(text[i]), low = kHexDigits.find(text[i + 1]);
    if (high == kHexDigits.npos || low == kHexDigits.npos) return std::nullopt;
    bytes += char(high << 4U | low);
  }
  return bytes;
}

/// The signature of a payload for a design; nothing where OpenSSL fails.
std::optional<std::string> token_mac(std::string_view key, std::string_view payload,
                                     std::string_view design) {
  std::string signed_bytes(payload);
  signed_bytes += design;
  std::array<unsigned char, EVP_MAX_MD_SIZE> mac{};
  unsigned length = 0;
  const auto* const first = reinterpret_cast<const unsigned char*>(signed_bytes.data());
  const bool good =
      HMAC(EVP_sha256(), key.data(), int(key.size()), first, signed_bytes.size(), mac.data(), &length);
  if (!good || length < kMacBytes) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(mac.data()), kMacBytes);
}

std::int64_t expiry_in(std::string_view payload) {
  std::int64_t expires = 0;
  for (std::size_t i = 0; i < kExpiryBytes; ++i)
    expires = expires << 8 | static_cast<unsigned char>(payload[1 + i]);
  return expires;
}

}  // namespace

base::Result<std::string> make_invitation_id() {
  const auto bytes = random_bytes(kIdBytes);
  if (!bytes) return bytes;
  return hex_text(*bytes);
}

base::Result<TokenSigner> TokenSigner::open(const std::filesystem::path& key) {
  std::error_code error;
  if (!std::filesystem::exists(key, error)) {
    const auto fresh = random_bytes(kKeyBytes);
    if (!fresh) return tl::unexpected(fresh.error());
    if (const auto made = make_private_file(key, *fresh); !made) return tl::unexpected(made.error());
  }
  if (const auto secret = demand_private(key); !secret) return tl::unexpected(secret.error());
  auto bytes = io::read_bytes(key, kKeyBytes + 1);
  if (!bytes || bytes->size() != kKeyBytes)
    return base::fail(key.string() +
                      ": is not the key of a store, or cannot be read. Restore it, or remove it: all links "
                      "that were given out end then.");
  return TokenSigner(std::move(*bytes));
}

std::string TokenSigner::derived_key(std::string_view purpose) const {
  return token_mac(key_, "key for", purpose).value_or(std::string());
}

base::Result<std::string> TokenSigner::sign(const Invitation& invitation) const {
  const auto id = id_bytes(invitation.id);
  if (!id) return base::fail(base::shown_text(invitation.id) + ": is not the id of an invitation.");
  if (invitation.expires < 0 || invitation.expires > kLatestExpiry)
    return base::fail("An invitation cannot last that long. Choose an end before the year 10000.");
  std::string bytes(1, char(kTokenVersion << 4U | unsigned(invitation.role)));
  for (std::size_t i = kExpiryBytes; i-- > 0;) bytes += char(invitation.expires >> (8 * i) & 0xff);
  bytes += *id;
  const auto mac = token_mac(key_, bytes, invitation.design);
  if (!mac)
    return base::fail("The link cannot be signed: OpenSSL fails here. See whether it is installed whole.");
  return token_text(bytes + *mac);
}

base::Result<Invitation> TokenSigner::check(std::string_view token, std::string_view design,
                                            std::int64_t now) const {
  const auto bytes = token_bytes(token);
  if (!bytes) return not_valid();
  const std::string_view payload = std::string_view(*bytes).substr(0, kPayloadBytes);
  const auto mac = token_mac(key_, payload, design);
  if (!mac || CRYPTO_memcmp(mac->data(), bytes->data() + kPayloadBytes, kMacBytes) != 0) return not_valid();
  const unsigned first = static_cast<unsigned char>(payload[0]), role = first & 15U;
  if (first >> 4U != kTokenVersion || role > unsigned(Role::Own)) return not_valid();
  Invitation invitation{.id = hex_text(payload.substr(1 + kExpiryBytes)),
                        .design = std::string(design),
                        .role = Role(role),
                        .expires = expiry_in(payload)};
  if (now >= invitation.expires) return base::fail("The link has expired. Ask for a new one.");
  return invitation;
}

}  // namespace icome::collab
