#include <gtest/gtest.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "collab/link/link_bench.h"
#include "collab/link/link_loop.h"
#include "places.h"

namespace icome::collab {
namespace {

using namespace std::chrono_literals;

/// A server that strangers find.
class LinkHostileTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { certificates = new CertificateFolder(); }
  static void TearDownTestSuite() { delete std::exchange(certificates, nullptr); }

  static ListenSettings with_tls() {
    ListenSettings settings;
    settings.certificate = certificates->certificate;
    settings.key = certificates->key;
    return settings;
  }
  static ConnectSettings to(const Endpoint& endpoint, bool tls) {
    ConnectSettings settings;
    settings.endpoint = endpoint;
    settings.tls = tls;
    settings.fingerprint = certificates->fingerprint;
    return settings;
  }
  /// A request to upgrade with the key of RFC 6455, section 1.3.
  static std::string request(const std::string& path, const std::string& more = "") {
    return "GET " + path +
           " HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
           more + "\r\n";
  }
  /// The whole answer to what ends a connection, or the head of the one that goes on.
  std::string answer_to(std::uint16_t port, const std::string& bytes) {
    RawSocket socket(port);
    std::size_t sent = 0;
    EXPECT_TRUE(bench_.run_until([&] {
      if (sent < bytes.size()) sent += socket.send(std::string_view(bytes).substr(sent));
      return socket.is_over() || socket.read().starts_with("HTTP/1.1 101");
    }));
    return socket.read();
  }
  /// Sends frames to a server without TLS; gives what it says of the end.
  std::string end_after(const std::string& frames) {
    const std::uint16_t port = bench_.loop().listen({})->port;
    RawSocket socket(port);
    bool was_sent = false;
    EXPECT_TRUE(bench_.run_until([&] {
      if (!was_sent) was_sent = socket.send(request("/icome")) > 0;
      return socket.read().find("\r\n\r\n") != std::string::npos;
    }));
    socket.send(frames);
    EXPECT_TRUE(bench_.run_until([&] { return socket.is_over(); }));
    socket.reset();
    EXPECT_TRUE(bench_.run_until([&] { return bench_.open_count(false) == 0; }));
    return bench_.of(bench_.accepted().back()).why;
  }

