#include "collab/client/conversation.h"

#include <algorithm>
#include <utility>

#include "collab/order/fitted_edit.h"
#include "collab/order/world_bytes.h"
#include "collab/protocol/message_bytes.h"
#include "world/edit/edit_bytes.h"

namespace icome::collab {
namespace {

constexpr std::size_t kFrameBytes = 1U << 18U;  // at most so many are begun to be put into one frame
constexpr std::size_t kPartBytes = 1U << 18U;   // of an edit that is sent in parts
constexpr const char* kRestored =
    "The design was restored from an earlier state: what came after it is gone.";
constexpr std::int64_t kUsualLease = 8'000;         // ms
constexpr std::size_t kMostHeldBack = 256U << 20U;  // bytes of edits behind one whose contents still come

}  // namespace

Conversation::Conversation(DesignAddress address, ClientIdentity identity, world::GeometryFactory factory,
                           ContentCachePointer cache)
    : address_(std::move(address)),
      identity_(std::move(identity)),
      factory_(factory),
      replica_(std::move(factory)),
      contents_(std::move(cache)) {}

// ---- the connection

void Conversation::opened(std::int64_t now) {
  now_ = heard_at_ = now;
  connected_ = true;
  wants_to_close_ = said_bye_ = settled_ = false;
  outgoing_.clear();
  alive_said_ = now;
  change_state(ConversationState::Joining, "");
  Hello hello;
  hello.token = address_.token;
  hello.design = address_.design;
  hello.client_key = identity_.key;
  hello.name = identity_.name;
  hello.colour = identity_.colour;
  hello.program = identity_.program;
  hello.has_world = replica_.can_resume() && !needs_anew_;
  hello.have = replica_.durable();
  hello.history = history_;
  hello.first_pending = replica_.first_pending();
  hello.only_reads = identity_.only_reads;
  queue(hello);
}

void Conversation::closed(const std::string& why, std::int64_t now) {
  now_ = now;
  connected_ = false;
  welcome_.reset();
  contents_.connection_lost();
  held_back_.clear();
  held_back_bytes_ = 0;
  loads_ = false;
  sightings_.clear();
  for (auto& [author, person] : people_) person.here = false;
  if (const auto done = replica_.rewind(); !done) needs_anew_ = true;
  if (state_ == ConversationState::Live && conflicts_.empty()) actions_before_ = replica_.actions();
  conflicts_.clear();  // they are found anew, from where the work without a connection began
  if (state_ != ConversationState::Ended) change_state(ConversationState::Away, why_.empty() ? why : why_);
  if (state_ != ConversationState::Ended) why_.clear();
}

void Conversation::received(std::string_view frame, std::int64_t now) {
  now_ = heard_at_ = now;
  std::vector<ServerMessage> messages;
  std::optional<base::Error> damage;
  while (!frame.empty() && !damage) {
    const auto bytes = next_in_frame(frame);
    auto message = bytes ? server_message(*bytes) : tl::unexpected(bytes.error());
    if (message)
      messages.push_back(std::move(*message));
    else
      damage = message.error();
  }
  // Own edits are taken back and redone once for all that a frame brings of others.
  const auto is_of_others = [this](const ServerMessage& it) {
    const auto* const ordered = std::get_if<Ordered>(&it);
    return ordered != nullptr && ordered->author != replica_.author();
  };
  const bool brings_much = replica_.pending() > 0 && std::ranges::count_if(messages, is_of_others) > 1;
  if (brings_much)
    if (const auto done = replica_.put_aside(); !done) begin_anew(done.error());
  for (ServerMessage& message : messages)
    if (!wants_to_close_) take_in(std::move(message));
  if (damage && !wants_to_close_) begin_anew(*damage);
  if (brings_much) replica_.refresh();
}

/// Everything is heard in the order in which it was said: what comes behind an edit whose contents are still
/// to come is held back.
void Conversation::take_in(ServerMessage message) {
  if (waits_for_contents(message)) {
    if (const auto* const ordered = std::get_if<Ordered>(&message)) held_back_bytes_ += ordered->edit.size();
    held_back_.push_back(std::move(message));
    if (held_back_bytes_ > kMostHeldBack)
      begin_anew({"Too much came while a shape or a picture was fetched."});
    return;
  }
  std::visit([this](auto& it) { hear(it); }, message);
}

bool Conversation::waits_for_contents(const ServerMessage& message) const {
  const bool is_about_now =
      std::holds_alternative<Piece>(message) || std::holds_alternative<Living>(message) ||
      std::holds_alternative<Presence>(message) || std::holds_alternative<Goodbye>(message);
  return contents_.is_fetching() && !is_about_now;
}

SharedBytes Conversation::next_frame(std::int64_t now) {
  now_ = now;
  if (!connected_) return nullptr;
  if (now - alive_said_ >= std::int64_t(lease_ > 0 ? lease_ : kUsualLease) / 4) {
    alive_said_ = now;
    queue(Alive{std::uint64_t(now)});
  }
  if (state_ == ConversationState::Live && conflicts_.empty()) {
    queue_edits();
    if (std::exchange(asks_again_, false)) ask_again();
  }
  std::string frame;
  while (!outgoing_.empty() && frame.size() < kFrameBytes) {
    add_to_frame(frame, outgoing_.front());
    outgoing_.pop_front();
  }
  if (state_ == ConversationState::Live && to_present_)
    add_to_frame(frame, to_bytes(ClientMessage(Present{*std::exchange(to_present_, std::nullopt)})));
  if (said_bye_ && outgoing_.empty()) wants_to_close_ = true;
  return frame.empty() ? nullptr : std::make_shared<const std::string>(std::move(frame));
}

void Conversation::queue(const ClientMessage& message) { outgoing_.push_back(to_bytes(message)); }

void Conversation::queue_edits() {
  std::size_t bytes = 0;
  while (bytes < kFrameBytes) {
    auto submit = replica_.next_to_send();
    if (!submit) break;
    bytes += submit->edit.size();
    queue_edit(std::move(*submit));
  }
  if (leaves_ && !said_bye_ && replica_.unacknowledged() == 0) {
    said_bye_ = true;
    queue(Bye{});
  }
}

/// A long edit goes in parts, so that no frame is long.
void Conversation::queue_edit(Submit submit) {
  if (submit.edit.size() <= kPartBytes) return queue(submit);
  const std::string whole = std::exchange(submit.edit, {});
  submit.total = whole.size();
  for (std::size_t at = 0; at < whole.size(); at += kPartBytes) {
    submit.edit = whole.substr(at, kPartBytes);
    queue(submit);
  }
}

void Conversation::change_state(ConversationState state, const std::string& why) {
  if (state == state_) return;
  state_ = state;
  seen_.emplace_back(SeenState{state, why});
}

/// The copy differs from the server's, or what it says cannot be read: everything is asked for once more.
void Conversation::begin_anew(const base::Error& error) {
  needs_anew_ = true;
  wants_to_close_ = true;
  why_ = error.message;
}

void Conversation::end(const std::string& why, Parting code) {
  why_ = why;
  parting_ = code;
  const bool may_be_tried_again =
      code == Parting::Other || code == Parting::ServerStops || code == Parting::TooSlow;
  if (code == Parting::TooSlow) needs_anew_ = true;
  if (!may_be_tried_again) change_state(ConversationState::Ended, why);
  wants_to_close_ = true;
}

// ---- what the server says

void Conversation::hear(Refused& message) { end(message.why, message.code); }
void Conversation::hear(Goodbye& message) { end(message.why, message.code); }

void Conversation::hear(Welcome& message) {
  why_.clear();
  if (history_ != 0 && message.history != history_)
    if (const auto done = notice_restored(message.author); !done) return begin_anew(done.error());
  replica_.set_author(message.author, message.last_number);
  role_ = message.role;
  history_ = message.history;
  lease_ = message.lease;
  welcome_ = message;
  settled_ = false;
  if (asks_for_choices_ && !before_ && replica_.pending() > 0)
    before_ = Before{replica_.world_of_server(), replica_.sequence()};
  change_state(ConversationState::Joining, "");
  if (!message.loads) return go_live_if_caught_up();
  loads_ = true;
  load();
}

/// Another author's number would make the ids of new things somebody else's: what is pending is given up
/// then.
base::Result<void> Conversation::notice_restored(std::uint32_t author) {
  seen_.emplace_back(SeenState{ConversationState::Joining, kRestored});
  replica_.begin_history();
  if (author == replica_.author()) return {};
  auto dropped = replica_.give_up_pending(kRestored);
  if (!dropped) return tl::unexpected(dropped.error());
  for (Dropped& it : *dropped) seen_.emplace_back(std::move(it));
  return {};
}

void Conversation::want_contents() {
  for (const Fetch& fetch : contents_.questions()) queue(fetch);
}

void Conversation::hear(Piece& message) {
  if (const auto done = contents_.take(message); !done) return begin_anew(done.error());
  contents_.is_fetching() ? want_contents() : go_on_with_contents();
}

void Conversation::go_on_with_contents() {
  if (loads_) load();
  while (!held_back_.empty() && !contents_.is_fetching() && !wants_to_close_) {
    ServerMessage next = std::move(held_back_.front());
    held_back_.pop_front();
    if (const auto* const ordered = std::get_if<Ordered>(&next)) held_back_bytes_ -= ordered->edit.size();
    std::visit([this](auto& it) { hear(it); }, next);
  }
}

/// Puts the contents of an edit in. False: they are still to come, and the edit waits for them.
bool Conversation::make_whole(Ordered& message) {
  if (!message.is_outline) return true;
  auto whole = contents_.whole(message.edit);
  if (!whole) {
    begin_anew(whole.error());
    return false;
  }
  if (!*whole) {
    held_back_bytes_ += message.edit.size();
    held_back_.emplace_front(std::move(message));
    want_contents();
    return false;
  }
  message.edit = std::move(**whole);
  message.is_outline = false;
  return true;
}

void Conversation::load() {
  if (welcome_->snapshot_bytes == 0) return begin_anew({"The server names a snapshot that is empty."});
  const ContentPointer outline = contents_.outline(welcome_->snapshot_hash, welcome_->snapshot_bytes);
  if (!outline) return want_contents();
  auto whole = contents_.whole(*outline);
  if (!whole) return begin_anew(whole.error());
  if (!*whole) return want_contents();
  loads_ = false;
  auto world = world_from_bytes(**whole, factory_);
  if (!world) return begin_anew(world.error());
  if (const auto done = replica_.begin(std::move(*world), welcome_->snapshot, welcome_->accepted); !done)
    return begin_anew(done.error());
  needs_anew_ = false;
  seen_.emplace_back(SeenDurable{welcome_->durable, replica_.durable({welcome_->durable})});
  queue(Loaded{welcome_->snapshot});
  go_live_if_caught_up();
}

double Conversation::progress() const {
  if (state_ == ConversationState::Live) return 1.0;
  if (!welcome_ || !loads_) return 0.0;
  const bool is_outline_here = contents_.bytes_to_fetch() > welcome_->snapshot_bytes;
  // Some contents are here already.
  const std::uint64_t all =
      is_outline_here ? contents_.bytes_to_fetch() : welcome_->snapshot_bytes + welcome_->content_bytes;
  return double(contents_.fetched_bytes()) / double(std::max<std::uint64_t>(all, 1));
}

/// Joined once all is here that the server had ordered when it said welcome.
void Conversation::go_live_if_caught_up() {
  if (!welcome_ || settled_ || replica_.sequence() < welcome_->sequence) return;
  settled_ = true;
  auto dropped = replica_.settle(welcome_->last_number, welcome_->loads ? welcome_->accepted_from : 0);
  if (!dropped) return begin_anew(dropped.error());
  for (Dropped& it : *dropped) seen_.emplace_back(std::move(it));
  find_conflicts();
  change_state(ConversationState::Live, "");
}

std::optional<KeptCopy> Conversation::keep() const {
  KeptCopy copy;
  copy.link = link_text(address_);
  copy.key = identity_.key;
  copy.history = history_;
  copy.role = role_;
  if (!replica_.keep_in(copy)) return std::nullopt;
  // Until a person has chosen, the next program, too, must find what others did since.
  if (before_) {
    copy.world = before_->world;
    copy.sequence = before_->sequence;
  }
  return copy;
}

void Conversation::resume(const KeptCopy& copy) {
  replica_.resume(copy);
  history_ = copy.history;
  role_ = copy.role;
  actions_before_ = 0;
}

void Conversation::find_conflicts() {
  if (!before_) return;
  made_here_ = replica_.pending_edits();
  conflicts_ = conflicts_of(made_here_, before_->world, replica_.world_of_server());
  if (conflicts_.empty()) return before_.reset();
  const world::World made = world_as_made_here();
  for (Conflict& it : conflicts_) {
    it.whose = replica_.last_other(it.item);
    it.name = called(is_there(made, it.item) ? made : before_->world, it.item);
  }
}

world::World Conversation::world_as_made_here() const {
  world::World world = before_->world;
  for (const world::Edit& edit : made_here_) (void)apply_fitted(world, edit);
  return world;
}

base::Result<void> Conversation::resolve(std::span<const Choice> choices, world::IdSource& ids) {
  const world::World made = world_as_made_here();
  const std::vector<Conflict> conflicts = std::exchange(conflicts_, {});
  before_.reset();
  made_here_.clear();
  base::Result<void> result;
  const auto note = [&](const auto& done) {
    if (!done && result) result = tl::unexpected(done.error());
  };
  for (std::size_t i = 0; i < conflicts.size(); ++i)
    if (choices[i] != Choice::Mine) note(replica_.give_up(conflicts[i].item));
  for (std::size_t i = 0; i < conflicts.size(); ++i) {
    const world::ObjectId object{conflicts[i].item.id};
    if (choices[i] != Choice::Both || conflicts[i].item.kind != ItemKind::Object || !made.find(object))
      continue;
    note(perform(copy_into(made, object, replica_.world(), ids), "Keep a copy"));
  }
  replica_.join_actions(actions_before_, "Work without the server");
  return result;
}

void Conversation::hear(Ordered& message) {
  if (!make_whole(message)) return;
  SeenEdit seen{message.last, message.author, 0, {}, {}};
  if (message.author == replica_.author() && message.number > 0) seen.number = message.number;
  if (const auto done = replica_.ordered(message); !done) return begin_anew(done.error());
  if (const world::Edit* const edit = replica_.last_ordered()) {
    seen.word = edit_word(*edit);
    for (const Touched& it : touched_by(*edit))
      if (seen.items.empty() || seen.items.back() != it.item) seen.items.push_back(it.item);
  }
  seen_.emplace_back(std::move(seen));
  go_live_if_caught_up();
}

void Conversation::hear(Accepted& message) {
  Ordered ordered{message.sequence, message.sequence, replica_.author(), message.number, {}, false};
  hear(ordered);
}

void Conversation::hear(Rejected& message) {
  auto dropped = replica_.rejected(message);
  if (!dropped) return begin_anew(dropped.error());
  if (*dropped) seen_.emplace_back(std::move(**dropped));
}

void Conversation::hear(Durable& message) {
  seen_.emplace_back(SeenDurable{message.sequence, replica_.durable(message)});
}

void Conversation::hear(Selected& message) {
  if (message.granted) holds_[message.item] = {message.item, replica_.author(), message.fence, 0};
  if (!message.granted && !message.waits) wanted_.erase(message.item);
  seen_.emplace_back(message);
}

void Conversation::hear(FloorChanged& message) {
  const auto found = holds_.find(message.item);
  const bool was_mine = found != holds_.end() && found->second.holder == replica_.author();
  if (message.holder == 0) {
    if (was_mine) wanted_.erase(message.item);
    if (found != holds_.end() && found->second.fence == message.fence) holds_.erase(found);
  } else {
    holds_[message.item] = message;
  }
  seen_.emplace_back(message);
}

void Conversation::hear(FloorState& message) {
  holds_.clear();
  for (const FloorChanged& hold : message.holds) holds_[hold.item] = hold;
  asks_again_ = true;
}

/// Asks for what was held before the connection was lost, and for what was wanted meanwhile.
void Conversation::ask_again() {
  for (const auto& [item, waits] : wanted_) {
    const auto found = holds_.find(item);
    if (found == holds_.end() || found->second.holder != replica_.author()) queue(Select{item, waits});
  }
}

void Conversation::hear(People& message) {
  for (const Person& person : message.people) {
    const auto known = people_.find(person.author);
    const bool was_here = known != people_.end() && known->second.here;
    people_[person.author] = person;
    if (!person.here) sightings_.erase(person.author);
    if (person.author == replica_.author()) role_ = person.role;
    if (person.here || was_here) seen_.emplace_back(person);
    if (!person.here && person.author >= kFirstGuest) people_.erase(person.author);  // who never comes again
  }
}

void Conversation::hear(Presence& message) { sightings_[message.author] = {message.where, now_}; }
void Conversation::hear(Said& message) { seen_.emplace_back(message); }
void Conversation::hear(Living& message) { delay_ = now_ - std::int64_t(message.echo); }

std::string Conversation::name_of(std::uint32_t author) const {
  const auto found = people_.find(author);
  const bool has_name =
      found != people_.end() && found->second.name.find_first_not_of(' ') != std::string::npos;
  return has_name ? found->second.name : "Somebody";
}

std::vector<Seen> Conversation::take_seen() { return std::exchange(seen_, {}); }

// ---- the design, the floor, people

std::vector<std::uint64_t> Conversation::fences_for(const world::Edit& edit) const {
  std::vector<std::uint64_t> fences;
  const auto add = [&](Item item) {
    const auto found = holds_.find(item);
    if (found != holds_.end() && found->second.holder == replica_.author())
      fences.push_back(found->second.fence);
  };
  const auto add_path = [&](world::ObjectId object) {
    while (const world::PhysicalObject* const it = replica_.world().find(object)) {
      add(item_of(object));
      object = it->parent;
    }
  };
  const Needs needs = needs_of(edit);
  for (const Item item : needs.items) {
    if (item.kind == ItemKind::Object) {
      add_path(world::ObjectId{item.id});
    } else {
      add(item);
    }
  }
  for (const world::ObjectId parent : needs.entered) add_path(parent);
  std::ranges::sort(fences);
  fences.erase(std::unique(fences.begin(), fences.end()), fences.end());
  return fences;
}

std::optional<std::string> Conversation::refusal(const world::Edit& edit) const {
  if (role_ < Role::Edit) return "You may look at this design, but not change it.";
  const auto obstacle = obstacle_to(edit, holds_, replica_.world(), replica_.author());
  if (!obstacle) return std::nullopt;
  return name_of(obstacle->holder) + " holds " + called(replica_.world(), obstacle->item) + ".";
}

base::Result<std::uint64_t> Conversation::perform(const world::Edit& edit, const std::string& name,
                                                  bool goes_on) {
  if (const auto why = refusal(edit)) return base::fail(*why);
  return replica_.perform(edit, name, fences_for(edit), goes_on);
}

base::Result<std::uint64_t> Conversation::turn(bool back) {
  std::uint32_t whose = 0;
  auto number = back ? replica_.undo({}, &whose) : replica_.redo({}, &whose);
  if (number || whose == 0) return number;
  return base::fail(number.error().message + " It was " + name_of(whose) + ".");
}

void Conversation::select(Item item, bool waits) {
  wanted_[item] = waits;
  if (state_ != ConversationState::Live || asks_again_) {
    asks_again_ = true;
    return;
  }
  if (!conflicts_.empty()) return;
  queue_edits();  // it may be of these
  queue(Select{item, waits});
}

void Conversation::deselect(Item item) {
  wanted_.erase(item);
  const auto found = holds_.find(item);
  if (found != holds_.end() && found->second.holder == replica_.author()) holds_.erase(found);
  if (!connected_ || !welcome_) return;
  // Edits that were made under the hold go first.
  if (state_ == ConversationState::Live && conflicts_.empty()) queue_edits();
  queue(Deselect{item});
}

void Conversation::take_away(Item item) {
  if (connected_ && welcome_) queue(TakeAway{item});
}

void Conversation::present(const Whereabouts& where) { to_present_ = where; }

base::Result<void> Conversation::say(const std::string& text) {
  if (state_ != ConversationState::Live)
    return base::fail("There is no connection: say it again when the server is back.");
  const std::int64_t until = std::max(said_until_, now_) + kLineTime;
  if (until > now_ + kLinesAtOnce * kLineTime) return base::fail("That is much at a time: wait a moment.");
  said_until_ = until;
  queue(Say{text});
  return {};
}

}  // namespace icome::collab
