#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

// OpenSSL's SSL_CTX, whose headers stay in the sources.
struct ssl_ctx_st;

namespace icome::collab {

/// SHA-256 of a certificate.
using Fingerprint = std::array<unsigned char, 32>;

/// Reads "sha256:" and 64 hexadecimal digits; nothing for any other text.
std::optional<Fingerprint> parse_fingerprint(std::string_view text);

/// Which server a client means: one whose certificate has the fingerprint, or is vouched for by the system's
/// authorities for the host.
struct ServerTrust {
  std::string host = {};
  std::optional<Fingerprint> fingerprint = {};
  bool was_refused = false;  // set where the server's certificate is neither
};

/// What the TLS connections (1.2 and newer) of one side share; owns it.
class TlsContext {
 public:
  /// With a certificate chain and its key, both PEM. The error names the file.
  static base::Result<TlsContext> for_server(const std::filesystem::path& certificate,
                                             const std::filesystem::path& key);
  /// Its connections must have a ServerTrust each.
  static base::Result<TlsContext> for_client();

  ssl_ctx_st* get() const { return context_.get(); }

 private:
  struct Free {
    void operator()(ssl_ctx_st* context) const;
  };
  static TlsContext make();

  std::unique_ptr<ssl_ctx_st, Free> context_;  // null only within the functions that make it
};

}  // namespace icome::collab
