#include "collab/link/link_loop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "collab/link/link_bench.h"

namespace icome::collab {
namespace {

using namespace std::chrono_literals;

enum class Wired { Plain, Tls };

/// A server and what it takes to connect to it.
class LinkLoopTest : public testing::TestWithParam<Wired> {
 protected:
  static void SetUpTestSuite() { certificates = new CertificateFolder(); }
  static void TearDownTestSuite() { delete std::exchange(certificates, nullptr); }

  static ListenSettings listening(Wired wired) {
    ListenSettings settings;
    if (wired == Wired::Tls) settings.certificate = certificates->certificate;
    if (wired == Wired::Tls) settings.key = certificates->key;
    settings.most_frame_bytes = 16U << 20U;
    return settings;
  }
  static ConnectSettings connecting(Wired wired, const base::Result<Endpoint>& to) {
    ConnectSettings settings;
    settings.endpoint = to.value();
    settings.tls = wired == Wired::Tls;
    if (settings.tls) settings.fingerprint = certificates->fingerprint;
    return settings;
  }
  static std::string sample(std::size_t size) {
    std::string text(size, '\0');
    for (std::size_t i = 0; i < size; ++i) text[i] = char(i * 2654435761U >> 13U);
    return text;
  }

  static CertificateFolder* certificates;  // null between suites
};
CertificateFolder* LinkLoopTest::certificates = nullptr;

std::string shown(const Endpoint& endpoint) { return endpoint.host + ":" + std::to_string(endpoint.port); }

bool says(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST_P(LinkLoopTest, FramesGoBothWays) {
  LinkBench bench;
  const auto endpoint = bench.loop().listen(listening(GetParam()));
  const LinkId link = bench.loop().connect(connecting(GetParam(), endpoint));
  ASSERT_TRUE(bench.run_until_open(link)) << bench.of(link).why;
  EXPECT_TRUE(bench.of(link).peer.is_ours);
  for (const std::size_t size :
       {0U, 1U, 125U, 126U, 1024U, 1025U, 16'384U, 65'535U, 65'536U, 65'537U, 300'000U}) {
    const std::size_t before = bench.of(link).frames;
    bench.send(link, sample(size));
    ASSERT_TRUE(bench.run_until([&] { return bench.of(link).frames > before; }));
    EXPECT_TRUE(bench.of(link).last == sample(size)) << size;
  }
  ASSERT_EQ(bench.accepted().size(), 1U);
  EXPECT_TRUE(bench.of(bench.accepted()[0]).peer.address.starts_with("127.0.0.1:"));
}

TEST_P(LinkLoopTest, BigFrameGoesBothWays) {
  LinkBench bench;
  const auto endpoint = bench.loop().listen(listening(GetParam()));
  const LinkId link = bench.loop().connect(connecting(GetParam(), endpoint));
  ASSERT_TRUE(bench.run_until_open(link)) << bench.of(link).why;
  const std::string big = sample(8U << 20U);
  bench.send(link, big);
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).frames == 1; })) << bench.of(link).why;
  EXPECT_TRUE(bench.of(link).last == big);
}

TEST_P(LinkLoopTest, FrameThatIsTooLongEndsItsConnectionOnly) {
  LinkBench bench;
  ListenSettings settings = listening(GetParam());
  settings.most_frame_bytes = 1000;
  const auto endpoint = bench.loop().listen(settings);
  const LinkId long_one = bench.loop().connect(connecting(GetParam(), endpoint));
  const LinkId other = bench.loop().connect(connecting(GetParam(), endpoint));
  ASSERT_TRUE(bench.run_until_open(long_one) && bench.run_until_open(other));
  bench.send(long_one, sample(1001));
  ASSERT_TRUE(bench.run_until_over(long_one));
  EXPECT_TRUE(bench.run_until([&] {
    std::size_t over = 0;
    for (const LinkId link : bench.accepted())
      over += says(bench.of(link).why, "sent a frame of more than 1000 bytes") ? 1U : 0U;
    return over == 1;
  }));
  bench.send(other, sample(1000));
  EXPECT_TRUE(bench.run_until([&] { return bench.of(other).frames == 1; }));
}

