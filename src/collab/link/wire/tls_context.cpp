#include "collab/link/wire/tls_context.h"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <charconv>
#include <cstring>

namespace icome::collab {
namespace {

bool fits_fingerprint(X509* certificate, const ServerTrust& trust) {
  Fingerprint digest = {};
  unsigned size = 0;
  return trust.fingerprint && certificate != nullptr &&
         X509_digest(certificate, EVP_sha256(), digest.data(), &size) == 1 && size == digest.size() &&
         CRYPTO_memcmp(digest.data(), trust.fingerprint->data(), digest.size()) == 0;
}

/// Called by OpenSSL once a server has shown its certificate; 1 accepts it.
int judge_certificate(X509_STORE_CTX* chain, void* /*none*/) {
  auto* const tls =
      static_cast<SSL*>(X509_STORE_CTX_get_ex_data(chain, SSL_get_ex_data_X509_STORE_CTX_idx()));
  auto* const trust = static_cast<ServerTrust*>(SSL_get_app_data(tls));
  if (fits_fingerprint(X509_STORE_CTX_get0_cert(chain), *trust)) return 1;
  X509_VERIFY_PARAM* const wanted = X509_STORE_CTX_get0_param(chain);
  const bool has_host = X509_VERIFY_PARAM_set1_ip_asc(wanted, trust->host.c_str()) == 1 ||
                        X509_VERIFY_PARAM_set1_host(wanted, trust->host.c_str(), 0) == 1;
  const bool is_vouched_for = has_host && X509_verify_cert(chain) == 1;
  trust->was_refused = !is_vouched_for;
  return is_vouched_for ? 1 : 0;
}

/// A key with a password is refused, not asked for on the terminal.
int no_password(char* /*to*/, int /*size*/, int /*writing*/, void* /*none*/) { return -1; }

tl::unexpected<base::Error> bad_file(const std::filesystem::path& path, const char* what) {
  const unsigned long code = ERR_peek_last_error();
  const char* const system = ERR_SYSTEM_ERROR(code) ? std::strerror(ERR_GET_REASON(code)) : nullptr;
  const char* const reason = system ? system : ERR_reason_error_string(code);
  ERR_clear_error();
  return base::fail(fmt::format("{}: {} ({}).", path.string(), what, reason ? reason : "cannot be read"));
}

}  // namespace

std::optional<Fingerprint> parse_fingerprint(std::string_view text) {
  constexpr std::string_view kKind = "sha256:";
  Fingerprint result = {};
  if (!text.starts_with(kKind) || text.size() != kKind.size() + 2 * result.size()) return std::nullopt;
  const char* at = text.data() + kKind.size();
  for (unsigned char& byte : result) {
    const auto read = std::from_chars(at, at + 2, byte, 16);
    if (read.ec != std::errc() || read.ptr != at + 2) return std::nullopt;
    at += 2;
  }
  return result;
}

void TlsContext::Free::operator()(ssl_ctx_st* context) const { SSL_CTX_free(context); }

TlsContext TlsContext::make() {
  TlsContext made;
  made.context_.reset(SSL_CTX_new(TLS_method()));
  SSL_CTX* const context = made.get();
  if (context == nullptr) return made;
  // Bytes come in pieces of any size from buffers that move, and a connection at rest keeps none.
  SSL_CTX_set_mode(context, SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER |
                                SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_read_ahead(context, 1);
  SSL_CTX_set_options(context, SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET |
                                   SSL_OP_CIPHER_SERVER_PREFERENCE);
  // Sessions are not resumed: a handshake takes less than a millisecond, what it would save is kept for each.
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_num_tickets(context, 0);
  SSL_CTX_set_default_passwd_cb(context, no_password);
  if (SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION) != 1 ||
      SSL_CTX_set_cipher_list(context, "ECDHE+AESGCM:ECDHE+CHACHA20") != 1)
    made.context_.reset();
  return made;
}

base::Result<TlsContext> TlsContext::for_server(const std::filesystem::path& certificate,
                                                const std::filesystem::path& key) {
  ERR_clear_error();
  TlsContext made = make();
  if (!made.get()) return base::fail("TLS cannot be used: OpenSSL does not start.");
  if (SSL_CTX_use_certificate_chain_file(made.get(), certificate.c_str()) != 1)
    return bad_file(certificate, "holds no certificate in PEM that can be used");
  if (SSL_CTX_use_PrivateKey_file(made.get(), key.c_str(), SSL_FILETYPE_PEM) != 1)
    return bad_file(key, "holds no key in PEM, without a password, that belongs to the certificate");
  return made;
}

base::Result<TlsContext> TlsContext::for_client() {
  TlsContext made = make();
  if (!made.get() || SSL_CTX_set_default_verify_paths(made.get()) != 1)
    return base::fail("TLS cannot be used: OpenSSL does not start.");
  SSL_CTX_set_verify(made.get(), SSL_VERIFY_PEER, nullptr);
  SSL_CTX_set_cert_verify_callback(made.get(), judge_certificate, nullptr);
  return made;
}

}  // namespace icome::collab
