#include "collab/link/link_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cassert>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/terminal_text.h"
#include "base/utf8.h"
#include "collab/link/wire/frame_in_part.h"
#include "collab/link/wire/http_listener.h"
#include "collab/link/wire/listening_socket.h"
#include "collab/link/wire/tls_context.h"
#include "collab/link/wire/wire_stream.h"

namespace icome::collab {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Acceptor = asio::basic_socket_acceptor<Tcp, Executor>;
using Resolver = asio::ip::basic_resolver<Tcp, Executor>;

constexpr char kPath[] = "/icome";
constexpr std::size_t kMostOfUpgrade = 8192;            // the header of a request to upgrade
constexpr std::size_t kServerPieceBytes = 4 * 16'384;   // of a longer frame; pings go between two
constexpr std::size_t kClientPieceBytes = 16'384 - 14;  // with its header one record
constexpr std::chrono::milliseconds kRestWithoutDescriptors{100};

// ---- One connection ----

std::string shown_address(const Tcp::endpoint& address) {
  return shown_endpoint({address.address().to_string(), address.port()});
}

std::string shown_seconds(std::chrono::milliseconds time) {
  return fmt::format("{:g} s", 1e-3 * time.count());
}

/// What fits into the last word of a WebSocket connection, cut between two letters.
std::string_view fitting_reason(std::string_view text) {
  constexpr std::size_t kMostOfReason = 123;
  std::size_t size = 0;
  while (size < text.size()) {
    const std::size_t letter = base::utf8_length(text.substr(size));
    if (letter == 0 || size + letter > kMostOfReason) break;
    size += letter;
  }
  return text.substr(0, size);
}

class LinkListener;
class WebLink;

/// What connections have in common; outlives them, but for what they wait for.
struct LinkShares {
  explicit LinkShares(LinkEvents& given) : events(given) {}

  asio::io_context context;
  LinkEvents& events;
  Scratch scratch = {};
  std::optional<TlsContext> client_tls = {};  // of the first connection that needs it
  std::unordered_map<LinkId, std::shared_ptr<WebLink>> links = {};
  LinkId last_id = 0;
  std::uint64_t distrusted = 0;
};

/// One connection, of either side: begins, carries frames, ends. Owned by the loop's table until it is over,
/// and by what waits for its socket.
class WebLink : public std::enable_shared_from_this<WebLink> {
 public:
  struct Limits {
    std::size_t most_frame_bytes;
    std::chrono::milliseconds handshake_time;
    std::chrono::milliseconds idle_time;
  };

  WebLink(LinkShares& shares, LinkId id, const Limits& limits)
      : shares_(shares),
        id_(id),
        limits_(limits),
        stream_(shares.context.get_executor(), shares.scratch),
        timer_(shares.context.get_executor()) {}

  void begin_accepted(std::shared_ptr<LinkListener> listener, const Tcp::endpoint& remote, Socket socket);
  void begin_connecting(const ConnectSettings& settings);
  void send(SharedBytes frame);
  void close(const std::string& why);

 private:
  enum class State { Starting, Open, Closing, Over };
  struct Upgrade {
    beast::flat_buffer buffer{kMostOfUpgrade};
    http::request_parser<http::empty_body> parser;
  };
  /// Calls a member with what the loop gives, unless the connection is over by then.
  template <typename... Given>
  auto then(void (WebLink::*member)(Given...)) {
    return [self = shared_from_this(), member](Given... given) {
      if (self->state_ != State::Over) (self.get()->*member)(given...);
    };
  }

  Wire& wire() { return stream_.next_layer(); }
  void belong();
  void tune_stream(std::size_t piece_bytes);
  void arm(std::chrono::milliseconds time);
  void on_time();
  void check_idle();
  void ping();

  void on_server_hands(LinkError error, std::size_t nothing);
  void read_request();
  void on_request(LinkError error, std::size_t size);
  void refuse(http::status status, const char* why);
  void on_upgraded(LinkError error);

  void look_up();
  void connect_to(const std::vector<Tcp::endpoint>& places);
  void on_connected(LinkError error, const Tcp::endpoint& place);
  void on_client_hands(LinkError error, std::size_t nothing);
  void ask_to_upgrade();
  std::string connecting_trouble(LinkError error) const;
  std::string tls_trouble(LinkError error);

  void opened();
  void read_next();
  void on_read(LinkError error, std::size_t size);
  void on_sent(LinkError error);
  void say_goodbye();
  std::string open_trouble(LinkError error);
  void over(const std::string& why);