TEST_P(LinkLoopTest, ClosingSaysWhyToBothSides) {
  LinkBench bench;
  const auto endpoint = bench.loop().listen(listening(GetParam()));
  const LinkId link = bench.loop().connect(connecting(GetParam(), endpoint));
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).is_open && bench.accepted().size() == 1; }));
  const LinkId server = bench.accepted()[0];
  bench.loop().close(server, "The server goes to rest, \x1b[31mgood night.");
  EXPECT_FALSE(bench.of(server).is_over);
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).is_over && bench.of(server).is_over; }));
  EXPECT_EQ(bench.of(server).why, "The server goes to rest, \x1b[31mgood night.");
  EXPECT_TRUE(says(bench.of(link).why, "has ended the connection: The server goes to rest, \\u001b[31mgood"))
      << bench.of(link).why;
  EXPECT_EQ(bench.of(link).calls_after_end + bench.of(server).calls_after_end, 0);
}

TEST_P(LinkLoopTest, ClosingComesAfterWhatIsBeingSent) {
  LinkBench bench;
  const auto endpoint = bench.loop().listen(listening(GetParam()));
  const LinkId link = bench.loop().connect(connecting(GetParam(), endpoint));
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).is_open && bench.accepted().size() == 1; }));
  const LinkId server = bench.accepted()[0];
  bench.loop().send(server, std::make_shared<const std::string>(sample(100'000)));
  bench.loop().close(server, std::string(200, 'w'));
  bench.loop().close(server, "Twice.");
  bench.loop().send(server, std::make_shared<const std::string>("Too late."));
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).is_over && bench.of(server).is_over; }));
  EXPECT_TRUE(bench.of(link).last == sample(100'000));
  EXPECT_EQ(bench.of(link).frames, 1U);
  EXPECT_TRUE(says(bench.of(link).why, std::string(123, 'w')));
  EXPECT_EQ(bench.of(server).why, std::string(200, 'w'));
}

TEST_P(LinkLoopTest, CallbacksMayCloseAndConnect) {
  LinkBench bench;
  const auto endpoint = bench.loop().listen(listening(GetParam()));
  int opened = 0;
  bench.on_opened = [&](LinkId link) {
    if (!bench.of(link).peer.is_ours) return;
    bench.loop().close(link, "At once.");
    if (++opened < 5) bench.loop().connect(connecting(GetParam(), endpoint));
  };
  bench.loop().connect(connecting(GetParam(), endpoint));
  EXPECT_TRUE(bench.run_until(
      [&] { return opened == 5 && bench.open_count(true) == 0 && bench.open_count(false) == 0; }));
  for (const auto& [link, notes] : bench.all()) EXPECT_EQ(notes.calls_after_end, 0);
}

TEST_P(LinkLoopTest, ClosingBeforeItIsOpenIsHeardOf) {
  LinkBench bench;
  const auto endpoint = bench.loop().listen(listening(GetParam()));
  const LinkId link = bench.loop().connect(connecting(GetParam(), endpoint));
  bench.loop().close(link, "Changed our mind.");
  EXPECT_FALSE(bench.of(link).is_over);
  ASSERT_TRUE(bench.run_until_over(link));
  EXPECT_FALSE(bench.of(link).is_open);
  EXPECT_EQ(bench.of(link).why, "Changed our mind.");
}

TEST_P(LinkLoopTest, LoopMayBeDestroyedWithOpenConnections) {
  for (int i = 0; i < 20; ++i) {
    LinkBench bench;
    const auto endpoint = bench.loop().listen(listening(GetParam()));
    std::vector<LinkId> links;
    for (int k = 0; k < 4; ++k) links.push_back(bench.loop().connect(connecting(GetParam(), endpoint)));
    if (i % 4 == 1) bench.run_for(1ms);
    if (i % 4 == 2) bench.run_until_open(links[0]);
    if (i % 4 == 3) {
      bench.run_until([&] { return bench.open_count(true) == 4; });
      for (const LinkId link : links) bench.send(link, sample(1U << 20U));
      if (i % 8 == 3) bench.loop().close(links[0], "Half way.");
      bench.run_for(1ms);
    }
    bench.destroy_loop();
  }
}

TEST_P(LinkLoopTest, StoppedByAnotherThreadWhileItSends) {
  LinkBench bench;
  const auto endpoint = bench.loop().listen(listening(GetParam()));
  const LinkId link = bench.loop().connect(connecting(GetParam(), endpoint));
  ASSERT_TRUE(bench.run_until_open(link));
  bench.on_frame = [&](LinkId from, std::string_view) { bench.send(from, sample(200'000)); };
  bench.send(link, sample(200'000));
  for (int i = 0; i < 5; ++i) {
    std::atomic<bool> enough = false;
    std::thread stopper([&] {
      while (!enough) std::this_thread::sleep_for(1ms);
      bench.loop().stop();
    });
    bench.loop().after(1ms, [&] { enough = true; });
    bench.loop().run();
    stopper.join();
  }
  const std::size_t before = bench.of(link).frames;
  EXPECT_TRUE(bench.run_until([&] { return bench.of(link).frames > before + 2; }));
}

INSTANTIATE_TEST_SUITE_P(Wires, LinkLoopTest, testing::Values(Wired::Plain, Wired::Tls),
                         [](const auto& it) { return it.param == Wired::Plain ? "Plain" : "Tls"; });

// ---- Work and times ----

TEST(LinkLoopWork, IsDoneInTheOrderOfTheCalls) {
  LinkBench bench;
  std::vector<int> done;
  for (int i = 0; i < 100; ++i) bench.loop().post([&done, i] { done.push_back(i); });
  std::thread other([&] {
    for (int i = 100; i < 200; ++i) bench.loop().post([&done, i] { done.push_back(i); });
  });
  other.join();
  ASSERT_TRUE(bench.run_until([&] { return done.size() == 200; }));
  for (int i = 0; i < 200; ++i) EXPECT_EQ(done[std::size_t(i)], i);
}

TEST(LinkLoopWork, ComesAfterItsDelayAndOnce) {
  LinkBench bench;
  const auto start = std::chrono::steady_clock::now();
  std::vector<int> done;
  bench.loop().after(40ms, [&] { done.push_back(2); });
  bench.loop().after(20ms, [&] {
    done.push_back(1);
    EXPECT_GE(std::chrono::steady_clock::now() - start, 20ms);
  });
  ASSERT_TRUE(bench.run_until([&] { return done.size() == 2; }));
  EXPECT_EQ(done, (std::vector<int>{1, 2}));
}

TEST(LinkLoopWork, StopBeforeRunIsNotForgotten) {
  LinkBench bench;
  bench.loop().stop();
  bench.loop().run();
  bool has_run = false;
  bench.loop().post([&] { has_run = true; });
  EXPECT_TRUE(bench.run_until([&] { return has_run; }));
}

// ---- Who is let in, and whom we trust ----

class LinkTrustTest : public LinkLoopTest {
 protected:
  /// The sentence of a connection that must not come about.
  static std::string refusal(const ConnectSettings& settings, LinkBench& bench) {
    const LinkId link = bench.loop().connect(settings);
    EXPECT_TRUE(bench.run_until([&] { return bench.of(link).is_open || bench.of(link).is_over; }));
    EXPECT_FALSE(bench.of(link).is_open);
    return bench.of(link).why;
  }
};

TEST_F(LinkTrustTest, AnotherFingerprintIsRefused) {
  LinkBench bench;
  ConnectSettings settings = connecting(Wired::Tls, bench.loop().listen(listening(Wired::Tls)));
  settings.fingerprint.back() = settings.fingerprint.back() == '0' ? '1' : '0';
  const std::string why = refusal(settings, bench);
  EXPECT_TRUE(says(why, "its certificate is not the one of the link, so somebody may be in between")) << why;
  EXPECT_TRUE(says(why, shown(settings.endpoint))) << why;
  EXPECT_TRUE(bench.accepted().empty());
}

TEST_F(LinkTrustTest, NoFingerprintAndNoAuthorityIsRefused) {
  LinkBench bench;
  ConnectSettings settings = connecting(Wired::Tls, bench.loop().listen(listening(Wired::Tls)));
  settings.fingerprint.clear();
  EXPECT_TRUE(says(refusal(settings, bench), "no authority"));
}

TEST_F(LinkTrustTest, NoFingerprintAtAllIsSaid) {
  LinkBench bench;
  ConnectSettings settings = connecting(Wired::Tls, bench.loop().listen(listening(Wired::Tls)));
  for (const char* text : {"sha256:", "md5:00", "sha256:zz", "nonsense"}) {
    settings.fingerprint = text;
    EXPECT_TRUE(says(refusal(settings, bench), "no fingerprint")) << text;
  }
  settings.fingerprint = certificates->fingerprint + "0";
  EXPECT_TRUE(says(refusal(settings, bench), "no fingerprint"));
}

TEST_F(LinkTrustTest, ReplacedCertificateIsRefused) {
  const CertificateFolder replaced;
  LinkBench bench;
  ListenSettings listen = listening(Wired::Tls);
  listen.certificate = replaced.certificate;
  listen.key = replaced.key;
  EXPECT_TRUE(
      says(refusal(connecting(Wired::Tls, bench.loop().listen(listen)), bench), "not the one of the link"));
}

TEST_F(LinkTrustTest, AuthorityCountsForItsHostOnly) {
  ::setenv("SSL_CERT_FILE", certificates->certificate.c_str(), 1);
  LinkBench bench;
  ConnectSettings settings = connecting(Wired::Tls, bench.loop().listen(listening(Wired::Tls)));
  settings.fingerprint.clear();
  const LinkId link = bench.loop().connect(settings);
  EXPECT_TRUE(bench.run_until_open(link)) << bench.of(link).why;
  // 127.0.0.2 leads to the same computer, but the certificate does not name it.
  ListenSettings elsewhere = listening(Wired::Tls);
  elsewhere.endpoint.host = "127.0.0.2";
  settings.endpoint = bench.loop().listen(elsewhere).value();
  EXPECT_TRUE(says(refusal(settings, bench), "no authority"));
  settings.fingerprint = certificates->fingerprint;
  const LinkId pinned = bench.loop().connect(settings);
  EXPECT_TRUE(bench.run_until_open(pinned)) << bench.of(pinned).why;
  ::unsetenv("SSL_CERT_FILE");
}

TEST_F(LinkTrustTest, WithoutTlsOnTheLoopbackOnly) {
  LinkBench bench;
  for (const char* host : {"0.0.0.0", "::", "192.0.2.1"}) {
    ListenSettings settings = listening(Wired::Plain);
    settings.endpoint.host = host;
    const auto listened = bench.loop().listen(settings);
    ASSERT_FALSE(listened) << host;
    EXPECT_TRUE(says(listened.error().message, "without a certificate")) << listened.error().message;
  }
  ListenSettings settings = listening(Wired::Plain);
  settings.endpoint.host = "localhost";
  EXPECT_TRUE(bench.loop().listen(settings));
  ConnectSettings far;
  far.endpoint = {"192.0.2.1", 9};
  far.tls = false;
  EXPECT_TRUE(says(refusal(far, bench), "must be encrypted"));
}

TEST_F(LinkTrustTest, ListeningThatFailsSaysWhy) {
  LinkBench bench;
  ListenSettings settings = listening(Wired::Tls);
  settings.key = certificates->path / "none.pem";
  EXPECT_TRUE(says(bench.loop().listen(settings).error().message, "none.pem: holds no key"));
  settings.key = settings.certificate;
  EXPECT_FALSE(bench.loop().listen(settings));
  const CertificateFolder other;
  settings.key = other.key;
  EXPECT_FALSE(bench.loop().listen(settings));
  settings = listening(Wired::Tls);
  settings.endpoint.port = bench.loop().listen(settings)->port;
  const auto twice = bench.loop().listen(settings);
  ASSERT_FALSE(twice);
  EXPECT_TRUE(says(twice.error().message, "cannot be listened at (Address already in use)"));
  settings.endpoint.host = "no such host";
  EXPECT_FALSE(bench.loop().listen(settings));
}

TEST_F(LinkTrustTest, ConnectingThatFailsSaysWhy) {
  LinkBench bench;
  ConnectSettings settings;
  {
    LinkBench gone;
    settings.endpoint = gone.loop().listen(listening(Wired::Tls)).value();
  }
  EXPECT_EQ(
      refusal(settings, bench),
      shown(settings.endpoint) + ": refuses the connection; start the server there, or correct the address.");
  settings.endpoint.host = "no-such-computer.invalid";
  const std::string unknown = refusal(settings, bench);
  EXPECT_TRUE(says(unknown, "no-such-computer.invalid:")) << unknown;
  settings.endpoint = bench.loop().listen(listening(Wired::Plain)).value();
  EXPECT_TRUE(says(refusal(settings, bench), "does not agree on TLS"));
  settings.endpoint = bench.loop().listen(listening(Wired::Tls)).value();
  settings.tls = false;
  EXPECT_TRUE(says(refusal(settings, bench), "no ICOME server") ||
              says(refusal(settings, bench), "is not an ICOME"));
  settings.endpoint = bench.loop()
                          .listen_http({},
                                       [](std::string_view) {
                                         return HttpAnswer{404, "text/plain", "none"};
                                       })
                          .value();
  const std::string http = refusal(settings, bench);
  EXPECT_TRUE(says(http, "is not an ICOME server (it answers by HTTP status 404)")) << http;
}

TEST_F(LinkTrustTest, ServerThatDoesNotAnswerIsGivenUp) {
  Relay silent(9);
  LinkBench bench;
  ConnectSettings settings;
  settings.endpoint.port = silent.port;
  settings.handshake_time = 50ms;
  EXPECT_TRUE(says(refusal(settings, bench), "does not answer as it should within 0.05 s"));
}

TEST_F(LinkTrustTest, ConnectionsOfAnAddressAreLimited) {
  LinkBench bench;
  ListenSettings listen = listening(Wired::Tls);
  listen.most_links_an_address = 3;
  const ConnectSettings settings = connecting(Wired::Tls, bench.loop().listen(listen));
  std::vector<RawSocket> half_open;
  half_open.emplace_back(settings.endpoint.port);
  half_open.emplace_back(settings.endpoint.port);
  bench.run_for(20ms);
  const LinkId link = bench.loop().connect(settings);
  ASSERT_TRUE(bench.run_until_open(link)) << bench.of(link).why;
  const std::string why = refusal(settings, bench);
  EXPECT_TRUE(says(why, "may be full")) << why;
  half_open.pop_back();
  // Its place is free as soon as the server has seen its end.
  LinkId next = bench.loop().connect(settings);
  EXPECT_TRUE(bench.run_until([&] {
    if (bench.of(next).is_over) next = bench.loop().connect(settings);
    return bench.of(next).is_open;
  }));
}

TEST_F(LinkTrustTest, AllConnectionsAreLimited) {
  LinkBench bench;
  ListenSettings listen = listening(Wired::Plain);
  listen.most_links = 2;
  const ConnectSettings settings = connecting(Wired::Plain, bench.loop().listen(listen));
  ASSERT_TRUE(bench.run_until_open(bench.loop().connect(settings)));
  const LinkId second = bench.loop().connect(settings);
  ASSERT_TRUE(bench.run_until_open(second));
  EXPECT_TRUE(says(refusal(settings, bench), "may be full"));
  bench.loop().close(second, "Makes room.");
  ASSERT_TRUE(bench.run_until([&] { return bench.open_count(false) == 1; }));
  EXPECT_TRUE(bench.run_until_open(bench.loop().connect(settings)));
}

// ---- Ends ----

TEST_F(LinkTrustTest, ServerThatIsKilledIsNoticed) {
  LinkBench bench;
  Relay relay(bench.loop().listen(listening(Wired::Tls))->port);
  bench.meanwhile = [&] { relay.pump(); };
  const LinkId link = bench.loop().connect(connecting(Wired::Tls, Endpoint{"127.0.0.1", relay.port}));
  ASSERT_TRUE(bench.run_until_open(link)) << bench.of(link).why;
  bench.send(link, "before");
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).frames == 1; }));
  bench.meanwhile = nullptr;
  relay.reset();
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).is_over && bench.open_count(false) == 0; }));
  EXPECT_TRUE(says(bench.of(link).why, "broke off")) << bench.of(link).why;
}

