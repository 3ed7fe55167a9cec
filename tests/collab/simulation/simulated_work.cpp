#include "collab/simulation/simulated_work.h"

#include <fmt/format.h>

#include "collab/order/fitted_edit.h"
#include "collab/order/world_bytes.h"
#include "world/edit/edit_bytes.h"

namespace icome::collab {
namespace {

constexpr std::int64_t kStep = 20;          // ms
constexpr std::int64_t kMostRest = 60'000;  // ms that coming to rest may take
constexpr const char* kDesign = "table";

/// The world that the log makes, and the sequence of its last edit.
std::pair<std::uint64_t, std::uint64_t> replayed_hash(OpLog& log, const world::GeometryFactory& factory) {
  world::World world;
  std::uint64_t sequence = 0;
  if (const auto snapshot = log.snapshot(kDesign).value()) {
    world = world_from_bytes(snapshot->bytes, factory).value();
    sequence = snapshot->sequence;
  }
  const auto entries = log.read_from(kDesign, sequence, ~std::uint64_t{0}).value();
  for (const LogEntry& entry : entries) {
    const auto edit = world::edit_from_bytes(entry.edit, factory);
    if (!edit || !apply_fitted(world, *edit)) return {};
    sequence = entry.sequence;
  }
  return {hash(world), sequence};
}

}  // namespace

SimulatedWork::SimulatedWork(std::uint64_t seed, const Weather& weather, const TokenSigner& signer)
    : random_(seed),
      weather_(weather),
      signer_(signer),
      log_([this] { return wall_; }),
      clients_(weather.clients) {
  (void)log_.create(kDesign);
  token_ = signer_.sign({"00112233445566778899aabbccddeeff", kDesign, Role::Own, wall_ + 1'000'000'000'000})
               .value();
  start_server();
  for (Client& client : clients_) make_client(client, false);
}

void SimulatedWork::make_client(Client& client, bool same_key) {
  if (!same_key) client.key = fmt::format("key {}", random_.bits());
  // Its next life may give numbers again that were refused in this one.
  if (client.talk)
    std::erase_if(refused_, [&](const auto& it) { return it.first == client.talk->replica().author(); });
  DesignAddress address{"server", 1, kDesign, token_, ""};
  client.talk = std::make_unique<Conversation>(address, ClientIdentity{client.key, "Ann", 1, "test"},
                                               factory_, &client == &clients_.front() ? contents_ : nullptr);
  client.copy = std::make_shared<world::World>();
  client.talk->replica().on_change(
      [this, talk = client.talk.get(), copy = client.copy](const world::Edit* it) {
        if (it == nullptr) {
          *copy = talk->replica().world();
        } else if (!world::apply(*copy, *it)) {
          fault_ = "A replica tells of an edit that does not apply to a copy of it.";
        }
      });
  client.talk->ask_for_choices();
  if (same_key && !client.kept.empty() && random_.index(2) == 0) {
    const KeptCopy copy = kept_copy_from_bytes(client.kept, factory_).value();
    client.talk->resume(copy);
    client.kept = to_bytes(*client.talk->keep()).value();
    ++resumed_;
    resumed_edits_ += copy.edits.size();
  }
  if (!same_key) client.kept.clear();
  client.edits.reset();
  client.link.reset();
  client.up = client.down = {};
  client.next_try = now_ + std::int64_t(random_.index(200));
}

void SimulatedWork::start_server() {
  HubSettings settings;
  settings.holder = "the store";
  settings.room.lease = 2'000;
  settings.room.fresh_snapshot_bytes = 4'000;  // small, so that all ways of joining occur
  settings.room.most_tail_bytes = 20'000;
  settings.room.piece_bytes = 256;
  settings.room.content_bytes = 100;
  settings.room.merge_from = 6;
  settings.snapshot_edits = 30;
  settings.idle_time = 500;
  hub_ = std::make_unique<Hub>(settings, signer_, factory_);
}

void SimulatedWork::kill_server() {
  ++restarts_;
  hub_.reset();
  work_done_ = nullptr;  // done, perhaps, but nobody heard
  server_back_ = now_ + std::int64_t(random_.index(1'500));
  for (Client& client : clients_)
    if (client.link) cut(client, "The server is gone.");
}

void SimulatedWork::send(Wire& wire, std::string frame) {
  const std::int64_t soonest = wire.flying.empty() ? now_ : wire.flying.back().at;
  const std::int64_t delay =
      random_.index(10) == 0 ? std::int64_t(random_.index(300)) : std::int64_t(random_.index(30));
  wire.flying.push_back({std::max(soonest, now_ + delay), std::move(frame)});
}

void SimulatedWork::connect(Client& client) {
  if (!hub_ || now_ < client.next_try) return;
  client.link = next_link_++;
  client.up = client.down = {};
  hub_->opened(*client.link, "10.0.0.1:1", now_);
  client.talk->opened(now_);
}

void SimulatedWork::cut(Client& client, const std::string& why) {
  if (hub_ && client.link) hub_->closed(*client.link, now_);
  client.link.reset();
  client.up = client.down = {};  // what was under way is lost
  client.talk->closed(why, now_);
  client.next_try = now_ + std::int64_t(random_.index(400));
}

void SimulatedWork::weather_on(Client& client) {
  if (random_.uniform() < weather_.crashes) {
    if (hub_ && client.link) hub_->closed(*client.link, now_);
    return make_client(client, random_.index(2) == 0);
  }
  if (!client.link) return;
  if (random_.uniform() < weather_.cuts) return cut(client, "The line was cut.");
  if (random_.uniform() < weather_.partitions) {
    Wire& wire = random_.index(2) == 0 ? client.up : client.down;
    wire.still_until = now_ + std::int64_t(random_.index(3'000));
  }
}

/// Somebody chooses, sooner or later.
void SimulatedWork::choose(Conversation& talk) {
  if (talk.conflicts().empty()) return;
  ++conflicts_;
  std::vector<Choice> choices;
  for (const Conflict& it : talk.conflicts()) {
    const auto choice = Choice(random_.index(3));
    choices.push_back(it.is_gone && choice == Choice::Mine ? Choice::Theirs : choice);
  }
  const std::uint32_t author = talk.replica().author();
  world::IdSource ids(author, talk.replica().world().next_number(author) + 1'000'000);
  (void)talk.resolve(choices, ids);
}

void SimulatedWork::act(Client& client) {
  Conversation& talk = *client.talk;
  if (random_.index(4) == 0) choose(talk);
  const Replica& replica = talk.replica();
  if (replica.author() == 0 || random_.uniform() >= weather_.edits) return;
  if (random_.index(20) == 0)
    if (const auto copy = talk.keep()) client.kept = to_bytes(*copy).value();
  if (!client.edits)
    client.edits = std::make_unique<world::RandomEdits>(random_.bits(), replica.author(),
                                                        replica.first_free_number() + 10'000);
  const auto& holds = talk.holds();
  switch (random_.index(12)) {
    case 0:
      (void)talk.undo();
      break;
    case 1:
      (void)talk.redo();
      break;
    case 2:
    case 3: {
      const auto& objects = replica.world().objects();
      if (objects.empty()) break;
      std::vector<world::ObjectId> ids;
      for (const auto& [id, object] : objects) ids.push_back(id);
      std::ranges::sort(ids);
      talk.select(item_of(ids[random_.index(ids.size())]), random_.index(2) == 0);
      break;
    }
    case 4:
      if (!holds.empty()) talk.deselect(holds.begin()->first);
      break;
    case 5:
      if (!holds.empty() && random_.index(4) == 0) talk.take_away(holds.begin()->first);
      break;
    default:
      act_by_edit(talk, client.edits->next(replica.world()));
  }
}

/// Some clients do not look who holds a thing.
void SimulatedWork::act_by_edit(Conversation& talk, const world::Edit& edit) {
  const bool goes_on = random_.index(2) == 0;
  if (random_.index(4) == 0) {
    (void)talk.replica().perform(edit, "Random", {}, goes_on);
  } else {
    (void)talk.perform(edit, "Random", goes_on);
  }
}

void SimulatedWork::deliver(Client& client) {
  while (client.link && !client.up.flying.empty() && client.up.flying.front().at <= now_ &&
         client.up.still_until <= now_) {
    const std::string frame = std::move(client.up.flying.front().frame);
    client.up.flying.pop_front();
    const bool twice = random_.uniform() < weather_.twice && client.talk->state() == ConversationState::Live;
    for (int i = 0; i < (twice ? 2 : 1); ++i) hub_->received(*client.link, frame, now_, wall_);
  }
  while (client.link && !client.down.flying.empty() && client.down.flying.front().at <= now_ &&
         client.down.still_until <= now_) {
    const std::string frame = std::move(client.down.flying.front().frame);
    client.down.flying.pop_front();
    client.talk->received(frame, now_);
    hear(client);
    if (client.talk->wants_to_close()) cut(client, "It wanted to.");
  }
}

void SimulatedWork::hear(Client& client) {
  for (const Seen& seen : client.talk->take_seen()) {
    if (const auto* const dropped = std::get_if<Dropped>(&seen)) {
      ++dropped_;
      if (dropped->why.find("nobody knows") == std::string::npos)
        refused_.emplace(client.talk->replica().author(), dropped->number);
    }
    if (const auto* const durable = std::get_if<SeenDurable>(&seen))
      for (const std::uint64_t number : durable->own)
        acknowledged_.emplace(client.talk->replica().author(), number);
  }
}

void SimulatedWork::serve() {
  if (!hub_) {
    if (now_ >= server_back_) start_server();
    return;
  }
  if (work_done_ && now_ >= work_heard_) std::exchange(work_done_, nullptr)();
  if (!work_done_) {
    if (const StorageWork work = hub_->next_work()) {
      work_done_ = work(log_);  // on the disk now; heard of later, or never
      work_heard_ = now_ + std::int64_t(random_.index(60));
    }
  }
  if (now_ >= next_tick_) {
    hub_->tick(now_, wall_);
    next_tick_ = now_ + 100;
  }
  (void)hub_->take_stirred();
  for (Client& client : clients_) {
    if (!client.link) continue;
    // A client that stands still hears late, so that edits pile up for it.
    if (client.down.flying.size() < 3)
      while (const SharedBytes frame = hub_->next_frame(*client.link, now_)) send(client.down, *frame);
    if (hub_->parting(*client.link) && client.down.flying.empty()) cut(client, "The server ended it.");
  }
}

void SimulatedWork::step(bool is_rough) {
  now_ += kStep;
  wall_ += kStep;
  if (is_rough && random_.uniform() < weather_.clock_jumps)
    wall_ += std::int64_t(random_.index(20'000)) - 10'000;
  if (is_rough && hub_ && random_.uniform() < weather_.server_kills) kill_server();
  for (Client& client : clients_) {
    if (is_rough) weather_on(client);
    if (!client.link) connect(client);
    is_rough ? act(client) : choose(*client.talk);
    if (client.link)
      while (const SharedBytes frame = client.talk->next_frame(now_)) send(client.up, *frame);
    deliver(client);
  }
  serve();
  if (fault_.empty()) fault_ = check_floor();
}

/// Never two holders on one path, never a held object that is not there.
std::string SimulatedWork::check_floor() const {
  const Room* const room = hub_ ? hub_->room(kDesign) : nullptr;
  if (!room) return "";
  const auto& holds = room->floor().holds();
  for (const auto& [item, hold] : holds) {
    if (!is_there(room->world(), item)) return "Something is held that is not there.";
    if (item.kind != ItemKind::Object) continue;
    world::ObjectId above = room->world().find(world::ObjectId{item.id})->parent;
    for (; above; above = room->world().find(above)->parent) {
      const auto other = holds.find(item_of(above));
      if (other != holds.end() && other->second.holder != hold.holder) return "Two hold things on one path.";
    }
  }
  return "";
}

std::string SimulatedWork::run() {
  for (const std::int64_t end = now_ + weather_.rough; now_ < end && fault_.empty();) step(true);
  weather_ = {.clients = weather_.clients, .twice = 0.0};
  const auto at_rest = [](const Client& client) {
    return client.talk->state() == ConversationState::Live && client.talk->replica().unacknowledged() == 0 &&
           client.up.flying.empty() && client.down.flying.empty();
  };
  const auto all_rest = [&] {
    const Room* const room = hub_ ? hub_->room(kDesign) : nullptr;
    return room && room->durable() == room->sequence() && std::ranges::all_of(clients_, at_rest) &&
           std::ranges::all_of(clients_, [&](const Client& client) {
             return client.talk->replica().sequence() == room->sequence();
           });
  };
  for (const std::int64_t end = now_ + kMostRest; !all_rest() && now_ < end && fault_.empty();) step(false);
  if (!fault_.empty()) return fault_;
  if (!all_rest()) {
    for (const Client& client : clients_)
      if (!at_rest(client))
        return fmt::format("A client does not come to rest: state {}, {} unacknowledged, \"{}\".",
                           int(client.talk->state()), client.talk->replica().unacknowledged(),
                           client.talk->why_ended());
    return "The server does not come to rest.";
  }
  return check_rest();
}

std::string SimulatedWork::check_rest() {
  const Room& room = *hub_->room(kDesign);
  const std::uint64_t expected = hash(room.world());
  const auto [logged_hash, sequence] = replayed_hash(log_, factory_);
  if (logged_hash != expected) return "The log and the server's world differ.";
  if (sequence != room.sequence()) return "The log ends elsewhere than the server's world.";
  for (const Client& client : clients_)
    if (hash(client.talk->replica().world()) != expected) return "A client's world and the server's differ.";
  for (const Client& client : clients_)
    if (hash(*client.copy) != expected) return "A copy that a replica leads along differs from it.";
  for (const auto& [author, number] : acknowledged_)
    if (!log_.appended().contains({author, number}))
      return fmt::format("Edit {} of author {} was acknowledged and is lost.", number, author);
  for (const auto& edit : refused_)
    if (log_.appended().contains(edit))
      return fmt::format("Edit {} of author {} was told to be refused and is there.", edit.second,
                         edit.first);
  for (Client& client : clients_) client.talk->leave();
  for (int i = 0; i < 300; ++i) {
    now_ += kStep;
    for (Client& client : clients_) {
      if (!client.link) continue;
      while (const SharedBytes frame = client.talk->next_frame(now_)) send(client.up, *frame);
      deliver(client);
      if (client.link && client.talk->wants_to_close() && client.up.flying.empty()) {
        hub_->closed(*client.link, now_);
        client.link.reset();
      }
    }
    serve();
  }
  if (const Room* const after = hub_->room(kDesign); after && !after->floor().holds().empty())
    return "A hold is left behind.";
  return "";
}

}  // namespace icome::collab