  LinkShares& shares_;
  const LinkId id_;
  const Limits limits_;
  State state_ = State::Starting;
  bool was_open_ = false;
  bool is_sending_ = false;
  bool is_pinging_ = false;
  std::uint32_t timer_turn_ = 0;               // a timer that was set anew may have called already
  std::string name_;                           // of the other side, as sentences have it
  std::string why_;                            // it ends: Closing
  std::shared_ptr<LinkListener> listener_;     // null: ours
  std::uint64_t network_ = 0;                  // that it came from, as its listener counts
  std::unique_ptr<ConnectSettings> settings_;  // until it is open; null: not ours
  std::unique_ptr<Upgrade> upgrade_;           // until it is open; null: ours
  websocket::stream<Wire, false> stream_;
  Timer timer_;
  FrameInPart frame_;
};

/// Accepts connections and counts them. Owned by the loop and by its connections.
class LinkListener : public std::enable_shared_from_this<LinkListener> {
 public:
  LinkListener(LinkShares& shares, const ListeningSocket& socket, ListenSettings settings,
               std::optional<TlsContext> tls)
      : shares_(shares),
        settings_(std::move(settings)),
        tls_(std::move(tls)),
        acceptor_(shares.context.get_executor(), socket.is_v6 ? Tcp::v6() : Tcp::v4(), socket.descriptor),
        rest_(shares.context.get_executor()) {}

  void accept_next();
  void leave(std::uint64_t network);
  const TlsContext* tls() const { return tls_ ? &*tls_ : nullptr; }
  bool lets_in(const http::request<http::empty_body>& request) const;

 private:
  void on_accepted(Socket socket);
  bool enter(std::uint64_t network);

  LinkShares& shares_;
  const ListenSettings settings_;
  const std::optional<TlsContext> tls_;  // nothing: without TLS
  Acceptor acceptor_;
  Timer rest_;
  Tcp::endpoint remote_;  // of the next
  std::size_t count_ = 0;
  std::unordered_map<std::uint64_t, std::size_t> counts_;  // by network
};

// ---- Accepting ----

/// A number for the network that an address is counted by. Who has IPv6 has 2^64 addresses.
std::uint64_t network_of(const asio::ip::address& address) {
  constexpr std::uint64_t kVersion4 = std::uint64_t{0xFFFF} << 32U;
  if (address.is_v4()) return kVersion4 | address.to_v4().to_uint();
  const asio::ip::address_v6 v6 = address.to_v6();
  if (v6.is_v4_mapped()) return kVersion4 | asio::ip::make_address_v4(asio::ip::v4_mapped, v6).to_uint();
  std::uint64_t network = 0;
  const auto bytes = v6.to_bytes();
  for (std::size_t i = 0; i < 8; ++i) network = network << 8U | bytes[i];
  return network;
}

bool LinkListener::enter(std::uint64_t network) {
  if (count_ >= settings_.most_links) return false;
  std::size_t& of_network = counts_[network];
  if (of_network >= settings_.most_links_an_address) return false;
  ++of_network;
  ++count_;
  return true;
}

void LinkListener::leave(std::uint64_t network) {
  --count_;
  const auto it = counts_.find(network);
  if (--it->second == 0) counts_.erase(it);
}

bool LinkListener::lets_in(const http::request<http::empty_body>& request) const {
  const auto [first, last] = request.equal_range(http::field::origin);
  return std::all_of(first, last, [&](const auto& field) {
    const std::string_view origin(field.value().data(), field.value().size());
    return std::find(settings_.origins.begin(), settings_.origins.end(), origin) != settings_.origins.end();
  });
}

void LinkListener::accept_next() {
  acceptor_.async_accept(remote_, [self = shared_from_this()](LinkError error, Socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) self->on_accepted(std::move(socket));
    if (!error || error == asio::error::connection_aborted) return self->accept_next();
    // Without descriptors it would fail again at once: those who wait do so in the system.
    self->rest_.expires_after(kRestWithoutDescriptors);
    self->rest_.async_wait([self](LinkError stopped) {
      if (!stopped) self->accept_next();
    });
  });
}

void LinkListener::on_accepted(Socket socket) {
  const std::uint64_t network = network_of(remote_.address());
  if (!enter(network)) return;  // which closes the socket
  const LinkId id = ++shares_.last_id;
  const WebLink::Limits limits = {settings_.most_frame_bytes, settings_.handshake_time, settings_.idle_time};
  const auto link = std::make_shared<WebLink>(shares_, id, limits);
  shares_.links.emplace(id, link);
  link->begin_accepted(shared_from_this(), remote_, std::move(socket));
}