TEST_F(LinkTrustTest, PeerThatAnswersNoPingIsGivenUp) {
  LinkBench bench;
  ListenSettings listen = listening(Wired::Tls);
  listen.idle_time = 200ms;
  Relay relay(bench.loop().listen(listen)->port);
  bench.meanwhile = [&] { relay.pump(); };
  const LinkId link = bench.loop().connect(connecting(Wired::Tls, Endpoint{"127.0.0.1", relay.port}));
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).is_open && bench.accepted().size() == 1; }));
  const LinkId server = bench.accepted()[0];
  relay.is_silent = true;
  // Sending all the while is no sign that somebody is there.
  bench.meanwhile = [&] {
    relay.pump();
    if (!bench.of(server).is_sending) bench.send(server, "still there?");
  };
  ASSERT_TRUE(bench.run_until_over(server));
  EXPECT_TRUE(says(bench.of(server).why, "not even the answer to a ping")) << bench.of(server).why;
}

TEST_F(LinkTrustTest, PeerThatAnswersPingsStays) {
  LinkBench bench;
  ListenSettings listen = listening(Wired::Tls);
  listen.idle_time = 400ms;
  const LinkId link = bench.loop().connect(connecting(Wired::Tls, bench.loop().listen(listen)));
  ASSERT_TRUE(bench.run_until_open(link));
  bench.run_for(2s);
  EXPECT_FALSE(bench.of(link).is_over) << bench.of(link).why;
  bench.send(link, "here");
  EXPECT_TRUE(bench.run_until([&] { return bench.of(link).frames == 1; }));
}

