#include "collab/server/room.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "base/shown_text.h"
#include "collab/order/fitted_edit.h"
#include "collab/order/world_bytes.h"
#include "collab/protocol/message_bytes.h"
#include "collab/protocol/plain_line.h"
#include "world/edit/edit_bytes.h"

namespace icome::collab {
namespace {

constexpr unsigned kFenceShift = 32;  // fences of holds count up from the server's own lease, shifted by this

/// Colours of people, which can be told apart, and from the orange of what is selected, on light and dark
/// grounds.
constexpr std::array<std::uint32_t, 8> kColours{0x0072b2, 0x009e73, 0xcc79a7, 0x56b4e9,
                                                0x7b4fb5, 0xb5123e, 0x8a8a00, 0x00777b};
constexpr std::size_t kMostChatBytes = 2'000;

SharedBytes shared_bytes(const ServerMessage& message) {
  return std::make_shared<const std::string>(to_bytes(message));
}

base::Error missing_edit(const std::string& design, std::uint64_t sequence) {
  return {fmt::format("{}: edit {} is missing in the store, which icome store check looks into.",
                      base::shown_text(design), sequence)};
}

/// The next edits behind `after`, with none left out; empty only where the design ends there.
base::Result<std::vector<LogEntry>> read_behind(OpLog& log, const DesignRow& design, std::uint64_t after) {
  constexpr std::uint64_t kReadAtOnce = 16U << 20U;  // bytes
  auto entries = log.read_from(design.name, after, kReadAtOnce);
  if (!entries) return entries;
  std::uint64_t last = after;
  for (const LogEntry& entry : *entries)
    if (entry.sequence != ++last) return tl::unexpected(missing_edit(design.name, last));
  if (entries->empty() && after < design.sequence)
    return tl::unexpected(missing_edit(design.name, after + 1));
  return entries;
}

}  // namespace

base::Result<RoomStart> read_start(OpLog& log, const DesignRow& design, std::uint64_t fence) {
  auto snapshot = log.snapshot(design.name);
  if (!snapshot) return tl::unexpected(snapshot.error());
  RoomStart start{design.name, fence, design.history, std::move(*snapshot), {}, {}};
  auto names = log.author_names(design.name);
  if (!names) return tl::unexpected(names.error());
  start.names = std::move(*names);
  std::uint64_t after = design.kept_after;
  while (true) {
    auto entries = read_behind(log, design, after);
    if (!entries) {
      // The edits before the snapshot only spare those who come back from loading it.
      if (!start.snapshot || after >= start.snapshot->sequence) return tl::unexpected(entries.error());
      start.entries.clear();
      after = start.snapshot->sequence;
      continue;
    }
    if (entries->empty()) return start;
    after = entries->back().sequence;
    std::ranges::move(*entries, std::back_inserter(start.entries));
  }
}

Room::Room(std::string design, std::uint64_t fence, const RoomSettings& settings,
           const world::GeometryFactory& factory)
    : design_(std::move(design)),
      settings_(settings),
      factory_(factory),
      epoch_(fence << kFenceShift),
      floor_(epoch_),
      shelf_(settings.content_bytes) {}

base::Result<std::unique_ptr<Room>> Room::open(const RoomStart& start, const RoomSettings& settings,
                                               const world::GeometryFactory& factory) {
  std::unique_ptr<Room> room(new Room(start.design, start.fence, settings, factory));
  if (const auto done = room->replay(start); !done)
    return base::fail(fmt::format("The design \"{}\" cannot be read from the store: {}", start.design,
                                  done.error().message));
  return room;
}

base::Result<void> Room::replay(const RoomStart& start) {
  history_ = start.history;
  if (start.snapshot) {
    auto world = world_from_bytes(start.snapshot->bytes, factory_);
    if (!world) return tl::unexpected(world.error());
    world_ = std::move(*world);
    sequence_ = start.snapshot->sequence;
  }
  const std::uint64_t in_snapshot = sequence_;
  if (!start.entries.empty()) sequence_ = start.entries.front().sequence - 1;
  for (const LogEntry& entry : start.entries) {
    if (entry.sequence != sequence_ + 1) return base::fail(fmt::format("edit {} is missing.", sequence_ + 1));
    auto edit = world::edit_from_bytes(entry.edit, factory_);
    if (!edit) return tl::unexpected(edit.error());
    if (entry.sequence > in_snapshot) {
      if (const auto done = apply_fitted(world_, *edit); !done) return tl::unexpected(done.error());
    }
    append_to_tail(entry.author, entry.number, entry.edit, std::move(*edit));
  }
  if (sequence_ < in_snapshot) return base::fail(fmt::format("edit {} is missing.", sequence_ + 1));
  durable_ = sequence_;
  for (auto& [number, author] : authors_)
    if (const auto named = start.names.find(number); named != start.names.end())
      author.person = {number, named->second, 0, Role::View, false};
  return {};
}

// ---- coming and going

/// The first one that nobody else has who is here, for a person who has not chosen any.
std::uint32_t Room::free_colour(std::uint32_t author) const {
  const auto uses = [&](std::uint32_t colour) {
    return std::ranges::count_if(authors_, [&](const auto& it) {
      return it.first != author && it.second.person.here && it.second.person.colour == colour;
    });
  };
  return *std::ranges::min_element(kColours, {}, uses);
}

void Room::join(LinkId link, const Arrival& arrival, std::int64_t now) {
  for (auto& [other, member] : members_)
    if (member.who.author == arrival.author)
      part(member, "This person has come in from another place with the same key.", Parting::Other);
  Author& author = authors_[arrival.author];
  author.last_number = std::max(author.last_number, arrival.last_number);
  author.last_word = now;
  const std::uint32_t colour = arrival.colour != 0 ? arrival.colour : free_colour(arrival.author);
  author.person = {arrival.author, plain_line(arrival.name, kMostPersonBytes), colour, arrival.role, true};
  Member& member = members_[link];
  member.who = arrival;
  member.known_number = author.last_number;
  welcome(member, true);

  tell(member, everybody());
  FloorState state;
  for (const auto& [item, hold] : floor_.holds()) state.holds.push_back({item, hold.holder, hold.fence, 0});
  std::ranges::sort(state.holds, {}, &FloorChanged::fence);
  tell(member, state);
  tell_all(People{{author.person}}, &member);
}

/// Those who are here, and of those who have gone the ones who made edits last.
People Room::everybody() const {
  constexpr std::size_t kMostGone = 500;
  People people;
  std::vector<const Author*> gone;
  for (const auto& [number, author] : authors_) {
    if (author.person.here) people.people.push_back(author.person);
    if (!author.person.here && author.last_edit > 0 && !author.person.name.empty()) gone.push_back(&author);
  }
  std::ranges::sort(gone, std::ranges::greater{}, &Author::last_edit);
  gone.resize(std::min(gone.size(), kMostGone));
  for (const Author* const author : gone) people.people.push_back(author->person);
  return people;
}

/// Says where the client stands and from where it goes on: behind what it has, or with a snapshot.
void Room::welcome(Member& member, bool may_resume) {
  const Arrival& who = member.who;
  Welcome message;
  message.author = who.author;
  message.last_number = authors_[who.author].last_number;
  message.role = who.role;
  message.sequence = sequence_;
  message.durable = durable_;
  message.history = history_;
  message.lease = std::uint32_t(settings_.lease);
  const bool tail_begins_in_time =
      who.have == sequence_ || (!tail_.empty() && tail_.front().sequence <= who.have + 1);
  if (may_resume && who.has_world && who.history == history_ && who.have <= durable_ && tail_begins_in_time) {
    member.heard = who.have;
    member.loads.reset();
  } else {
    const SharedSnapshot& snapshot = snapshot_for_joining();
    message.loads = true;
    const Author& author = authors_[who.author];
    message.accepted_from = author.accepted.empty() ? author.last_number + 1 : author.accepted.front();
    for (const std::uint64_t number : author.accepted)
      if (number >= who.first_pending) message.accepted.push_back(number);
    message.snapshot = snapshot.sequence;
    message.snapshot_bytes = snapshot.world.shelved.outline->size();
    message.content_bytes = snapshot.world.shelved.bytes;
    message.snapshot_hash = snapshot.world.hash;
    member.loads = snapshot;
    member.heard = snapshot.sequence;
  }
  member.heard_durable = 0;
  tell(member, message);
}

/// The last snapshot, if the edits behind it are few and all here, or a new one.
const Room::SharedSnapshot& Room::snapshot_for_joining() {
  std::size_t behind = 0;
  for (auto edit = tail_.rbegin(); edit != tail_.rend() && edit->sequence > snapshot_.sequence; ++edit)
    behind += edit->bytes();
  const bool follows =
      snapshot_.sequence == sequence_ || (!tail_.empty() && tail_.front().sequence <= snapshot_.sequence + 1);
  if (!snapshot_.world.shelved.outline || !follows || behind > settings_.fresh_snapshot_bytes) {
    const auto bytes = world_to_bytes(world_);
    // Whatever is in the world came in as bytes.
    assert(bytes);
    snapshot_ = {sequence_, shelf_.take_world(bytes ? std::string_view(*bytes) : std::string_view())};
  }
  return snapshot_;
}

void Room::leave(LinkId link) {
  const auto found = members_.find(link);
  if (found == members_.end()) return;
  const std::uint32_t number = found->second.who.author;
  forget_parts(found->second);
  members_.erase(found);
  const auto is_same = [number](const auto& it) { return it.second.who.author == number; };
  if (std::ranges::any_of(members_, is_same)) return;
  Author& author = authors_[number];
  author.person.here = false;
  author.presence.reset();
  tell_all(People{{author.person}});
}

void Room::tick(std::int64_t now) {
  for (auto& [number, author] : authors_) {
    if (now - author.last_word <= settings_.lease) continue;
    const std::vector<Hold> released = floor_.release_all(number);
    if (released.empty()) continue;
    tell_free(released);
    grant_waiting();
  }
}

void Room::end(const std::string& why, Parting code) {
  for (auto& [link, member] : members_) part(member, why, code);
  // Nobody waits for the leases of those who have gone.
  for (const auto& [author, known] : authors_) floor_.release_all(author);
}

void Room::set_role(LinkId link, std::optional<Role> role) {
  const auto found = members_.find(link);
  if (found == members_.end()) return;
  Member& member = found->second;
  if (!role) {
    tell_free(floor_.release_all(member.who.author));
    grant_waiting();
    return part(member, "The invitation to this design has ended.", Parting::NotAllowed);
  }
  member.who.role = authors_[member.who.author].person.role = *role;
  tell_all(People{{authors_[member.who.author].person}});
}

void Room::part(Member& member, const std::string& why, Parting code) {
  if (member.parting) return;
  tell(member, Goodbye{why, code});
  member.parting = why;
}

bool Room::has_answer(LinkId link) const {
  const auto found = members_.find(link);
  return found != members_.end() && found->second.has_answer;
}

std::optional<std::string> Room::parting(LinkId link) const {
  const auto found = members_.find(link);
  if (found == members_.end() || !found->second.waiting.empty()) return std::nullopt;
  return found->second.parting;
}

// ---- what clients say

void Room::receive(LinkId link, ClientMessage message, std::int64_t now, std::int64_t at) {
  const auto found = members_.find(link);
  if (found == members_.end() || found->second.parting) return;
  Member& member = found->second;
  now_ = now;
  authors_[member.who.author].last_word = now;
  const auto handled = [&](auto& it) {
    if constexpr (std::is_same_v<std::decay_t<decltype(it)>, Submit>)
      handle(member, it, at);
    else
      handle(member, it);
  };
  std::visit(handled, message);
}

void Room::handle(Member& member, Hello&) { part(member, "A client says hello once.", Parting::Broken); }

void Room::handle(Member& member, Fetch& message) {
  const ContentPointer content = shelf_.find(message.hash);
  if (!content || message.offset >= content->size())
    return tell(member, Piece{message.hash, message.offset, {}});
  const std::uint64_t end =
      message.offset + std::min({message.bytes, kMostWanted, content->size() - message.offset});
  for (std::uint64_t at = message.offset; at < end; at += settings_.piece_bytes)
    tell(member, Piece{message.hash, at,
                       content->substr(at, std::min<std::uint64_t>(settings_.piece_bytes, end - at))});
}

void Room::handle(Member& member, Loaded& message) {
  if (member.loads && member.loads->sequence == message.snapshot) member.loads.reset();
}

void Room::handle(Member& member, Select& message) {
  const std::uint32_t author = member.who.author;
  Selected answer{.item = message.item};
  if (member.who.role < Role::Edit) {
    answer.why = "You may look at this design, but not change it.";
  } else if (floor_.count_of(author) >= settings_.most_holds) {
    answer.why = fmt::format("Nobody can hold more than {} things at a time.", settings_.most_holds);
  } else if (const auto hold = floor_.request(world_, author, message.item)) {
    answer.granted = true;
    answer.fence = hold->fence;
    tell_all(FloorChanged{message.item, author, hold->fence, 0}, &member);
  } else {
    const Obstacle obstacle = *floor_.obstacle(world_, author, message.item);
    answer.by = obstacle.holder;
    answer.obstacle = obstacle.item;
    answer.why = obstacle.holder == 0 ? fmt::format("{} is not there any more.", called(world_, message.item))
                                      : fmt::format("{} holds {}.", person_name(obstacle.holder),
                                                    called(world_, obstacle.item));
    answer.waits = message.waits && obstacle.holder != 0 &&
                   floor_.waiting_of(author) < settings_.most_waiting &&
                   floor_.waiting().size() < settings_.most_holds;
    if (answer.waits) floor_.wait(author, message.item);
  }
  member.has_answer = true;
  tell(member, answer);
}

void Room::handle(Member& member, Deselect& message) {
  const auto found = floor_.holds().find(message.item);
  const std::uint64_t fence = found == floor_.holds().end() ? 0 : found->second.fence;
  if (!floor_.release(member.who.author, message.item)) return;
  tell_free({{message.item, member.who.author, fence}});
  grant_waiting();
}

void Room::handle(Member& member, TakeAway& message) {
  if (member.who.role < Role::Own) return;
  const auto hold = floor_.take_away(message.item);
  if (!hold) return;
  tell_all(FloorChanged{hold->item, 0, hold->fence, member.who.author});
  grant_waiting();
}

void Room::handle(Member& member, Present& message) {
  Author& author = authors_[member.who.author];
  author.presence = shared_bytes(Presence{member.who.author, message.where});
  author.presence_version = ++presence_version_;
}

/// A few lines at once and then one a second: who says more is not heard, and nobody else suffers for it.
void Room::handle(Member& member, Say& message) {
  member.said_until = std::max(member.said_until, now_) + kLineTime;
  if (member.said_until > now_ + kLinesAtOnce * kLineTime) {
    member.said_until -= kLineTime;
    return;
  }
  tell_all(Said{member.who.author, plain_line(message.text, kMostChatBytes)});
}

void Room::handle(Member& member, Alive& message) { tell(member, Living{message.echo}); }

void Room::handle(Member& member, Bye&) {
  tell_free(floor_.release_all(member.who.author));
  grant_waiting();
  if (!member.parting) member.parting = "The client left.";
}

// ---- what clients hear

void Room::tell(Member& member, const ServerMessage& message) {
  if (member.parting) return;
  SharedBytes bytes = shared_bytes(message);
  member.waiting_bytes += bytes->size();
  member.waiting.push_back(std::move(bytes));
  if (member.waiting_bytes <= settings_.most_waiting_bytes) return;
  member.waiting = {
      shared_bytes(Goodbye{"The connection is too slow for what goes on here.", Parting::TooSlow})};
  member.waiting_bytes = member.waiting.front()->size();
  member.parting = "The client did not keep up.";
}

void Room::tell_all(const ServerMessage& message, const Member* but) {
  for (auto& [link, member] : members_)
    if (&member != but) tell(member, message);
}

void Room::tell_free(const std::vector<Hold>& holds) {
  for (const Hold& hold : holds) tell_all(FloorChanged{hold.item, 0, hold.fence, 0});
}

void Room::grant_waiting() {
  for (const Hold& hold : floor_.grant_waiting(world_)) {
    tell_all(FloorChanged{hold.item, hold.holder, hold.fence, 0});
    for (auto& [link, member] : members_)
      if (member.who.author == hold.holder)
        tell(member, Selected{.item = hold.item, .granted = true, .fence = hold.fence});
  }
}

std::string Room::person_name(std::uint32_t author) const {
  const auto found = authors_.find(author);
  return found == authors_.end() || found->second.person.name.empty() ? "Somebody"
                                                                      : found->second.person.name;
}

void Room::committed(std::uint64_t sequence) {
  durable_ = std::max(durable_, std::min(sequence, sequence_));
  trim_tail();
}

std::vector<LogEntry> Room::take_entries() { return std::exchange(entries_, {}); }

SharedBytes Room::next_frame(LinkId link, std::int64_t now) {
  const auto found = members_.find(link);
  if (found == members_.end()) return nullptr;
  Member& member = found->second;
  std::string frame;
  member.has_answer = false;
  add_waiting(member, frame);
  if (!member.parting && !member.loads) {
    add_edits(member, frame);
    add_presence(member, frame, now);
    add_durable(member, frame, now);
    add_waiting(member, frame);
  }
  return frame.empty() ? nullptr : std::make_shared<const std::string>(std::move(frame));
}

void Room::add_waiting(Member& member, std::string& frame) {
  while (!member.waiting.empty() && frame.size() < settings_.most_frame_bytes) {
    add_to_frame(frame, *member.waiting.front());
    member.waiting_bytes -= member.waiting.front()->size();
    member.waiting.pop_front();
  }
}

void Room::add_edits(Member& member, std::string& frame) {
  if (member.heard < sequence_ && (tail_.empty() || tail_.front().sequence > member.heard + 1))
    return welcome(member, false);  // it lags so far behind that it begins anew
  const std::uint64_t tail_begin = sequence_ + 1 - tail_.size();
  std::size_t index = std::size_t(member.heard + 1 - tail_begin);
  if (index < tail_.size() && tail_.size() - index < settings_.merge_from)
    frame.reserve(frame.size() +
                  std::min<std::size_t>(settings_.most_frame_bytes + tail_.back().framed.size(),
                                        framed_end_ - tail_[index].end + tail_[index].framed.size()));
  while (index < tail_.size() && frame.size() < settings_.most_frame_bytes) {
    const TailEdit& edit = tail_[index];
    if (edit.author == member.who.author) member.own = edit.sequence;
    if (edit.author == member.who.author && edit.number > member.known_number) {
      if (edit.creates) {
        add_to_frame(frame, to_bytes(ServerMessage(
                                Ordered{edit.sequence, edit.sequence, edit.author, edit.number, {}, true})));
      } else {
        add_to_frame(frame, to_bytes(ServerMessage(Accepted{edit.number, edit.sequence})));
      }
      ++index;
    } else if (tail_.size() - index >= settings_.merge_from) {
      index = add_merged(member, index, frame);
    } else {
      frame += edit.framed;
      ++index;
    }
    member.heard = tail_begin + index - 1;
  }
}

/// Who made an edit hears at once that it is durable; the others when there is something else to hear, or
/// soon.
void Room::add_durable(Member& member, std::string& frame, std::int64_t now) const {
  const std::uint64_t durable = std::min(durable_, member.heard);
  const bool waits = member.heard_durable < member.own && member.own <= durable;
  if (durable <= member.heard_durable || (frame.empty() && !waits && now < member.durable_next)) return;
  member.heard_durable = durable;
  member.durable_next = now + settings_.durable_gap;
  add_to_frame(frame, to_bytes(ServerMessage(Durable{durable})));
}

void Room::add_presence(Member& member, std::string& frame, std::int64_t now) {
  if (member.presence_heard == presence_version_ || now < member.presence_next) return;
  for (const auto& [number, author] : authors_) {
    if (number == member.who.author || !author.presence || author.presence_version <= member.presence_heard)
      continue;
    add_to_frame(frame, *author.presence);
  }
  member.presence_heard = presence_version_;
  member.presence_next = now + settings_.presence_gap;
}

/// Forgets edits that everybody has heard, but keeps some for those who come back; and in any case those that
/// are too many.
void Room::trim_tail() {
  const std::size_t kept = settings_.fresh_snapshot_bytes;
  if (tail_bytes_ <= kept) return;
  std::uint64_t heard = durable_;
  for (const auto& [link, member] : members_) heard = std::min(heard, member.heard);
  while (!tail_.empty() && ((tail_.front().sequence <= heard && tail_bytes_ > kept) ||
                            tail_bytes_ > settings_.most_tail_bytes)) {
    tail_bytes_ -= tail_.front().bytes();
    tail_.pop_front();
  }
}

}  // namespace icome::collab