  static CertificateFolder* certificates;  // null between suites
  LinkBench bench_;
};
CertificateFolder* LinkHostileTest::certificates = nullptr;

bool tells(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

// ---- The request to upgrade ----

TEST_F(LinkHostileTest, UpgradeIsThatOfTheStandard) {
  const std::uint16_t port = bench_.loop().listen({})->port;
  const std::string answer = answer_to(port, request("/icome"));
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 101 ")) << answer;
  EXPECT_TRUE(tells(answer, "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n")) << answer;
  EXPECT_FALSE(tells(answer, "Beast")) << answer;
}

TEST_F(LinkHostileTest, OtherPathsAreNotFound) {
  const std::uint16_t port = bench_.loop().listen({})->port;
  for (const char* path : {"/", "/icome/", "/icomes", "/other", "*", "http://localhost/icome"})
    EXPECT_TRUE(answer_to(port, request(path)).starts_with("HTTP/1.1 404 ")) << path;
  EXPECT_TRUE(answer_to(port, request("/icome?design=lamp")).starts_with("HTTP/1.1 101 "));
}

TEST_F(LinkHostileTest, OriginIsChecked) {
  ListenSettings settings;
  settings.origins = {"https://example.org", "https://second.example"};
  const std::uint16_t port = bench_.loop().listen(settings)->port;
  const auto status = [&](const std::string& fields) {
    return answer_to(port, request("/icome", fields)).substr(9, 3);
  };
  EXPECT_EQ(status(""), "101");
  EXPECT_EQ(status("Origin: https://example.org\r\n"), "101");
  EXPECT_EQ(status("Origin: https://second.example\r\n"), "101");
  EXPECT_EQ(status("Origin: https://example.org.evil.example\r\n"), "403");
  EXPECT_EQ(status("Origin: http://example.org\r\n"), "403");
  EXPECT_EQ(status("Origin: null\r\n"), "403");
  EXPECT_EQ(status("Origin: \r\n"), "403");
  EXPECT_EQ(status("Origin: https://example.org\r\nOrigin: https://evil.example\r\n"), "403");
  const std::uint16_t strict = bench_.loop().listen({})->port;
  EXPECT_EQ(answer_to(strict, request("/icome", "Origin: https://example.org\r\n")).substr(9, 3), "403");
}

TEST_F(LinkHostileTest, WhatIsNoUpgradeIsAnsweredSo) {
  const std::uint16_t port = bench_.loop().listen({})->port;
  EXPECT_EQ(answer_to(port, "GET /icome HTTP/1.1\r\nHost: localhost\r\n\r\n").substr(9, 3), "400");
  EXPECT_EQ(answer_to(port, "nonsense\r\n\r\n").substr(9, 3), "400");
  EXPECT_EQ(answer_to(port, request("/icome", "Padding: " + std::string(9000, 'x') + "\r\n")).substr(9, 3),
            "431");
  EXPECT_EQ(answer_to(port, request("/icome") + "too early").substr(9, 3), "400");
  EXPECT_TRUE(bench_.accepted().empty());
}

// ---- Frames ----

TEST_F(LinkHostileTest, TextIsRefused) {
  EXPECT_TRUE(tells(end_after("\x81\x82\x01\x02\x03\x04ij"), "sent text, where frames are bytes"));
}

TEST_F(LinkHostileTest, FramesAgainstTheStandardEndTheConnection) {
  using namespace std::string_literals;
  for (const std::string& frame : {"\x82\x02hi"s,                           // not masked
                                   "\xF2\x82\x01\x02\x03\x04hi"s,           // reserved bits
                                   "\x83\x82\x01\x02\x03\x04hi"s,           // a kind that does not exist
                                   "\x80\x82\x01\x02\x03\x04hi"s,           // goes on with nothing
                                   "\x89\xFE\x00\x80\x01\x02\x03\x04"s}) {  // a ping that is too long
    const std::string why = end_after(frame);
    EXPECT_TRUE(tells(why, "does not keep to the WebSocket protocol")) << why;
  }
}

TEST_F(LinkHostileTest, AnnouncedLengthsAreNotBelieved) {
  using namespace std::string_literals;
  const std::string why = end_after("\x82\xFF\x7F\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x01\x02\x03\x04"s);
  EXPECT_TRUE(tells(why, "sent a frame of more than 1048576 bytes")) << why;
  // In many pieces, none of which is too long.
  std::string pieces;
  for (int i = 0; i < 40; ++i)
    pieces += (i == 0 ? "\x02"s : "\x00"s) + "\xFE\xFF\xFF\x00\x00\x00\x00"s + std::string(65535, 'x');
  const std::uint16_t port = bench_.loop().listen({})->port;
  RawSocket socket(port);
  std::size_t sent = 0;
  pieces.insert(0, request("/icome"));
  const std::size_t head = request("/icome").size();
  ASSERT_TRUE(bench_.run_until([&] {
    const std::size_t most = tells(socket.read(), "\r\n\r\n") ? pieces.size() : head;
    if (sent < most) sent += socket.send(std::string_view(pieces).substr(sent, most - sent));
    return socket.is_over();
  }));
  socket.reset();
  ASSERT_TRUE(bench_.run_until([&] { return bench_.open_count(false) == 0; }));
  EXPECT_TRUE(tells(bench_.of(bench_.accepted().back()).why, "sent a frame of more than"));
}

// ---- TLS ----

/// Tries TLS up to a version; gives "" for success and else what the server said.
std::string try_tls(LinkBench& bench, std::uint16_t port, int version) {
  const std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)> context(SSL_CTX_new(TLS_client_method()), SSL_CTX_free);
  SSL_CTX_set_min_proto_version(context.get(), TLS1_VERSION);
  SSL_CTX_set_max_proto_version(context.get(), version);
  SSL_CTX_set_cipher_list(context.get(), "ALL:@SECLEVEL=0");
  const RawSocket socket(port);
  const std::unique_ptr<SSL, void (*)(SSL*)> tls(SSL_new(context.get()), SSL_free);
  SSL_set_fd(tls.get(), socket.descriptor());
  std::string result = "nothing";
  bench.run_until([&] {
    ERR_clear_error();
    const int returned = SSL_connect(tls.get());
    const int error = SSL_get_error(tls.get(), returned);
    if (returned != 1 && (error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE)) return false;
    if (error == SSL_ERROR_SYSCALL && errno == ENOTCONN) return false;
    const char* const reason = ERR_reason_error_string(ERR_peek_error());
    result = returned == 1 ? "" : (reason ? reason : "ended");
    return true;
  });
  return result;
}

TEST_F(LinkHostileTest, OldTlsIsRefused) {
  const std::uint16_t port = bench_.loop().listen(with_tls())->port;
  EXPECT_EQ(try_tls(bench_, port, TLS1_3_VERSION), "");
  EXPECT_EQ(try_tls(bench_, port, TLS1_2_VERSION), "");
  const std::string why = try_tls(bench_, port, TLS1_1_VERSION);
  EXPECT_TRUE(tells(why, "protocol version")) << why;
}

// ---- Many strangers ----

/// The first bytes of a TLS 1.2 handshake whose length is right, and whose rest never comes.
std::string half_hello() {
  return std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11) + std::string(80, 'r');
}