void WebLink::begin_accepted(std::shared_ptr<LinkListener> listener, const Tcp::endpoint& remote,
                             Socket socket) {
  listener_ = std::move(listener);
  network_ = network_of(remote.address());
  name_ = shown_address(remote);
  wire().socket() = std::move(socket);
  belong();
  wire().start(limits_.idle_time);
  arm(limits_.handshake_time);
  if (listener_->tls() == nullptr) return read_request();
  if (!wire().channel().start_server(*listener_->tls()))
    return asio::post(shares_.context, [self = shared_from_this()] { self->over("Memory is wanting."); });
  wire().async_shake_hands(then(&WebLink::on_server_hands));
}

void WebLink::on_server_hands(LinkError error, std::size_t /*nothing*/) {
  if (error) return over(name_ + " did not agree on TLS.");
  read_request();
}

void WebLink::read_request() {
  upgrade_ = std::make_unique<Upgrade>();
  upgrade_->parser.header_limit(std::uint32_t(kMostOfUpgrade));
  http::async_read_header(wire(), upgrade_->buffer, upgrade_->parser, then(&WebLink::on_request));
}

void WebLink::on_request(LinkError error, std::size_t /*size*/) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return refuse(http::status::request_header_fields_too_large, "The request is too long.\n");
  const bool is_ended = error == http::error::end_of_stream || error == http::error::partial_message;
  if (!is_ended && error.category() == http::make_error_code(http::error::bad_method).category())
    return refuse(http::status::bad_request, "This is no HTTP request.\n");
  if (error) return over(name_ + " left without a request.");
  const http::request<http::empty_body>& request = upgrade_->parser.get();
  const beast::string_view target = request.target();
  if (target.substr(0, target.find('?')) != kPath)
    return refuse(http::status::not_found, "There is nothing here.\n");
  if (!listener_->lets_in(request))
    return refuse(http::status::forbidden, "Pages from there are not let in.\n");
  if (upgrade_->buffer.size() > 0)
    return refuse(http::status::bad_request, "Something came before its turn.\n");
  tune_stream(kServerPieceBytes);
  stream_.set_option(websocket::stream_base::decorator(
      [](websocket::response_type& response) { response.set(http::field::server, "icome"); }));
  stream_.async_accept(request, then(&WebLink::on_upgraded));
}

void WebLink::refuse(http::status status, const char* why) {
  const auto answer = std::make_shared<http::response<http::string_body>>(status, 11);
  answer->set(http::field::server, "icome");
  answer->set(http::field::content_type, "text/plain; charset=utf-8");
  answer->set(http::field::connection, "close");
  answer->body() = why;
  answer->prepare_payload();
  http::async_write(wire(), *answer, [self = shared_from_this(), answer](LinkError error, std::size_t) {
    if (self->state_ == State::Over) return;
    if (error) return self->over(self->name_ + " was refused.");
    async_teardown(beast::role_type::server, self->wire(),
                   [self](LinkError /*none*/) { self->over(self->name_ + " was refused."); });
  });
}

void WebLink::on_upgraded(LinkError error) {
  if (error) return over(name_ + " did not ask for a WebSocket.");
  opened();
}

// ---- Connecting ----

void WebLink::begin_connecting(const ConnectSettings& settings) {
  settings_ = std::make_unique<ConnectSettings>(settings);
  name_ = shown_endpoint(settings.endpoint);
  belong();
  arm(limits_.handshake_time);
  asio::post(shares_.context, then(&WebLink::look_up));
}

void WebLink::look_up() {
  if (!settings_->fingerprint.empty() && !parse_fingerprint(settings_->fingerprint))
    return over(
        fmt::format("{}: the link holds no fingerprint of a certificate (\"sha256:\" and 64 digits); "
                    "copy all of it.",
                    name_));
  LinkError no_number;
  const asio::ip::address number = asio::ip::make_address(settings_->endpoint.host, no_number);
  if (!no_number) return connect_to({Tcp::endpoint(number, settings_->endpoint.port)});
  const auto resolver = std::make_shared<Resolver>(shares_.context.get_executor());
  resolver->async_resolve(
      settings_->endpoint.host, std::to_string(settings_->endpoint.port), Resolver::numeric_service,
      [self = shared_from_this(), resolver](LinkError error, const Resolver::results_type& found) {
        if (self->state_ == State::Over) return;
        if (error) return self->over(self->connecting_trouble(error));
        self->connect_to({found.begin(), found.end()});
      });
}

