#include "collab/link/wire/byte_channel.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <utility>

namespace icome::collab {

/// The socket as OpenSSL reads and writes it. Its own would be killed by SIGPIPE where the other side is
/// gone.
struct SocketOfTls {
  static ByteChannel& channel_of(BIO* bio) { return *static_cast<ByteChannel*>(BIO_get_data(bio)); }
  static int read(BIO* bio, char* to, int size) {
    BIO_clear_retry_flags(bio);
    const long got = channel_of(bio).receive(to, std::size_t(size));
    if (got < 0 && errno == EAGAIN) BIO_set_retry_read(bio);
    return int(got);
  }
  static int write(BIO* bio, const char* from, int size) {
    BIO_clear_retry_flags(bio);
    const long sent = channel_of(bio).send(from, std::size_t(size));
    if (sent < 0 && errno == EAGAIN) BIO_set_retry_write(bio);
    return int(sent);
  }
  static long control(BIO* bio, int command, long /*number*/, void* /*thing*/) {
    if (command == BIO_CTRL_EOF) return channel_of(bio).has_ended_ ? 1 : 0;
    return command == BIO_CTRL_FLUSH ? 1 : 0;
  }
  static BIO_METHOD* method() {
    static BIO_METHOD* const kMade = [] {
      BIO_METHOD* const made = BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "socket");
      BIO_meth_set_read(made, read);
      BIO_meth_set_write(made, write);
      BIO_meth_set_ctrl(made, control);
      return made;
    }();
    return kMade;
  }
};

ByteChannel::ByteChannel() = default;
ByteChannel::~ByteChannel() = default;

void ByteChannel::Free::operator()(ssl_st* tls) const { SSL_free(tls); }

bool ByteChannel::start(const TlsContext& context) {
  tls_.reset(SSL_new(context.get()));
  BIO* const bio = BIO_new(SocketOfTls::method());
  if (!tls_ || bio == nullptr) {
    BIO_free(bio);
    return false;
  }
  BIO_set_data(bio, this);
  BIO_set_init(bio, 1);
  SSL_set_bio(tls_.get(), bio, bio);
  return true;
}

bool ByteChannel::start_server(const TlsContext& context) {
  if (!start(context)) return false;
  SSL_set_accept_state(tls_.get());
  return true;
}

bool ByteChannel::start_client(const TlsContext& context, ServerTrust trust) {
  if (!start(context)) return false;
  trust_ = std::move(trust);
  SSL_set_app_data(tls_.get(), &trust_);
  SSL_set_connect_state(tls_.get());
  // Names only: numbers are not sent (RFC 6066), and servers may refuse them.
  const bool is_number = trust_.host.find_first_not_of("0123456789.") == std::string::npos ||
                         trust_.host.find(':') != std::string::npos;
  return is_number || SSL_set_tlsext_host_name(tls_.get(), trust_.host.c_str()) == 1;
}

long ByteChannel::receive(char* to, std::size_t size) {
  if (is_drained_) {
    errno = EAGAIN;
    return -1;
  }
  ssize_t got = 0;
  do got = ::recv(socket_, to, size, MSG_DONTWAIT);
  while (got < 0 && errno == EINTR);
  has_ended_ = got == 0 && size > 0;
  is_drained_ = (got > 0 && std::size_t(got) < size) || (got < 0 && errno == EAGAIN);
  if (got < 0) error_ = errno;
  return long(got);
}

long ByteChannel::send(const char* from, std::size_t size) {
  ssize_t sent = 0;
  do sent = ::send(socket_, from, size, MSG_DONTWAIT | MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  if (sent < 0) error_ = errno;
  return long(sent);
}

Transfer ByteChannel::result_of(int returned) {
  using Outcome = Transfer::Outcome;
  if (returned > 0) return {Outcome::Done, std::size_t(returned), 0};
  switch (SSL_get_error(tls_.get(), returned)) {
    case SSL_ERROR_WANT_READ:
      return {Outcome::WaitToRead, 0, 0};
    case SSL_ERROR_WANT_WRITE:
      return {Outcome::WaitToWrite, 0, 0};
    case SSL_ERROR_ZERO_RETURN:
      return {Outcome::Ended, 0, 0};
    case SSL_ERROR_SYSCALL:
      return has_ended_ ? Transfer{Outcome::Ended, 0, 0} : Transfer{Outcome::Broken, 0, error_};
    default:
      break;
  }
  if (has_ended_) return {Outcome::Ended, 0, 0};
  const char* const reason = ERR_reason_error_string(ERR_peek_error());
  trouble_ = reason ? reason : "for no reason that OpenSSL gives";
  return {Outcome::Broken, 0, 0};
}

Transfer ByteChannel::shake_hands() {
  ERR_clear_error();
  return result_of(SSL_do_handshake(tls_.get()));
}

Transfer ByteChannel::read(char* to, std::size_t size) {
  using Outcome = Transfer::Outcome;
  if (tls_) {
    ERR_clear_error();
    const std::size_t most = std::numeric_limits<int>::max();
    return result_of(SSL_read(tls_.get(), to, int(std::min(size, most))));
  }
  const long got = receive(to, size);
  if (got > 0 || size == 0) return {Outcome::Done, std::size_t(std::max(got, 0L)), 0};
  if (got == 0) return {Outcome::Ended, 0, 0};
  return errno == EAGAIN ? Transfer{Outcome::WaitToRead, 0, 0} : Transfer{Outcome::Broken, 0, errno};
}

Transfer ByteChannel::write(const char* from, std::size_t size) {
  using Outcome = Transfer::Outcome;
  if (size == 0) return {Outcome::Done, 0, 0};
  if (tls_) {
    ERR_clear_error();
    const std::size_t most = std::numeric_limits<int>::max();
    return result_of(SSL_write(tls_.get(), from, int(std::min(size, most))));
  }
  const long sent = send(from, size);
  if (sent >= 0) return {Outcome::Done, std::size_t(sent), 0};
  return errno == EAGAIN ? Transfer{Outcome::WaitToWrite, 0, 0} : Transfer{Outcome::Broken, 0, errno};
}

Transfer ByteChannel::drain() {
  using Outcome = Transfer::Outcome;
  // A few at a time, as others have a turn too.
  for (int i = 0; i < 4; ++i) {
    std::array<char, 16384> forgotten;  // NOLINT(cppcoreguidelines-pro-type-member-init): never looked at
    const long got = receive(forgotten.data(), forgotten.size());
    if (got == 0) return {Outcome::Ended, 0, 0};
    if (got < 0 && errno != EAGAIN) return {Outcome::Broken, 0, errno};
    if (got < 0) break;
  }
  return {Outcome::WaitToRead, 0, 0};
}

void ByteChannel::end_writing() {
  if (tls_ && SSL_is_init_finished(tls_.get())) {
    ERR_clear_error();
    SSL_shutdown(tls_.get());
  }
  ::shutdown(socket_, SHUT_WR);
}

}  // namespace icome::collab