/// What one of the strangers does, as the look goes on: each has a kind of its own.
void bother(RawSocket& socket, std::size_t kind, std::size_t look, const std::string& upgrade) {
  const auto slowly = [&](const std::string& text) {
    if (look % 8 == 0 && look / 8 < text.size()) socket.send(text.substr(look / 8, 1));
  };
  switch (kind % 5) {
    case 0:  // says nothing
      return;
    case 1:
      if (look % 20 == 1) socket.send(std::string(3000, char(look + kind)));
      return;
    case 2:
      return slowly(half_hello());
    case 3:
      return slowly(upgrade);
    default:
      if (look == 1) socket.send(upgrade.substr(0, upgrade.size() / 2));
  }
}

class LinkStrangersTest : public LinkHostileTest, public testing::WithParamInterface<bool> {};

TEST_P(LinkStrangersTest, DoNotHurtWhoIsHonest) {
  constexpr std::size_t kStrangers = 500;
  ListenSettings settings = GetParam() ? with_tls() : ListenSettings();
  settings.most_links_an_address = 2 * kStrangers;
  settings.handshake_time = 3s;
  const Endpoint endpoint = bench_.loop().listen(settings).value();
  const LinkId honest = bench_.loop().connect(to(endpoint, GetParam()));
  ASSERT_TRUE(bench_.run_until_open(honest)) << bench_.of(honest).why;
  std::vector<RawSocket> strangers;
  for (std::size_t i = 0; i < kStrangers; ++i) strangers.emplace_back(endpoint.port);
  std::size_t next = 0;
  bool in_order = true;
  bench_.on_frame = [&](LinkId link, std::string_view frame) {
    in_order = in_order && frame == std::to_string(next);
    bench_.send(link, std::to_string(++next));
  };
  bench_.send(honest, "0");
  const std::string upgrade = request("/icome", "Slow: " + std::string(100'000, 'x') + "\r\n");
  std::size_t look = 0;
  std::size_t over = 0;
  ASSERT_TRUE(bench_.run_until([&] {
    ++look;
    over = 0;
    for (std::size_t i = 0; i < kStrangers; ++i) {
      if (strangers[i].is_over())
        ++over;
      else
        bother(strangers[i], i, look, upgrade);
    }
    return over == kStrangers && next >= 200;
  })) << over
      << " strangers are gone, " << next << " frames came";
  EXPECT_TRUE(in_order);
  EXPECT_FALSE(bench_.of(honest).is_over) << bench_.of(honest).why;
  EXPECT_EQ(bench_.accepted().size(), 1U);
  bench_.on_frame = nullptr;
  const LinkId late = bench_.loop().connect(to(endpoint, GetParam()));
  EXPECT_TRUE(bench_.run_until_open(late)) << bench_.of(late).why;
}

INSTANTIATE_TEST_SUITE_P(Wires, LinkStrangersTest, testing::Bool(),
                         [](const auto& it) { return it.param ? "Tls" : "Plain"; });

/// Nothing can be opened while it lives.
class NoDescriptors {
 public:
  NoDescriptors() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const int next = ::dup(0);
    ::close(next);
    rlimit less = before_;
    less.rlim_cur = rlim_t(next);
    ::setrlimit(RLIMIT_NOFILE, &less);
  }
  ~NoDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;

 private:
  rlimit before_ = {};
};

TEST_F(LinkHostileTest, WithoutDescriptorsWhoIsThereIsServed) {
  const Endpoint endpoint = bench_.loop().listen(with_tls()).value();
  const LinkId honest = bench_.loop().connect(to(endpoint, true));
  ASSERT_TRUE(bench_.run_until_open(honest));
  std::vector<RawSocket> waiting;
  for (int i = 0; i < 5; ++i) waiting.emplace_back(endpoint.port);
  {
    const NoDescriptors none;
    const std::clock_t before = std::clock();
    bench_.run_for(500ms);
    EXPECT_LT(std::clock() - before, CLOCKS_PER_SEC / 4);  // it does not try all the time
    bench_.on_frame = [&](LinkId link, std::string_view) { bench_.send(link, "on"); };
    bench_.send(honest, "on");
    EXPECT_TRUE(bench_.run_until([&] { return bench_.of(honest).frames >= 50; }));
    bench_.on_frame = nullptr;
    for (RawSocket& socket : waiting) EXPECT_FALSE(socket.is_over());
  }
  for (RawSocket& socket : waiting) socket.send("This is no TLS at all, is it?");
  EXPECT_TRUE(bench_.run_until([&] {
    return std::all_of(waiting.begin(), waiting.end(), [](RawSocket& socket) { return socket.is_over(); });
  }));
}

// ---- The page for machines ----

TEST_F(LinkHostileTest, PagesAreAnswered) {
  const std::uint16_t port = bench_.loop()
                                 .listen_http({},
                                              [](std::string_view path) {
                                                return path == "/health"
                                                           ? HttpAnswer{200, "text/plain", "fine\n"}
                                                           : HttpAnswer{404, "text/plain", "none\n"};
                                              })
                                 ->port;
  const std::string fine = answer_to(port, "GET /health?now HTTP/1.1\r\nHost: a\r\nX: y\r\n\r\n");
  EXPECT_TRUE(fine.starts_with("HTTP/1.1 200 OK\r\n")) << fine;
  EXPECT_TRUE(tells(fine, "Content-Length: 5\r\n") && tells(fine, "Connection: close\r\n")) << fine;
  EXPECT_TRUE(fine.ends_with("\r\n\r\nfine\n")) << fine;
  const auto status = [&](const std::string& text) { return answer_to(port, text).substr(9, 3); };
  EXPECT_EQ(status("GET /other HTTP/1.0\r\n\r\n"), "404");
  EXPECT_EQ(status("POST /health HTTP/1.1\r\n\r\nbody"), "405");
  EXPECT_EQ(status("nonsense\r\n\r\n"), "400");
  EXPECT_EQ(status("GET health HTTP/1.1\r\n\r\n"), "400");
  EXPECT_EQ(status("GET  HTTP/1.1\r\n\r\n"), "400");
  EXPECT_EQ(status("GET /health SPDY\r\n\r\n"), "400");
  EXPECT_EQ(status("GET /" + std::string(10'000, 'x') + " HTTP/1.1\r\n\r\n"), "431");
  EXPECT_EQ(status(std::string("\0\0\r\n\r\n", 6)), "400");
}

TEST_F(LinkHostileTest, SlowReadersOfPagesGiveWay) {
  const std::uint16_t port = bench_.loop()
                                 .listen_http({},
                                              [](std::string_view) {
                                                return HttpAnswer{200, "text/plain", "fine\n"};
                                              })
                                 ->port;
  std::vector<RawSocket> slow;
  for (int i = 0; i < 20; ++i) slow.emplace_back(port);
  for (RawSocket& socket : slow) socket.send("GET /hea");
  bench_.run_for(10ms);
  EXPECT_TRUE(answer_to(port, "GET /health HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 200 "));
}

// ---- A peer that shares nothing with us ----

TEST_F(LinkHostileTest, PythonUnderstandsUs) {
  const std::uint16_t port = bench_.loop().listen(with_tls())->port;
  const std::string script = (places::project_folder() / "tests/collab/link/web_socket_peer.py").string();
  const std::string command =
      "python3 -B '" + script + "' " + std::to_string(port) + " '" + certificates->certificate.string() + "'";
  std::atomic<int> status = -1;
  std::thread python([&] { status = std::system(command.c_str()); });
  EXPECT_TRUE(bench_.run_until([&] { return status >= 0 && bench_.open_count(false) == 0; }));
  python.join();
  EXPECT_EQ(status, 0);
  ASSERT_EQ(bench_.accepted().size(), 1U);
  EXPECT_TRUE(tells(bench_.of(bench_.accepted()[0]).why, "has ended the connection: enough"));
}

}  // namespace
}  // namespace icome::collab