TEST_F(LinkTrustTest, SendingToWhoReadsNothingStops) {
  LinkBench bench;
  Relay relay(bench.loop().listen(listening(Wired::Tls))->port);
  bench.meanwhile = [&] { relay.pump(); };
  const LinkId link = bench.loop().connect(connecting(Wired::Tls, Endpoint{"127.0.0.1", relay.port}));
  ASSERT_TRUE(bench.run_until([&] { return bench.of(link).is_open && bench.accepted().size() == 1; }));
  const LinkId server = bench.accepted()[0];
  relay.is_silent = true;
  // The system keeps what the other side's window lets it send, and little more.
  constexpr std::size_t kMostFrames = 1000;
  for (std::size_t i = 0; i < kMostFrames; ++i) bench.send(server, sample(100'000));
  std::size_t before = 0;
  ASSERT_TRUE(bench.run_until([&] { return bench.of(server).to_send.size() < kMostFrames - 1; }));
  do {
    before = bench.of(server).to_send.size();
    bench.run_for(100ms);
  } while (bench.of(server).to_send.size() < before);
  EXPECT_GT(before, kMostFrames / 2);
  EXPECT_TRUE(bench.of(server).is_sending);
  EXPECT_FALSE(bench.of(server).is_over);
}

TEST_F(LinkTrustTest, PeerThatDoesNotSayGoodbyeIsLeftInASecond) {
  LinkBench bench;
  Relay relay(bench.loop().listen(listening(Wired::Tls))->port);
  bench.meanwhile = [&] { relay.pump(); };
  const LinkId link = bench.loop().connect(connecting(Wired::Tls, Endpoint{"127.0.0.1", relay.port}));
  ASSERT_TRUE(bench.run_until_open(link));
  relay.is_silent = true;
  bench.loop().close(link, "We leave.");
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(bench.run_until_over(link));
  EXPECT_EQ(bench.of(link).why, "We leave.");
  EXPECT_GE(std::chrono::steady_clock::now() - start, 900ms);
}

}  // namespace
}  // namespace icome::collab
