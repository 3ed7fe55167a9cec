// The part of a room that puts edits in order: what it refuses, and what follows from what it takes.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/utf8.h"
#include "collab/order/fitted_edit.h"
#include "collab/protocol/message_bytes.h"
#include "collab/server/room.h"
#include "world/edit/edit_bytes.h"

namespace icome::collab {
namespace {

/// The first id that an edit gives to a new thing though it is not its author's to give.
struct FindWrongId {
  const world::World& world;
  std::uint32_t author;

  bool is_wrong(std::uint64_t id) const {
    const auto owner = std::uint32_t(id >> world::IdSource::kNumberBits);
    // Things that were deleted come back with the id that they had (undo).
    return owner != author && (id & world::IdSource::kNumberMask) >= world.next_number(owner);
  }
  bool operator()(const world::CreateObject& it) const { return is_wrong(it.id.value); }
  bool operator()(const world::CreateGeometry& it) const { return is_wrong(it.id.value); }
  bool operator()(const world::CopyGeometry& it) const { return is_wrong(it.id.value); }
  bool operator()(const world::CreateMaterial& it) const { return is_wrong(it.id.value); }
  bool operator()(const world::CreateTexture& it) const { return is_wrong(it.id.value); }
  bool operator()(const world::CreateScene& it) const { return is_wrong(it.id.value); }
  bool operator()(const world::ReserveIds& it) const {
    return it.author != author && it.last >= world.next_number(it.author);
  }
  bool operator()(const world::EditGroup& it) const {
    return std::ranges::any_of(it.edits,
                               [this](const world::Edit& edit) { return std::visit(*this, edit.what); });
  }
  template <typename Kind>
  bool operator()(const Kind&) const {
    return false;
  }
};

constexpr std::size_t kMostAccepted = 8'192;  // numbers that are remembered of an author

constexpr std::size_t kMostThingNameBytes = 4'096;

/// The first name that is too long, or no text.
struct FindBadName {
  static bool is_bad(const std::string& name) {
    return name.size() > kMostThingNameBytes || base::as_utf8(name) != name;
  }
  bool operator()(const world::CreateObject& it) const { return is_bad(it.object.name); }
  bool operator()(const world::RenameObject& it) const { return is_bad(it.name); }
  bool operator()(const world::CreateMaterial& it) const { return is_bad(it.material.name); }
  bool operator()(const world::ChangeMaterial& it) const { return is_bad(it.material.name); }
  bool operator()(const world::CreateTexture& it) const { return is_bad(it.texture.name); }
  bool operator()(const world::CreateScene& it) const { return is_bad(it.name); }
  bool operator()(const world::RenameScene& it) const { return is_bad(it.name); }
  bool operator()(const world::EditGroup& it) const {
    return std::ranges::any_of(it.edits,
                               [this](const world::Edit& edit) { return std::visit(*this, edit.what); });
  }
  template <typename Kind>
  bool operator()(const Kind&) const {
    return false;
  }
};

/// Does an edit put objects under other parents?
bool gives_parents(const world::Edit& edit) {
  if (const auto* const group = std::get_if<world::EditGroup>(&edit.what))
    return std::ranges::any_of(group->edits, gives_parents);
  return std::holds_alternative<world::MoveObject>(edit.what);
}

bool is_step_of_drag(const world::Edit& edit) {
  return std::holds_alternative<world::PlaceObject>(edit.what) ||
         std::holds_alternative<world::MoveVertices>(edit.what);
}

/// What a step of a drag sets: a later one with the same key makes it needless.
std::pair<Item, std::vector<std::uint32_t>> drag_key(const world::Edit& edit) {
  if (const auto* const place = std::get_if<world::PlaceObject>(&edit.what)) return {item_of(place->id), {}};
  const auto& moved = std::get<world::MoveVertices>(edit.what);
  return {item_of(moved.id), moved.vertices};
}

}  // namespace

/// Is the edit all here? Its parts are put together in the member.
bool Room::is_whole(Member& member, Submit& message) {
  if (message.total == 0 && member.parts.empty()) {
    if (message.edit.size() <= settings_.most_edit_bytes) return true;
    part(member, "The edit is too long.", Parting::Broken);
    return false;
  }
  member.parts += message.edit;
  parts_bytes_ += message.edit.size();
  if (message.total > settings_.most_edit_bytes || member.parts.size() > message.total ||
      parts_bytes_ > settings_.most_parts_bytes) {
    forget_parts(member);
    part(member, "The parts of an edit do not fit together, or are too many.", Parting::Broken);
    return false;
  }
  if (member.parts.size() < message.total) return false;
  message.edit = std::move(member.parts);
  parts_bytes_ -= message.edit.size();
  member.parts = {};
  return true;
}

void Room::forget_parts(Member& member) {
  parts_bytes_ -= member.parts.size();
  member.parts = {};
}

void Room::handle(Member& member, Submit& message, std::int64_t at) {
  const bool may_change = member.who.role >= Role::Edit;  // of who may not, nothing is kept
  if (may_change && !is_whole(member, message)) return;
  Author& author = authors_[member.who.author];
  if (message.number <= author.last_number) return;  // sent again after a connection was lost
  author.last_number = message.number;
  if (!may_change) return reject(member, message, "You may look at this design, but not change it.", 0);
  auto edit = world::edit_from_bytes(message.edit, factory_);
  if (!edit) return reject(member, message, edit.error().message, 0);
  if (const auto why = refusal(member, message, *edit)) return reject(member, message, why->why, why->whose);
  order(member, message, std::move(*edit), at);
}

void Room::reject(Member& member, const Submit& message, const std::string& why, std::uint32_t whose) {
  ++refused_;
  tell(member, Rejected{message.number, why, whose});
}

std::optional<Room::Refusal> Room::refusal(const Member& member, const Submit& message,
                                           const world::Edit& edit) const {
  const std::uint32_t author = member.who.author;
  if (std::visit(FindBadName{}, edit.what))
    return Refusal{fmt::format("A name is UTF-8 and at most {} bytes long.", kMostThingNameBytes)};
  if (std::visit(FindWrongId{world_, author}, edit.what))
    return Refusal{"The edit makes a new thing with somebody else's id."};
  if (const auto obstacle = floor_.obstacle(world_, author, needs_of(edit))) {
    if (obstacle->holder == 0)
      return Refusal{fmt::format("{} is not there any more.", called(world_, obstacle->item)),
                     author_of_last({obstacle->item, Aspect::Existence})};
    return Refusal{fmt::format("{} holds {}.", person_name(obstacle->holder), called(world_, obstacle->item)),
                   obstacle->holder};
  }
  return fenced(member, message, edit);
}

/// Does an undo or a redo come behind what others did to the same, or was the edit made under a hold that has
/// ended since? After this server began anew nobody has a hold: then it counts whether somebody else has
/// changed the things since the client looked.
std::optional<Room::Refusal> Room::fenced(const Member& member, const Submit& message,
                                          const world::Edit& edit) const {
  const std::uint32_t author = member.who.author;
  if (message.takes_back)
    for (const Touched& it : touched_by(edit))
      if (auto refusal = overtaken(author, it, message.base)) return refusal;
  bool is_of_earlier_life = false;
  for (const std::uint64_t fence : message.fences) {
    if (fence <= epoch_) {
      is_of_earlier_life = true;
    } else if (!floor_.is_held(author, fence)) {
      return Refusal{"The hold under which this was done has ended."};
    }
  }
  if (!is_of_earlier_life) return std::nullopt;
  const std::uint64_t known_from = tail_.empty() ? sequence_ : tail_.front().sequence - 1;
  if (message.base < known_from) return Refusal{"The design has changed too much since this was done."};
  for (const Touched& it : touched_by(edit))
    if (auto refusal = overtaken(author, {it.item, Aspect::Existence}, message.base)) return refusal;
  return std::nullopt;
}

/// Has somebody else changed this side of a thing, or one that gets in its way, since the client looked?
std::optional<Room::Refusal> Room::overtaken(std::uint32_t author, const Touched& mine,
                                             std::uint64_t base) const {
  for (std::size_t i = 0; i < kAspects; ++i) {
    if (!get_in_the_way(mine.aspect, Aspect(i))) continue;
    const auto found = changed_.find({mine.item, Aspect(i)});
    if (found == changed_.end() || found->second.sequence <= base || found->second.author == author) continue;
    return Refusal{fmt::format("{} has changed {} meanwhile.", person_name(found->second.author),
                               called(world_, mine.item)),
                   found->second.author};
  }
  return std::nullopt;
}

/// 0: nobody is known.
std::uint32_t Room::author_of_last(const Touched& change) const {
  const auto found = changed_.find(change);
  return found == changed_.end() ? 0 : found->second.author;
}

void Room::order(Member& member, const Submit& message, world::Edit edit, std::int64_t at) {
  if (const auto done = apply_fitted(world_, edit); !done)
    return reject(member, message, done.error().message, 0);
  entries_.push_back({sequence_ + 1, member.who.author, message.number, at, message.edit});
  append_to_tail(member.who.author, message.number, message.edit, std::move(edit));
  if (!floor_.holds().empty() || !floor_.waiting().empty()) floor_follows(tail_.back().edit);
  trim_tail();
}

void Room::append_to_tail(std::uint32_t author, std::uint64_t number, std::string bytes, world::Edit edit) {
  ++sequence_;
  for (const Touched& it : touched_by(edit)) changed_[it] = {sequence_, author};
  authors_[author].last_edit = sequence_;
  std::deque<std::uint64_t>& accepted = authors_[author].accepted;
  accepted.push_back(number);
  if (accepted.size() > kMostAccepted) accepted.pop_front();
  const bool creates = edit_word(edit) == "create";
  TailEdit added{sequence_, author, number, creates, std::move(edit)};
  added.shelved = shelf_.take_edit(bytes);
  const bool is_outline = !added.shelved.contents.empty();
  if (is_outline) bytes = *std::exchange(added.shelved.outline, nullptr);
  add_to_frame(added.framed, to_bytes(ServerMessage(Ordered{sequence_, sequence_, author, number,
                                                            std::move(bytes), creates, is_outline})));
  added.end = framed_end_ += added.framed.size();
  tail_bytes_ += added.bytes();
  tail_.push_back(std::move(added));
}

/// Deleted things are held no longer, and what was moved or deleted may make room for those who wait.
void Room::floor_follows(const world::Edit& edit) {
  const bool moves = gives_parents(edit);
  if (moves) floor_.objects_moved(world_);
  const std::vector<Touched> touched = touched_by(edit);
  const bool deletes = std::ranges::any_of(touched, [&](const Touched& it) {
    return it.aspect == Aspect::Existence && !is_there(world_, it.item);
  });
  if (deletes) tell_free(floor_.drop_missing(world_));
  if ((deletes || moves) && !floor_.waiting().empty()) grant_waiting();
}

/// Adds the edits from `index` on up to the next that is no step of a drag, or the client's own, as one: of
/// each drag its newest step. Gives the index behind them.
std::size_t Room::add_merged(Member& member, std::size_t index, std::string& frame) {
  std::size_t end = index;
  while (end < tail_.size() && is_step_of_drag(tail_[end].edit) && tail_[end].author != member.who.author)
    ++end;
  if (end - index < 2) {
    frame += tail_[index].framed;
    return index + 1;
  }
  std::set<std::pair<Item, std::vector<std::uint32_t>>> seen;
  world::EditGroup merged;
  for (std::size_t i = end; i > index; --i)
    if (seen.insert(drag_key(tail_[i - 1].edit)).second) merged.edits.push_back(tail_[i - 1].edit);
  std::ranges::reverse(merged.edits);
  const bool is_one_author =
      std::all_of(tail_.begin() + std::ptrdiff_t(index), tail_.begin() + std::ptrdiff_t(end),
                  [&](const TailEdit& it) { return it.author == tail_[index].author; });
  auto bytes = world::to_bytes(merged);
  if (!bytes) {  // together they are longer than an edit may be
    frame += tail_[index].framed;
    return index + 1;
  }
  add_to_frame(frame, to_bytes(ServerMessage(Ordered{tail_[index].sequence, tail_[end - 1].sequence,
                                                     is_one_author ? tail_[index].author : 0, 0,
                                                     std::move(*bytes), false})));
  return end;
}

}  // namespace icome::collab
