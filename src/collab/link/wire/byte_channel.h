#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "collab/link/wire/tls_context.h"

// OpenSSL's SSL and BIO, whose headers stay in the sources.
struct ssl_st;
struct bio_st;

namespace icome::collab {

/// What became of an attempt to move bytes, none of which waits.
struct Transfer {
  enum class Outcome { Done, WaitToRead, WaitToWrite, Ended, Broken };
  Outcome outcome = Outcome::Done;
  std::size_t bytes = 0;
  int error = 0;  // Broken: the system's, or 0 where trouble() tells
};

/// Bytes through a socket, which its user owns, with or without TLS. Takes no memory of its own while nothing
/// moves: OpenSSL reads into the reader's buffer, and keeps what is not complete only.
class ByteChannel {
 public:
  ByteChannel();
  ~ByteChannel();
  ByteChannel(const ByteChannel&) = delete;
  ByteChannel& operator=(const ByteChannel&) = delete;

  void use(int socket) { socket_ = socket; }
  /// From now on TLS; false for want of memory.
  bool start_server(const TlsContext& context);
  bool start_client(const TlsContext& context, ServerTrust trust);

  /// Precondition: TLS. To be repeated until it is Done.
  Transfer shake_hands();
  Transfer read(char* to, std::size_t size);
  /// What had to wait must come again, though it may lie elsewhere.
  Transfer write(const char* from, std::size_t size);
  /// Reads what the other side sent, and forgets it; Ended where that was all.
  Transfer drain();
  /// Tells the other side that no more bytes follow.
  void end_writing();
  /// To be called when the socket has become readable after WaitToRead.
  void may_read() { is_drained_ = false; }

  bool is_tls() const { return tls_ != nullptr; }
  bool was_certificate_refused() const { return trust_.was_refused; }
  /// What OpenSSL found wrong, a part of a sentence.
  const std::string& trouble() const { return trouble_; }

 private:
  friend struct SocketOfTls;
  struct Free {
    void operator()(ssl_st* tls) const;
  };
  bool start(const TlsContext& context);
  Transfer result_of(int returned);
  /// As recv and send, which set errno.
  long receive(char* to, std::size_t size);
  long send(const char* from, std::size_t size);

  int socket_ = -1;
  bool is_drained_ = false;  // the last read took all there was: the next would be in vain
  bool has_ended_ = false;   // the other side sends no more
  int error_ = 0;            // errno of the last receive() or send() that failed
  ServerTrust trust_;
  std::string trouble_;
  std::unique_ptr<ssl_st, Free> tls_;  // null: without TLS
};

}  // namespace icome::collab