void WebLink::connect_to(const std::vector<Tcp::endpoint>& places) {
  const auto is_far = [](const Tcp::endpoint& place) { return !place.address().is_loopback(); };
  if (!settings_->tls && std::any_of(places.begin(), places.end(), is_far))
    return over(name_ + ": is another computer, where everything must be encrypted; use TLS.");
  asio::async_connect(wire().socket(), places, then(&WebLink::on_connected));
}

void WebLink::on_connected(LinkError error, const Tcp::endpoint& place) {
  if (error) return over(connecting_trouble(error));
  wire().start(limits_.idle_time);
  if (!settings_->tls) return ask_to_upgrade();
  if (!shares_.client_tls) {
    base::Result<TlsContext> made = TlsContext::for_client();
    if (!made) return over(made.error().message);
    shares_.client_tls = std::move(*made);
  }
  const ServerTrust trust = {settings_->endpoint.host, parse_fingerprint(settings_->fingerprint)};
  if (!wire().channel().start_client(*shares_.client_tls, trust))
    return over(fmt::format("{}: TLS cannot be used with {}.", name_, shown_address(place)));
  wire().async_shake_hands(then(&WebLink::on_client_hands));
}

void WebLink::on_client_hands(LinkError error, std::size_t /*nothing*/) {
  if (error) return over(tls_trouble(error));
  ask_to_upgrade();
}

void WebLink::ask_to_upgrade() {
  tune_stream(kClientPieceBytes);
  const auto response = std::make_shared<websocket::response_type>();
  stream_.async_handshake(*response, name_, kPath, [self = shared_from_this(), response](LinkError error) {
    if (self->state_ == State::Over) return;
    if (!error) return self->opened();
    if (error == asio::error::eof || error == asio::error::connection_reset ||
        error == http::error::end_of_stream)
      return self->over(self->name_ +
                        ": ended the connection before it began; it may be full, or no ICOME server.");
    const std::string status = error == websocket::error::upgrade_declined
                                   ? fmt::format("it answers by HTTP status {}", response->result_int())
                                   : error.message();
    self->over(fmt::format("{}: is not an ICOME server ({}); correct the address.", self->name_, status));
  });
}

std::string WebLink::connecting_trouble(LinkError error) const {
  if (error == asio::error::connection_refused)
    return name_ + ": refuses the connection; start the server there, or correct the address.";
  if (error == asio::error::host_not_found || error == asio::error::no_data)
    return name_ + ": there is no computer of that name; correct the address.";
  return fmt::format("{}: cannot be reached ({}); check the network and the address.", name_,
                     error.message());
}

std::string WebLink::tls_trouble(LinkError error) {
  if (wire().channel().was_certificate_refused()) ++shares_.distrusted;
  if (wire().channel().was_certificate_refused())
    return name_ + (settings_->fingerprint.empty() ? ": no authority that this computer trusts vouches for "
                                                     "its certificate, so somebody may be in "
                                                     "between; use a link that holds its fingerprint."
                                                   : ": its certificate is not the one of the link, so "
                                                     "somebody may be in between; ask for a new "
                                                     "link.");
  if (error == asio::error::eof || error == asio::error::connection_reset)
    return name_ + ": ended the connection before TLS began; it may be full, or no ICOME server.";
  const std::string& found = wire().channel().trouble();
  return fmt::format("{}: does not agree on TLS 1.2 or newer ({}); is it an ICOME server?", name_,
                     found.empty() ? error.message() : found);
}

// ---- Open ----

void WebLink::belong() { wire().belong_to(weak_from_this()); }

void WebLink::tune_stream(std::size_t piece_bytes) {
  stream_.read_message_max(std::max<std::size_t>(1, limits_.most_frame_bytes));  // 0 would be any
  stream_.binary(true);
  stream_.auto_fragment(true);
  stream_.write_buffer_bytes(piece_bytes);
}

void WebLink::opened() {
  if (state_ != State::Starting) return;  // close() came first
  const Peer peer = {name_, listener_ == nullptr};
  state_ = State::Open;
  was_open_ = true;
  upgrade_.reset();
  settings_.reset();
  arm(limits_.idle_time / 2);
  shares_.events.opened(id_, peer);
  if (state_ == State::Open) read_next();
}

