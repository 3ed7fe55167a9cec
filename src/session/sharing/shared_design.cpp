#include "session/sharing/shared_design.h"

#include <utility>

#include "base/clock.h"
#include "collab/storage/design_state.h"

namespace icome::session {

namespace {

constexpr std::size_t kMostLines = 500;
constexpr std::int64_t kKeepEvery = 30'000'000'000;     // ns
constexpr std::int64_t kKeepAwayEvery = 3'000'000'000;  // while there is no server that has the edits
/// A server lets nobody have very many things; those behind them may be changed all the same while nobody
/// else has them.
constexpr std::size_t kMostHeld = 200;

}  // namespace

SharedDesign::SharedDesign(std::unique_ptr<collab::Connection> connection)
    : connection_(std::move(connection)) {
  talk().replica().on_change([this](const world::Edit* edit) {
    ++changes_;
    if (edit == nullptr) {
      way_ = {true, {}};
    } else if (!way_.is_another) {
      way_.edits.push_back(*edit);
    }
  });
}

base::Result<void> write_copy(const collab::KeptDesign& kept, std::optional<collab::KeptCopy> copy) {
  if (!copy) return {};
  copy->at = collab::wall_milliseconds();
  return kept.write(*copy);
}

void SharedDesign::keep_copy() {
  if (!kept) return;
  keeps_again_ = keeping_ != nullptr;
  if (keeps_again_) return;
  kept_changes_ = changes_;
  kept_at_ = base::steady_nanoseconds();
  keeping_ = std::make_unique<BackgroundTask<bool>>(
      [kept = kept, copy = talk().keep()]() mutable -> base::Result<bool> {
        if (const auto written = write_copy(*kept, std::move(copy)); !written)
          return tl::unexpected(written.error());
        return true;
      });
}

base::Result<void> SharedDesign::keep_copy_if_due() {
  base::Result<void> result;
  if (keeping_ && keeping_->is_done()) {
    if (const auto written = keeping_->take(); !written) result = tl::unexpected(written.error());
    keeping_.reset();
  }
  const bool is_away = talk().state() == collab::ConversationState::Away;
  const bool is_old = changes_ != kept_changes_ &&
                      base::steady_nanoseconds() - kept_at_ > (is_away ? kKeepAwayEvery : kKeepEvery);
  if (!keeping_ && (std::exchange(keeps_again_, false) || is_old)) keep_copy();
  return result;
}

std::unique_ptr<collab::Connection> SharedDesign::release() {
  keeping_.reset();  // waits for what is being written
  return std::move(connection_);
}

void SharedDesign::forget_copy() {
  keeping_.reset();  // waits for what is being written
  keeps_again_ = false;
  if (kept) kept->remove();
  kept.reset();
}

SharedDesign::Way SharedDesign::take_way() { return std::exchange(way_, {}); }

void SharedDesign::hold(std::span<const world::ObjectId> objects) {
  if (talk().role() < collab::Role::Edit) return;
  std::set<world::ObjectId> wanted;
  for (const world::ObjectId id : objects)
    if (wanted.size() < kMostHeld) wanted.insert(id);
  for (const collab::Item item : std::exchange(besides_, {})) talk().deselect(item);
  // First what is given back: an object and one below it may be in each other's way.
  for (const world::ObjectId id : held_)
    if (!wanted.contains(id)) {
      waited_.erase(collab::item_of(id));
      talk().deselect(collab::item_of(id));
    }
  for (const world::ObjectId id : wanted)
    if (!held_.contains(id)) talk().select(collab::item_of(id));
  held_ = std::move(wanted);
}

void SharedDesign::wait_for(world::ObjectId object) {
  held_.insert(object);
  waited_.insert(collab::item_of(object));
  talk().select(collab::item_of(object), true);
}

void SharedDesign::hold_for_action(collab::Item item) {
  if (besides_.size() < kMostHeld && besides_.insert(item).second) talk().select(item);
}

void SharedDesign::ask_again(collab::Item freed) {
  const world::World& world = talk().replica().world();
  const world::ObjectId object{freed.id};
  if (freed.kind != collab::ItemKind::Object || !world.find(object)) return;
  for (const world::ObjectId id : held_) {
    const auto hold = talk().holds().find(collab::item_of(id));
    const bool is_mine = hold != talk().holds().end() && hold->second.holder == talk().replica().author();
    if (is_mine || waited_.contains(collab::item_of(id)) || !world.find(id)) continue;
    if (world::is_within(world, id, object) || world::is_within(world, object, id))
      talk().select(collab::item_of(id));
  }
}

void SharedDesign::add_line(SharedLine line) {
  line.number = ++lines_so_far_;
  lines_.push_back(std::move(line));
  if (lines_.size() > kMostLines) lines_.pop_front();
}

void SharedDesign::note_person(const collab::Person& person) {
  // Programs that only read come and go all the time.
  if (person.author == talk().replica().author() || person.author >= collab::kFirstGuest) return;
  const bool changes = person.here ? here_.insert(person.author).second : here_.erase(person.author) > 0;
  if (changes) add_line({0, person.author, person.name, person.here ? "is here" : "has left", false});
}

void SharedDesign::note_who_left() {
  const std::set<std::uint32_t> before = here_;
  for (const std::uint32_t author : before)
    if (const auto found = talk().people().find(author);
        found != talk().people().end() && !found->second.here)
      note_person(found->second);
}

}  // namespace icome::session
