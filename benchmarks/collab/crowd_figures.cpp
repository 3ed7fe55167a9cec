#include "crowd_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "base/clock.h"
#include "collab/client/joining.h"
#include "collab/link/link_loop.h"
#include "collab/protocol/address.h"
#include "collab/protocol/message_bytes.h"
#include "server_process.h"
#include "world/edit/edit_bytes.h"

namespace icome::benchmarks {
namespace {

using namespace collab;

constexpr const char* kDesign = "crowd";

double seconds_now() { return 1e-9 * double(base::steady_nanoseconds()); }

/// Clients that cost little: they say and hear all that a client does, but keep no world. Each drags an
/// object, whose place tells when it was sent. Owns their connections; all run in one thread.
class Crowd final : private LinkEvents {
 public:
  Crowd(const DesignAddress& address, int clients)
      : address_(address),
        loop_(demand(LinkLoop::create(*this))),
        sample_(std::max(1, clients * clients / 512)) {
    for (int i = 0; i < clients; ++i) {
      ConnectSettings settings;
      settings.endpoint = {address.host, address.port};
      settings.fingerprint = address.fingerprint;
      clients_[loop_->connect(settings)].key = demand(make_client_key());
    }
    run_until([this] { return live_ == clients_.size(); });
  }

  /// Works for so long; gives the ways of sampled edits, ms.
  std::vector<double> work(double seconds, double updates_a_second) {
    ways_.clear();
    heard_ = 0;
    gap_ = 1.0 / updates_a_second;
    const double begin = seconds_now();
    double share = 0.0;
    for (auto& [link, client] : clients_) {  // spread over the period
      client.next = begin + gap_ * share;
      share += 1.0 / double(clients_.size());
    }
    works_ = true;
    beat();
    run_until([&] { return seconds_now() - begin >= seconds; });
    works_ = false;
    std::ranges::sort(ways_);
    return std::move(ways_);
  }
  std::uint64_t heard() const { return heard_; }

  /// One client asks for an object and gives it back, again and again, while the others work; ms.
  std::vector<double> grants(int count, double updates_a_second) {
    asks_ = count;
    answers_.clear();
    (void)work(0.5, updates_a_second);  // the beats go on below
    works_ = true;
    beat();
    ask();
    run_until([this] { return asks_ == 0; });
    works_ = false;
    std::ranges::sort(answers_);
    return std::move(answers_);
  }

 private:
  struct One {
    std::string key;
    std::uint32_t author = 0;
    std::uint64_t number = 0;
    world::ObjectId object;
    std::string frame;  // to be sent
    bool is_sending = false;
    bool is_open = false;
    double next = 0.0;
  };

  void run_until(std::function<bool()> done) {
    done_ = std::move(done);
    loop_->after(std::chrono::milliseconds(1), [this] { watch(); });
    loop_->run();
  }
  void watch() {
    if (done_()) return loop_->stop();
    loop_->after(std::chrono::milliseconds(1), [this] { watch(); });
  }

  void say(LinkId link, One& one, const ClientMessage& message) {
    add_to_frame(one.frame, to_bytes(message));
    flush(link, one);
  }
  void flush(LinkId link, One& one) {
    if (one.is_sending || one.frame.empty() || !one.is_open) return;
    one.is_sending = true;
    loop_->send(link, std::make_shared<const std::string>(std::exchange(one.frame, {})));
  }

  void beat() {
    if (!works_) return;
    const double now = seconds_now();
    for (auto& [link, one] : clients_) {
      if (now < one.next) continue;
      one.next = std::max(one.next + gap_, now);
      world::Affine3 place = world::Affine3::Identity();
      place.translation().x() = seconds_now();
      submit(link, one, world::PlaceObject{one.object, place});
    }
    loop_->after(std::chrono::milliseconds(1), [this] { beat(); });
  }
  void submit(LinkId link, One& one, const world::Edit& edit) {
    say(link, one, Submit{++one.number, 0, {}, demand(world::to_bytes(edit)), 0});
  }
  void ask() {
    if (asks_ == 0) return;
    const LinkId link = clients_.begin()->first;
    One& one = clients_.begin()->second;
    asked_at_ = seconds_now();
    say(link, one, Select{item_of(one.object), false});
  }

  void opened(LinkId link, const Peer&) override {
    One& one = clients_[link];
    one.is_open = true;
    Hello hello;
    hello.token = address_.token;
    hello.design = address_.design;
    hello.client_key = one.key;
    hello.name = "crowd";
    say(link, one, hello);
  }
  void sent(LinkId link) override {
    One& one = clients_[link];
    one.is_sending = false;
    flush(link, one);
  }
  void closed(LinkId, const std::string& why) override {
    fmt::print(stderr, "a connection has ended: {}\n", why);
    std::exit(1);
  }
  void received(LinkId link, std::string_view frame) override {
    One& one = clients_[link];
    while (!frame.empty()) {
      const std::string_view bytes = demand(next_in_frame(frame));
      // While all work a sample is enough, so that the clients, which share this machine with the server,
      // cost little.
      ++heard_;
      if (works_ && asks_ == 0 && heard_ % sample_ != 0) continue;
      auto message = demand(server_message(bytes));
      std::visit([&](const auto& it) { hear(link, one, it); }, message);
    }
  }

