#include "collab/server/design_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/clock.h"
#include "collab/link/certificate.h"
#include "collab/storage/design_state.h"
#include "collab/storage/random_bytes.h"

namespace icome::collab {
namespace {

constexpr std::int64_t kTick = 100;             // ms
constexpr std::int64_t kMostStopping = 5'000;   // ms for clients to go and for the log to end
constexpr std::size_t kLongFrame = 1U << 16U;   // bytes: behind such a one more waits
constexpr std::int64_t kCommitGap = 3'000'000;  // ns from the beginning of a commit to that of the next
/// Deliveries a second from which what is to be said is gathered, so that each client gets fewer, longer
/// frames; and how many of them make a millisecond of that, within limits.
constexpr double kManyDeliveries = 1e5, kDeliveriesAMillisecond = 25e3;
constexpr double kLeastGather = 8.0, kMostGather = 12.0;  // ms
constexpr const char* kEmbeddedHolder = "the server of this folder";

std::int64_t steady_milliseconds() { return base::steady_nanoseconds() / 1'000'000; }

/// The subject at which a server listens on the bus; without a name, the one at which all do.
std::string subject_of(const std::string& server) {
  return server.empty() ? std::string("icome.all") : "icome.server." + server;
}

constexpr std::int64_t kDatabaseLease = 4'000;  // ms: so soon another server takes over where one has died

/// The folder for the files of a server of this store.
base::Result<StoreFolder> files_of(const ServeSettings& settings, const Store& store) {
  if (store.folder() != nullptr) {
    if (!settings.files.empty())
      return base::fail("--files goes with a database: the files of a store in a folder are there.");
    return *store.folder();
  }
  if (!settings.files.empty()) return StoreFolder::make(settings.files);
  const auto usual = StoreFolder::default_path();
  if (!usual) return tl::unexpected(usual.error());
  return StoreFolder::make(usual->parent_path() / "server");
}

/// Names this server in leases. The lock of a folder proves that no other server has the designs in it;
/// before a database each run has a name of its own.
base::Result<std::string> holder_of(const Store& store) {
  if (!store.is_database()) return kEmbeddedHolder;
  const auto bytes = random_bytes(16);
  if (!bytes) return bytes;
  return hex_text(*bytes);
}

struct ServedFiles {
  std::filesystem::path certificate, key;
};

base::Result<ServedFiles> certificate_files(const ServeSettings& settings, const StoreFolder& folder) {
  if (settings.insecure) return ServedFiles{};
  if (settings.certificate.empty() != settings.key.empty())
    return base::fail("A certificate goes with its key: give both, --certificate and --key.");
  if (!settings.certificate.empty()) return ServedFiles{settings.certificate, settings.key};
  std::error_code error;
  const bool has_certificate = std::filesystem::exists(folder.certificate(), error);
  const bool has_key = std::filesystem::exists(folder.certificate_key(), error);
  if (has_certificate != has_key)
    return base::fail(
        fmt::format("{0}: is not there, but {1} is. Bring it back from a backup. With a new pair (remove "
                    "{1}) no link that was "
                    "given out fits any more.",
                    (has_key ? folder.certificate() : folder.certificate_key()).string(),
                    (has_key ? folder.certificate_key() : folder.certificate()).string()));
  if (!has_certificate) {
    if (const auto made = make_certificate(folder.certificate(), folder.certificate_key()); !made)
      return tl::unexpected(made.error());
  }
  return ServedFiles{folder.certificate(), folder.certificate_key()};
}

}  // namespace

base::Result<std::unique_ptr<DesignServer>> DesignServer::create(const ServeSettings& settings) {
  const auto store = Store::make(settings.store);
  if (!store) return tl::unexpected(store.error());
  if (!settings.bus.empty() && !store->is_database())
    return base::fail(store->shown() +
                      ": a folder is served by one server, which needs no bus: --bus goes with a database.");
  const auto files = files_of(settings, *store);
  if (!files) return tl::unexpected(files.error());
  auto lock = files->lock();
  if (!lock) return tl::unexpected(lock.error());
  auto log = store->log();
  if (!log) return tl::unexpected(log.error());
  const auto signer = store->signer();
  if (!signer) return tl::unexpected(signer.error());
  const auto certificate = certificate_files(settings, *files);
  if (!certificate) return tl::unexpected(certificate.error());

  ServeSettings complete = settings;
  complete.certificate = certificate->certificate;
  complete.key = certificate->key;
  if (complete.hub.holder.empty()) {
    auto holder = holder_of(*store);
    if (!holder) return tl::unexpected(holder.error());
    complete.hub.holder = std::move(*holder);
  }
  if (store->is_database()) complete.hub.design_lease = std::min(complete.hub.design_lease, kDatabaseLease);
  std::unique_ptr<DesignServer> server(
      new DesignServer(*files, std::move(*lock), *signer, complete.hub, store->shown()));
  if (const auto started = server->start(complete, std::move(*log)); !started)
    return tl::unexpected(started.error());
  const ServedAddress address{server->endpoint_.host, server->endpoint_.port, server->fingerprint_};
  if (const auto noted = store->write_address(address); !noted) {
    // A full disk keeps nobody from reading, as long as links still lead here.
    const auto known = store->address();
    if (!known || *known != address) return tl::unexpected(noted.error());
  }
  return server;
}

DesignServer::DesignServer(const StoreFolder& files, io::OpenFile lock, const TokenSigner& signer,
                           HubSettings settings, std::string shown_store)
    : folder_(files.path()),
      shown_store_(std::move(shown_store)),
      lock_(std::move(lock)),
      hub_(
          settings, signer, factory_, [this](const AuditRow& row) { audit_.write(row); },
          [this](LinkId link, const std::string& server, std::string_view hello) {
            return pass_on(link, server, hello);
          }),
      relays_({settings.holder, signer.derived_key("bus")}, *this),
      audit_(files.audit()),
      started_(steady_milliseconds()) {}

DesignServer::~DesignServer() { log_.reset(); }

base::Result<void> DesignServer::start(const ServeSettings& settings, std::unique_ptr<OpLog> log) {
  if (!audit_.is_open()) return base::fail(folder_.string() + ": the audit log cannot be written there.");
  auto loop = LinkLoop::create(*this);
  if (!loop) return tl::unexpected(loop.error());
  loop_ = std::move(*loop);
  if (!settings.insecure) {
    auto fingerprint = fingerprint_of(settings.certificate);
    if (!fingerprint) return tl::unexpected(fingerprint.error());
    fingerprint_ = std::move(*fingerprint);
  }
  ListenSettings listening{.endpoint = settings.listen,
                           .certificate = settings.certificate,
                           .key = settings.key,
                           .origins = settings.origins};
  listening.most_links_an_address = settings.most_links_an_address;
  auto endpoint = loop_->listen(listening);
  if (!endpoint) return tl::unexpected(endpoint.error());
  endpoint_ = std::move(*endpoint);
  if (settings.health) {
    auto health =
        loop_->listen_http(*settings.health, [this](std::string_view path) { return answer(path); });
    if (!health) return tl::unexpected(health.error());
    health_ = std::move(*health);
  }
  log_ = std::make_unique<LogThread>(std::move(log), [this](std::function<void()> then) {
    loop_->post([this, then = std::move(then)] {
      log_works_ = false;
      then();
      stir();
    });
  });
  return settings.bus.empty() ? base::Result<void>() : join_bus(settings.bus);
}

base::Result<void> DesignServer::run(const std::function<bool()>& ends) {
  ends_ = ends;
  loop_->post([this] { tick(); });
  loop_->run();
  if (!is_homeless_) return {};
  return base::fail(folder_.string() +
                    ": the store was taken away while it was served. Put it back, or restore a backup.");
}

// ---- what happens

void DesignServer::opened(LinkId link, const Peer& peer) {
  links_[link] = {};
  hub_.opened(link, peer.address, steady_milliseconds());
}

void DesignServer::received(LinkId link, std::string_view frame) {
  if (relays_.passes_on(link)) return relays_.from_client(link, frame);
  hub_.received(link, frame, steady_milliseconds(), wall_milliseconds());
  if (hub_.has_answer(link)) flush(link);
  stir();
}

void DesignServer::sent(LinkId link) {
  if (relays_.passes_on(link)) return relays_.client_sent(link);
  go_on(link);
}

/// The last frame has left.
void DesignServer::go_on(LinkId link) {
  const auto found = links_.find(link);
  if (found == links_.end()) return;
  found->second.is_under_way = false;
  if (std::exchange(found->second.goes_on, false) || hub_.parting(link)) flush(link);
}

void DesignServer::closed(LinkId link, const std::string&) {
  relays_.client_closed(link);
  forget(link);
}

void DesignServer::forget(LinkId link) {
  links_.erase(link);
  hub_.closed(link, steady_milliseconds());
  stir();
}

// ---- other servers

base::Result<void> DesignServer::join_bus(const std::string& address) {
  auto bus = Bus::connect(address, [this](std::string bytes) {
    loop_->post([this, bytes = std::move(bytes)] { relays_.heard(bytes, steady_milliseconds()); });
  });
  if (!bus) return tl::unexpected(bus.error());
  bus_ = std::move(*bus);
  for (const std::string& subject : {subject_of(relays_.id()), subject_of({})})
    if (const auto listens = bus_->listen(subject); !listens) return listens;
  return {};
}

void DesignServer::publish(const std::string& server, std::string bytes) {
  if (bus_) bus_->publish(subject_of(server), bytes);
}

/// A client whose design another server has.
bool DesignServer::pass_on(LinkId link, const std::string& server, std::string_view hello) {
  if (!bus_ || Relays::is_guest(link)) return false;
  return relays_.pass_on(link, server, hello, steady_milliseconds());
}

void DesignServer::guest_opened(LinkId guest, const std::string& address) {
  links_[guest] = {};
  hub_.opened(guest, address, steady_milliseconds());
}

void DesignServer::guest_received(LinkId guest, std::string_view frame) {
  hub_.received(guest, frame, steady_milliseconds(), wall_milliseconds());
  if (hub_.has_answer(guest)) flush(guest);
  stir();
}

void DesignServer::guest_sent(LinkId guest) { go_on(guest); }

void DesignServer::guest_closed(LinkId guest) { forget(guest); }

void DesignServer::client_frame(LinkId client, SharedBytes frame) { loop_->send(client, std::move(frame)); }

void DesignServer::client_ends(LinkId client, const std::string& why) { loop_->close(client, why); }

void DesignServer::send(LinkId link, SharedBytes frame) {
  Relays::is_guest(link) ? relays_.to_guest(link, *frame) : loop_->send(link, std::move(frame));
}

void DesignServer::close(LinkId link, const std::string& why) {
  if (!Relays::is_guest(link)) return loop_->close(link, why);
  relays_.end_guest(link, why);
  loop_->post([this, link] { forget(link); });
}

/// Looks once, behind all else that has come in, who has to hear of what has happened; a little later where
/// very many have to hear of much.
void DesignServer::stir() {
  if (!std::exchange(is_log_stirred_, true))
    loop_->post([this] {
      is_log_stirred_ = false;
      work_on_log();
    });
  if (!std::exchange(is_stirred_, true)) look_soon();
}

void DesignServer::look_soon() {
  if (gather_ == 0) return loop_->post([this] { look(); });
  loop_->after(std::chrono::microseconds(1'000 * gather_ / std::int64_t(kTurns)), [this] { look(); });
}

/// Lets connections take turns where what is to be said is gathered: a burst to all of them would keep the
/// last ones waiting.
void DesignServer::look() {
  for (const LinkId link : hub_.take_stirred()) turns_[link % kTurns].insert(link);
  for (std::size_t i = 0; i < (gather_ == 0 ? kTurns : 1); ++i) {
    turn_ = (turn_ + 1) % kTurns;
    for (const LinkId link : std::exchange(turns_[turn_], {})) flush(link);
  }
  is_stirred_ = std::ranges::any_of(turns_, [](const auto& links) { return !links.empty(); });
  if (is_stirred_) look_soon();
}

void DesignServer::choose_pace(std::int64_t now) {
  const std::uint64_t before = std::exchange(deliveries_, hub_.counters().deliveries);
  const std::int64_t time = std::max<std::int64_t>(1, now - std::exchange(ticked_, now));
  const double rate = 1e3 * double(deliveries_ - before) / double(time);
  gather_ = rate < kManyDeliveries
                ? 0
                : std::int64_t(std::clamp(rate / kDeliveriesAMillisecond, kLeastGather, kMostGather));
}

void DesignServer::flush(LinkId link) {
  const auto found = links_.find(link);
  if (found == links_.end()) return;
  Sending& sending = found->second;
  if (sending.is_under_way) {
    sending.goes_on = true;
  } else if (SharedBytes frame = hub_.next_frame(link, steady_milliseconds())) {
    sending = {true, frame->size() > kLongFrame};
    send(link, std::move(frame));
  } else if (const auto why = hub_.parting(link)) {
    close(link, *why);
  }
}

/// Commits are some milliseconds apart, as each costs the same whatever is in it.
void DesignServer::work_on_log() {
  if (log_works_) return;
  const std::int64_t now = base::steady_nanoseconds();
  if (StorageWork work = hub_.next_work(now >= next_commit_)) {
    if (hub_.appends()) next_commit_ = now + std::max(kCommitGap, gather_ * 1'000'000);
    log_works_ = true;
    log_->start(std::move(work));
  } else if (now < next_commit_ && !std::exchange(waits_to_commit_, true)) {
    loop_->after(std::chrono::nanoseconds(next_commit_ - now), [this] {
      waits_to_commit_ = false;
      work_on_log();
    });
  }
}

void DesignServer::tick() {
  const std::int64_t now = steady_milliseconds();
  choose_pace(now);
  is_homeless_ = is_homeless_ || !lock_.is_at_its_path();
  if (!stops_ && (ends_() || is_homeless_)) {
    stops_ = true;
    stop_until_ = now + kMostStopping;
    hub_.stop(now);
  }
  hub_.tick(now, wall_milliseconds());
  if (bus_) relays_.tick(now);
  stir();
  if (stops_ && ((hub_.is_done() && !log_works_) || now > stop_until_)) return loop_->stop();
  loop_->after(std::chrono::milliseconds(kTick), [this] { tick(); });
}

// ---- what administrators see

HttpAnswer DesignServer::answer(std::string_view path) const {
  if (path == "/health" && hub_.trouble().empty()) return {200, "application/json", "{\"status\":\"ok\"}\n"};
  if (path == "/health") {
    const nlohmann::json status{{"status", hub_.trouble()}};
    return {503, "application/json",
            status.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"};
  }
  if (path != "/metrics") return {404, "text/plain; charset=utf-8", "There are /health and /metrics.\n"};
  const HubCounters& it = hub_.counters();
  std::string text;
  const auto add = [&](const char* name, const char* kind, const char* help, std::uint64_t value) {
    text +=
        fmt::format("# HELP icome_{0} {1}\n# TYPE icome_{0} {2}\nicome_{0} {3}\n", name, help, kind, value);
  };
  add("connections", "gauge", "Connections that are open.", it.links);
  add("designs", "gauge", "Designs that are open.", it.rooms);
  add("edits_accepted_total", "counter", "Edits that were put in order.", it.accepted_edits);
  add("edits_refused_total", "counter", "Edits that were refused.", it.refused_edits);
  add("hellos_refused_total", "counter", "Clients that were not let in.", it.refused_hellos);
  add("messages_received_total", "counter", "Messages of clients.", it.messages);
  add("frames_sent_total", "counter", "Frames to clients.", it.frames);
  add("bytes_sent_total", "counter", "Bytes of those frames.", it.frame_bytes);
  add("commits_total", "counter", "Commits of the log.", it.commits);
  add("commits_failed_total", "counter", "Appends that the log refused.", it.failed_commits);
  add("edits_committed_total", "counter", "Edits that are durable.", it.committed_edits);
  add("audit_rows_lost", "gauge", "Rows of the audit log that could not be written since one could.",
      audit_.lost());
  add("uptime_seconds", "gauge", "Since the server began.",
      std::uint64_t((steady_milliseconds() - started_) / 1'000));
  return {200, "text/plain; version=0.0.4; charset=utf-8", std::move(text)};
}

}  // namespace icome::collab