void WebLink::read_next() {
  stream_.async_read_some(frame_.room(limits_.most_frame_bytes), then(&WebLink::on_read));
}

void WebLink::on_read(LinkError error, std::size_t size) {
  if (state_ != State::Open) return;
  if (error) return over(open_trouble(error));
  frame_.add(size);
  if (stream_.got_text()) return close(name_ + " sent text, where frames are bytes.");
  if (stream_.is_message_done()) {
    shares_.events.received(id_, frame_.view());
    if (state_ != State::Open) return;
    frame_.clear();
  }
  read_next();
}

void WebLink::send(SharedBytes frame) {
  if (state_ != State::Open) return;
  assert(!is_sending_ && "the frame before was not sent yet");
  is_sending_ = true;
  const asio::const_buffer bytes = asio::buffer(*frame);
  stream_.async_write(
      bytes, [self = shared_from_this(), kept = std::move(frame)](LinkError error, std::size_t /*size*/) {
        if (self->state_ != State::Over) self->on_sent(error);
      });
}

void WebLink::on_sent(LinkError error) {
  is_sending_ = false;
  if (state_ == State::Closing) return say_goodbye();
  if (error) return over(open_trouble(error));
  shares_.events.sent(id_);
}

void WebLink::close(const std::string& why) {
  if (state_ == State::Closing || state_ == State::Over) return;
  const bool was_open = state_ == State::Open;
  state_ = State::Closing;
  why_ = why;
  if (!was_open) return asio::post(shares_.context, [self = shared_from_this()] { self->over(self->why_); });
  arm(kMostClosing);
  if (!is_sending_) say_goodbye();  // or else it would come between two pieces of a frame
}

void WebLink::say_goodbye() {
  const std::string_view reason = fitting_reason(why_);
  const websocket::close_reason last_words(websocket::close_code::normal,
                                           beast::string_view(reason.data(), reason.size()));
  stream_.async_close(last_words, [self = shared_from_this()](LinkError /*any*/) { self->over(self->why_); });
}

std::string WebLink::open_trouble(LinkError error) {
  if (error == websocket::error::closed) {
    const websocket::close_reason& said = stream_.reason();
    if (said.reason.empty()) return name_ + " has ended the connection.";
    return fmt::format("{} has ended the connection: {}", name_,
                       base::terminal_text({said.reason.data(), said.reason.size()}));
  }
  if (error == websocket::error::message_too_big || error == websocket::error::buffer_overflow)
    return fmt::format("{} sent a frame of more than {} bytes, so the connection was ended.", name_,
                       limits_.most_frame_bytes);
  if (error.category() == make_error_code(websocket::error::closed).category())
    return fmt::format("{} does not keep to the WebSocket protocol ({}), so the connection was ended.", name_,
                       error.message());
  const std::string& found = wire().channel().trouble();
  return fmt::format("The connection with {} broke off ({}).", name_,
                     found.empty() ? error.message() : found);
}

/// The last call of every connection, from the loop only: it may call out.
void WebLink::over(const std::string& why) {
  if (state_ == State::Over) return;
  const std::shared_ptr<WebLink> alive = shared_from_this();
  const bool is_known = was_open_ || listener_ == nullptr;
  state_ = State::Over;
  ++timer_turn_;
  timer_.cancel();
  wire().close();
  if (listener_) listener_->leave(network_);
  shares_.links.erase(id_);
  if (is_known) shares_.events.closed(id_, why);
}

// ---- Time ----

void WebLink::arm(std::chrono::milliseconds time) {
  timer_.expires_after(time);
  timer_.async_wait([self = shared_from_this(), turn = ++timer_turn_](LinkError error) {
    if (!error && turn == self->timer_turn_) self->on_time();
  });
}

void WebLink::on_time() {
  switch (state_) {
    case State::Starting:
      return over(
          fmt::format("{}: does not answer as it should within {}; check the address and the network.", name_,
                      shown_seconds(limits_.handshake_time)));
    case State::Open:
      return check_idle();
    case State::Closing:
      return over(why_);
    case State::Over:
      return;
  }
}