  template <typename Message>
  void hear(LinkId, One&, const Message&) {}
  void hear(LinkId link, One& one, const Welcome& it) {
    one.author = it.author;
    say(link, one, Loaded{it.snapshot});
    world::IdSource ids(one.author);
    one.object = ids.next<world::ObjectId>();
    submit(link, one, world::CreateObject{one.object, 0, {.name = "dragged"}});
    ++live_;
  }
  void hear(LinkId, One&, const Ordered& it) {
    if (!works_ || it.edit.empty()) return;
    const auto edit = world::edit_from_bytes(it.edit, factory_);
    if (!edit) return;
    const auto* const place = std::get_if<world::PlaceObject>(&edit->what);
    if (place) ways_.push_back(1e3 * (seconds_now() - place->parent_from_object.translation().x()));
  }
  void hear(LinkId link, One& one, const Selected& it) {
    if (asks_ == 0 || !it.granted) return;
    answers_.push_back(1e3 * (seconds_now() - asked_at_));
    --asks_;
    say(link, one, Deselect{it.item});
    loop_->after(std::chrono::milliseconds(3), [this] { ask(); });
  }

  DesignAddress address_;
  world::GeometryFactory factory_;
  std::unique_ptr<LinkLoop> loop_;
  std::map<LinkId, One> clients_;
  std::size_t live_ = 0;
  std::function<bool()> done_;
  bool works_ = false;
  double gap_ = 0.0;  // s between two updates of a client
  std::uint64_t heard_ = 0;
  std::uint64_t sample_ = 1;  // one message of so many is looked at
  std::vector<double> ways_;
  int asks_ = 0;
  double asked_at_ = 0.0;
  std::vector<double> answers_;
};

double share_of(const std::vector<double>& sorted, double part) {
  return sorted.empty() ? 0.0 : sorted[std::size_t(part * double(sorted.size() - 1))];
}

CrowdRow crowd_row(const std::filesystem::path& program, const std::filesystem::path& folder, int clients,
                   const CrowdExtent& extent) {
  const ServerProcess server(program, folder);
  const DesignAddress address = server.invite(kDesign);
  (void)Crowd(address, 1);
  const double memory = server.memory();
  Crowd crowd(address, clients);
  CrowdRow row{.clients = clients};
  row.joined_kb = (server.memory() - memory) / clients;
  (void)crowd.work(1.0, extent.updates_a_second);  // warm
  const double used = server.used(), begin = seconds_now();
  const std::vector<double> ways = crowd.work(extent.seconds, extent.updates_a_second);
  const double lasted = seconds_now() - begin, took = server.used() - used;
  row.working_kb = (server.memory() - memory) / clients;
  row.deliveries_a_second = double(clients) * (clients - 1) * extent.updates_a_second;
  row.server_share = took / lasted;
  row.server_us = 1e6 * took / (row.deliveries_a_second * lasted);
  row.p50_ms = share_of(ways, 0.5);
  row.p99_ms = share_of(ways, 0.99);
  const std::vector<double> grants = crowd.grants(extent.grants, extent.updates_a_second);
  row.grant_p50_ms = share_of(grants, 0.5);
  row.grant_p99_ms = share_of(grants, 0.99);
  return row;
}

}  // namespace

std::vector<CrowdRow> crowd_figures(const std::filesystem::path& program, const std::filesystem::path& folder,
                                    const CrowdExtent& extent) {
  std::vector<CrowdRow> rows;
  for (const int clients : extent.clients) {
    const BenchFolder store(folder);
    rows.push_back(crowd_row(program, store.path(), clients, extent));
  }
  return rows;
}

void print_table(const std::vector<CrowdRow>& rows, const CrowdExtent& extent) {
  fmt::print(
      "\nOne design, TLS, each client drags an object {:g} times a second; server and clients share this "
      "machine\n\n",
      extent.updates_a_second);
  fmt::print("{:>8} {:>13} {:>12} {:>12} {:>9} {:>9} {:>10} {:>11} {:>13} {:>13}\n", "clients",
             "deliveries/s", "server core", "us/delivery", "p50 ms", "p99 ms", "kB joined", "kB at work",
             "grant p50 ms", "grant p99 ms");
  for (const CrowdRow& row : rows)
    fmt::print(
        "{:>8} {:>13.0f} {:>11.0f}% {:>12.2f} {:>9.2f} {:>9.2f} {:>10.1f} {:>11.1f} {:>13.2f} {:>13.2f}\n",
        row.clients, row.deliveries_a_second, 100.0 * row.server_share, row.server_us, row.p50_ms, row.p99_ms,
        row.joined_kb, row.working_kb, row.grant_p50_ms, row.grant_p99_ms);
}

}  // namespace icome::benchmarks
