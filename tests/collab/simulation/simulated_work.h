#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <set>
#include <string>
#include <vector>

#include "base/random.h"
#include "collab/client/conversation.h"
#include "collab/server/hub.h"
#include "collab/storage/memory_op_log.h"
#include "world/random_edits.h"

namespace icome::collab {

/// How rough a simulated day is.
struct Weather {
  std::size_t clients = 3;
  std::int64_t rough = 4'000;  // ms of work and of faults; then all is well, and everybody finishes
  double cuts = 0.02;          // of 1, that something happens to a client or the server in a step of 20 ms:
  double crashes = 0.004;      // a client is killed
  double server_kills = 0.005;
  double partitions = 0.01;  // one direction of a connection stands still for a while
  double clock_jumps = 0.002;
  double twice = 0.02;  // a frame comes twice
  double edits = 0.5;   // a client does something
};

/// A log that remembers which edits it ever took, by author and number.
class RememberingLog final : public MemoryOpLog {
 public:
  using MemoryOpLog::MemoryOpLog;
  std::vector<std::optional<AppendError>> append(std::span<const Append> batches) override {
    auto errors = MemoryOpLog::append(batches);
    for (std::size_t i = 0; i < batches.size(); ++i)
      if (!errors[i])
        for (const LogEntry& entry : batches[i].batch) appended_.emplace(entry.author, entry.number);
    return errors;
  }
  const std::set<std::pair<std::uint32_t, std::uint64_t>>& appended() const { return appended_; }

 private:
  std::set<std::pair<std::uint32_t, std::uint64_t>> appended_;
};

/// Contents in memory, the last few of them.
class MemoryContents final : public ContentCache {
 public:
  ContentPointer find(const ContentHash& hash) override {
    const auto found = contents_.find(hash);
    return found == contents_.end() ? nullptr : found->second;
  }
  void keep(const ContentHash& hash, const ContentPointer& content) override {
    constexpr std::size_t kMost = 8;
    if (contents_.size() == kMost) contents_.erase(contents_.begin());
    contents_[hash] = content;
    ++kept_;
  }
  std::uint64_t kept() const { return kept_; }

 private:
  std::map<ContentHash, ContentPointer> contents_;
  std::uint64_t kept_ = 0;
};

/// A server, its log and some clients in one thread and in virtual time, with everything that may befall them
/// decided by a seed: connections that are cut, stand still or say things twice, kills of the server and of
/// clients, and clocks that jump. The log is the disk: what it has taken survives, and a commit may reach it
/// without anybody hearing so.
class SimulatedWork {
 public:
  SimulatedWork(std::uint64_t seed, const Weather& weather, const TokenSigner& signer);

  /// Runs the rough part, then lets everything come to rest. Gives what is wrong; empty when all is well.
  std::string run();

  std::uint64_t ordered() const { return log_.appended().size(); }
  std::uint64_t restarts() const { return restarts_; }
  std::uint64_t dropped() const { return dropped_; }
  std::uint64_t conflicts() const { return conflicts_; }
  /// Contents that were fetched by the client that keeps them.
  /// Clients that went on from a copy that was kept, and edits that those had.
  std::uint64_t resumed() const { return resumed_; }
  std::uint64_t resumed_edits() const { return resumed_edits_; }
  std::uint64_t fetched() const { return contents_->kept(); }

 private:
  struct Flight {
    std::int64_t at = 0;
    std::string frame;
  };
  /// One direction of a connection: what was sent first comes first.
  struct Wire {
    std::deque<Flight> flying;
    std::int64_t still_until = 0;
  };
  struct Client {
    std::string key;
    std::unique_ptr<Conversation> talk;
    std::shared_ptr<world::World> copy;  // led along by what the replica tells
    std::optional<LinkId> link;
    std::int64_t next_try = 0;
    std::unique_ptr<world::RandomEdits> edits;
    std::string kept;  // a KeptCopy as a file has it; empty: none yet
    Wire up, down;
  };

  void step(bool is_rough);
  void weather_on(Client& client);
  void act(Client& client);
  void choose(Conversation& talk);
  void act_by_edit(Conversation& talk, const world::Edit& edit);
  void connect(Client& client);
  void cut(Client& client, const std::string& why);
  void deliver(Client& client);
  void send(Wire& wire, std::string frame);
  void serve();
  void start_server();
  void kill_server();
  void hear(Client& client);
  void make_client(Client& client, bool same_key);
  std::string check_floor() const;
  std::string check_rest();

  base::Random random_;
  Weather weather_;
  TokenSigner signer_;
  world::GeometryFactory factory_;
  std::int64_t now_ = 1'000;
  std::int64_t wall_ = 1'700'000'000'000;
  RememberingLog log_;
  /// Kept by the first client through all its lives; the others keep nothing.
  std::shared_ptr<MemoryContents> contents_ = std::make_shared<MemoryContents>();
  std::unique_ptr<Hub> hub_;
  std::int64_t server_back_ = 0;
  std::function<void()> work_done_;  // what the log's last work returned, until it is heard of
  std::int64_t work_heard_ = 0;
  std::vector<Client> clients_;
  LinkId next_link_ = 1;
  std::int64_t next_tick_ = 0;
  std::string token_;
  std::set<std::pair<std::uint32_t, std::uint64_t>> acknowledged_, refused_;  // author and number
  std::uint64_t restarts_ = 0, dropped_ = 0, conflicts_ = 0, resumed_ = 0, resumed_edits_ = 0;
  std::string fault_;
};

}  // namespace icome::collab