/// Boost.Beast's own idle time begins anew with all that is sent, so it would not find out who is gone while
/// much is sent.
void WebLink::check_idle() {
  const LinkClock::time_point now = LinkClock::now();
  const auto silent = std::chrono::duration_cast<std::chrono::milliseconds>(now - wire().last_sign());
  const std::chrono::milliseconds half = limits_.idle_time / 2;
  if (silent < half) return arm(half - silent + std::chrono::milliseconds(1));
  // Who was asked late, as this thread stood still, has as long to answer as others.
  const bool stood_still = now - timer_.expiry() > half / 4;
  if (silent < limits_.idle_time || stood_still) {
    ping();
    return arm(stood_still ? half : limits_.idle_time - silent + std::chrono::milliseconds(1));
  }
  over(fmt::format("Nothing came from {} for {}, not even the answer to a ping, so the connection was ended.",
                   name_, shown_seconds(limits_.idle_time)));
}

void WebLink::ping() {
  if (std::exchange(is_pinging_, true)) return;
  stream_.async_ping(
      {}, [self = shared_from_this()](LinkError /*the reader tells*/) { self->is_pinging_ = false; });
}

}  // namespace

// ---- The loop ----

class LinkLoop::Parts {
 public:
  explicit Parts(LinkEvents& events) : shares(events), work(shares.context.get_executor()) {}

  LinkShares shares;
  asio::executor_work_guard<Executor> work;  // run() goes on where nothing is waited for
  std::vector<std::shared_ptr<LinkListener>> listeners;
  std::vector<std::unique_ptr<HttpListener>> http_listeners;
};

LinkLoop::LinkLoop(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LinkLoop::~LinkLoop() = default;

base::Result<std::unique_ptr<LinkLoop>> LinkLoop::create(LinkEvents& events) try {
  return std::unique_ptr<LinkLoop>(new LinkLoop(std::make_unique<Parts>(events)));
} catch (const boost::system::system_error& error) {
  return base::fail(
      fmt::format("The network cannot be used ({}); raise the limit of open files.", error.code().message()));
}

base::Result<Endpoint> LinkLoop::listen(const ListenSettings& settings) {
  std::optional<TlsContext> tls;
  if (!settings.certificate.empty()) {
    base::Result<TlsContext> made = TlsContext::for_server(settings.certificate, settings.key);
    if (!made) return tl::unexpected(made.error());
    tls = std::move(*made);
  }
  const base::Result<ListeningSocket> socket =
      listen_at(settings.endpoint, tls ? Reach::Anybody : Reach::ThisComputerOnly);
  if (!socket) return tl::unexpected(socket.error());
  auto& listeners = parts_->listeners;
  listeners.push_back(std::make_shared<LinkListener>(parts_->shares, *socket, settings, std::move(tls)));
  listeners.back()->accept_next();
  return socket->endpoint;
}

base::Result<Endpoint> LinkLoop::listen_http(const Endpoint& endpoint,
                                             std::function<HttpAnswer(std::string_view path)> answer) {
  const base::Result<ListeningSocket> socket = listen_at(endpoint, Reach::Anybody);
  if (!socket) return tl::unexpected(socket.error());
  parts_->http_listeners.push_back(
      std::make_unique<HttpListener>(parts_->shares.context, *socket, std::move(answer)));
  return socket->endpoint;
}

std::uint64_t LinkLoop::distrusted() const { return parts_->shares.distrusted; }

LinkId LinkLoop::connect(const ConnectSettings& settings) {
  LinkShares& shares = parts_->shares;
  const LinkId id = ++shares.last_id;
  const WebLink::Limits limits = {settings.most_frame_bytes, settings.handshake_time, settings.idle_time};
  const auto link = std::make_shared<WebLink>(shares, id, limits);
  shares.links.emplace(id, link);
  link->begin_connecting(settings);
  return id;
}

void LinkLoop::send(LinkId link, SharedBytes frame) {
  const auto it = parts_->shares.links.find(link);
  if (it != parts_->shares.links.end()) it->second->send(std::move(frame));
}

void LinkLoop::close(LinkId link, const std::string& why) {
  const auto it = parts_->shares.links.find(link);
  if (it != parts_->shares.links.end()) it->second->close(why);
}

void LinkLoop::post(std::function<void()> work) { asio::post(parts_->shares.context, std::move(work)); }

void LinkLoop::after(std::chrono::nanoseconds delay, std::function<void()> work) {
  const auto timer = std::make_shared<Timer>(parts_->shares.context.get_executor());
  timer->expires_after(delay);
  timer->async_wait([timer, work = std::move(work)](LinkError error) {
    if (!error) work();
  });
}

void LinkLoop::run() {
  parts_->shares.context.run();
  parts_->shares.context.restart();
}

void LinkLoop::stop() { parts_->shares.context.stop(); }

}  // namespace icome::collab
