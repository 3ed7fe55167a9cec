#include "collab/client/replica.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "collab/order/fitted_edit.h"
#include "world/edit/edit_bytes.h"
#include "world/edit/edit_memory.h"
#include "world/edit/history.h"

namespace icome::collab {
namespace {

/// Does the newer of two edits make the older one needless?
bool replaces_one(const world::Edit& older, const world::Edit& newer) {
  if (const auto* const place = std::get_if<world::PlaceObject>(&older.what)) {
    const auto* const other = std::get_if<world::PlaceObject>(&newer.what);
    return other != nullptr && other->id == place->id;
  }
  const auto* const vertices = std::get_if<world::MoveVertices>(&older.what);
  const auto* const other = std::get_if<world::MoveVertices>(&newer.what);
  return vertices != nullptr && other != nullptr && vertices->id == other->id &&
         vertices->vertices == other->vertices;
}

/// Does it do so for each step of a drag of one thing or many?
bool replaces(const world::Edit& older, const world::Edit& newer) {
  const auto* const before = std::get_if<world::EditGroup>(&older.what);
  const auto* const after = std::get_if<world::EditGroup>(&newer.what);
  if (before && after) return std::ranges::equal(before->edits, after->edits, replaces_one);
  return replaces_one(older, newer);
}

/// More than a program makes between two times at which its copy is kept.
constexpr std::uint64_t kNumbersOfALife = 1'000'000;

tl::unexpected<base::Error> differs(const std::string& why) {
  return base::fail("This copy of the design differs from the server's: " + why);
}

}  // namespace

void Replica::set_author(std::uint32_t author, std::uint64_t last_number) {
  author_ = author;
  last_number_ = std::max(last_number_, last_number);
}

base::Result<world::Edit> Replica::change(const world::Edit& edit) {
  auto done = apply_fitted(world_, edit);
  if (!done) return tl::unexpected(done.error());
  if (listener_) listener_(&done->for_replicas);
  return std::move(done->inverse);
}

base::Result<void> Replica::take_back(const world::Edit& inverse) {
  const auto done = world::perform_shared(world_, inverse);
  if (!done) return differs(done.error().message);
  if (listener_) listener_(&done->for_replicas);
  return {};
}

/// The inverse of an own edit is another one when others' edits have come before it.
void Replica::set_inverse(std::uint64_t number, const world::Edit& inverse) {
  const auto own = own_.find(number);
  if (own != own_.end() && !own->second.is_covered) own->second.inverse = inverse;
}

/// Takes the own edits from `from` on back, the last one first.
base::Result<void> Replica::take_pending_back(std::size_t from) {
  for (std::size_t i = pending_.size(); i > from; --i) {
    Pending& it = pending_[i - 1];
    if (!it.inverse) continue;
    if (auto done = take_back(*std::exchange(it.inverse, std::nullopt)); !done) return done;
  }
  return {};
}

/// Those that do not apply now stay aside: others' next edits may make room for them before the server sees
/// them.
void Replica::redo_pending(std::size_t from) {
  if (aside_) return;
  for (std::size_t i = from; i < pending_.size(); ++i) {
    Pending& it = pending_[i];
    if (it.inverse) continue;
    auto inverse = change(it.edit);
    if (!inverse) continue;
    set_inverse(it.number, *inverse);
    it.inverse = std::move(*inverse);
  }
}

base::Result<void> Replica::put_aside() {
  auto done = take_pending_back();
  aside_ = true;
  return done;
}

void Replica::refresh() {
  aside_ = false;
  redo_pending();
}

bool Replica::merges_into_last(const world::Edit& edit) const {
  return !pending_.empty() && pending_.back().number == last_number_ && !pending_.back().was_sent &&
         pending_.back().inverse && replaces(pending_.back().edit, edit);
}

base::Result<std::uint64_t> Replica::perform(const world::Edit& edit, const std::string& name,
                                             std::vector<std::uint64_t> fences, bool goes_on) {
  if (const auto bytes = world::to_bytes(edit); !bytes) return tl::unexpected(bytes.error());
  auto inverse = change(edit);
  if (!inverse) return tl::unexpected(inverse.error());
  undone_.clear();
  goes_on = goes_on && !done_.empty();
  if (goes_on && done_.back().numbers.back() == last_number_ && merges_into_last(edit)) {
    pending_.back().edit = edit;  // the older inverse takes both back
    pending_.back().fences = std::move(fences);
    return last_number_;
  }
  const bool is_covered =
      goes_on && world::takes_back_both(own_.at(done_.back().numbers.front()).inverse, *inverse);
  if (!goes_on) done_.push_back({name, {}});
  const std::uint64_t number = add_pending(edit, name, std::move(*inverse), std::move(fences));
  if (is_covered) own_.insert_or_assign(number, Own{world::EditGroup{}, 0, true});
  done_.back().numbers.push_back(number);
  constexpr std::uint64_t kLookEvery = 256;  // actions: looking takes as long as there are many
  if (number % kLookEvery == 0) forget_oldest();
  return number;
}

/// An own edit that was applied, to be sent; can be taken back by its inverse.
std::uint64_t Replica::add_pending(const world::Edit& edit, const std::string& name, world::Edit inverse,
                                   std::vector<std::uint64_t> fences) {
  const std::uint64_t number = ++last_number_;
  own_.insert_or_assign(number, Own{inverse, 0, false});
  pending_.push_back({number, name, edit, std::move(fences), sequence_, false, false, std::move(inverse)});
  return number;
}

/// As a History does: the last action can always be taken back.
void Replica::forget_oldest() {
  std::size_t bytes = 0, kept = 0;
  while (kept < done_.size()) {
    for (const std::uint64_t number : done_[done_.size() - 1 - kept].numbers)
      bytes += world::memory_of(own_.at(number).inverse);
    if (kept > 0 && bytes > world::History::kMostBytes) break;
    ++kept;
  }
  const auto first = done_.end() - std::ptrdiff_t(kept);
  for (auto it = done_.begin(); it != first; ++it)
    for (const std::uint64_t number : it->numbers) own_.erase(number);
  done_.erase(done_.begin(), first);
}

std::optional<Submit> Replica::next_to_send() {
  // They are sent in order.
  const auto next = std::ranges::partition_point(pending_, &Pending::sent);
  if (next == pending_.end()) return std::nullopt;
  next->sent = next->was_sent = true;
  auto bytes = world::to_bytes(next->edit);
  // perform() takes only what can be written: what cannot would be refused by the server.
  return Submit{next->number,    next->base, next->fences, bytes ? std::move(*bytes) : std::string(), 0,
                next->takes_back};
}

bool Replica::has_unsent() const {
  return std::ranges::any_of(pending_, [](const Pending& it) { return !it.sent; });
}

std::size_t Replica::unacknowledged() const {
  return pending_.size() + covered_.size() +
         std::size_t(std::ranges::count_if(tentative_, [](const Tentative& it) { return it.number > 0; }));
}

std::uint64_t Replica::first_pending() const {
  std::uint64_t first = last_number_ + 1;
  for (const Pending& it : pending_) first = std::min(first, it.number);
  for (const Pending& it : covered_) first = std::min(first, it.number);
  for (const Tentative& it : tentative_)
    if (it.number > 0) first = std::min(first, it.number);
  return first;
}

base::Result<void> Replica::begin(world::World world, std::uint64_t sequence,
                                  const std::vector<std::uint64_t>& accepted) {
  for (Tentative& it : tentative_)
    if (it.number > 0) covered_.push_back(pending_again(std::move(it)));
  tentative_.clear();
  const auto is_covered = [&](const Pending& it) {
    return std::ranges::find(accepted, it.number) != accepted.end();
  };
  std::ranges::copy_if(pending_, std::back_inserter(covered_), is_covered);
  std::erase_if(pending_, is_covered);
  for (const Pending& it : covered_) forget(it.number);
  world_ = std::move(world);
  if (listener_) listener_(nullptr);
  has_base_ = true;
  base_ = sequence_ = sequence;
  for (Pending& it : pending_) it.inverse.reset();
  redo_pending();
  return {};
}

/// An own edit that is to be sent again.
Replica::Pending Replica::pending_again(Tentative it) {
  return {it.number, std::move(it.name), std::move(it.edit), std::move(it.fences), it.base, false,
          true,      std::nullopt};
}

base::Result<void> Replica::ordered(const Ordered& it) {
  if (it.last <= sequence_) return {};
  if (it.first > sequence_ + 1 || it.last < it.first) return differs("edits are missing in between.");
  if (it.author == author_ && it.number > 0) {
    const auto own = std::ranges::find(pending_, it.number, &Pending::number);
    if (own != pending_.end()) return accepted({it.number, it.last});
  }
  const auto edit = world::edit_from_bytes(it.edit, factory_);
  if (!edit) return tl::unexpected(edit.error());
  if (auto done = take_pending_back(); !done) return done;
  auto inverse = change(*edit);
  if (!inverse) return differs(inverse.error().message);
  sequence_ = it.last;
  note_others(*edit, it.last, it.author);
  tentative_.push_back({it.first, it.last, it.author, 0, {}, *edit, std::move(*inverse), {}, 0});
  redo_pending();
  return {};
}

base::Result<void> Replica::accepted(const Accepted& it) {
  if (it.sequence <= sequence_) return {};
  if (it.sequence != sequence_ + 1) return differs("the order of edits is not the server's.");
  const auto found = std::ranges::find(pending_, it.number, &Pending::number);
  if (found == pending_.end()) return differs("the server has ordered an edit that is not known here.");
  const auto index = std::size_t(found - pending_.begin());
  const bool comes_early =
      index > 0 || !found->inverse;  // before others of one's own, or it did not apply so far
  if (comes_early) {
    if (auto done = take_pending_back(); !done) return done;
    auto inverse = change(pending_[index].edit);
    if (!inverse) return differs(inverse.error().message);
    pending_[index].inverse = std::move(*inverse);
  }
  Pending own = std::move(pending_[index]);
  pending_.erase(pending_.begin() + std::ptrdiff_t(index));
  sequence_ = it.sequence;
  set_inverse(own.number, *own.inverse);
  if (const auto kept = own_.find(own.number); kept != own_.end()) kept->second.sequence = it.sequence;
  tentative_.push_back({it.sequence, it.sequence, author_, own.number, std::move(own.name),
                        std::move(own.edit), std::move(*own.inverse), std::move(own.fences), own.base});
  if (comes_early) redo_pending();
  return {};
}

void Replica::forget(std::uint64_t number) {
  own_.erase(number);
  for (std::vector<Action>* actions : {&done_, &undone_}) {
    for (Action& action : *actions) {
      // The inverse of the next one is known when it is redone.
      if (std::erase(action.numbers, number) > 0 && !action.numbers.empty())
        own_.at(action.numbers.front()).is_covered = false;
    }
    std::erase_if(*actions, [](const Action& action) { return action.numbers.empty(); });
  }
}

Dropped Replica::drop(std::size_t index, const std::string& why, std::uint32_t whose) {
  Pending& it = pending_[index];
  Dropped dropped{it.number, std::move(it.name), why, whose, std::move(it.edit)};
  pending_.erase(pending_.begin() + std::ptrdiff_t(index));
  forget(dropped.number);
  return dropped;
}

base::Result<std::optional<Dropped>> Replica::rejected(const Rejected& it) {
  const auto found = std::ranges::find(pending_, it.number, &Pending::number);
  if (found == pending_.end()) return std::nullopt;
  const auto index = std::size_t(found - pending_.begin());
  if (auto done = take_pending_back(index); !done) return tl::unexpected(done.error());
  Dropped dropped = drop(index, it.why, it.whose);
  redo_pending(index);
  return dropped;
}

std::vector<std::uint64_t> Replica::durable(const Durable& it) {
  std::vector<std::uint64_t> own;
  durable_ = std::max(durable_, it.sequence);
  while (!tentative_.empty() && tentative_.front().last <= durable_) {
    base_ = tentative_.front().last;
    if (tentative_.front().number > 0) own.push_back(tentative_.front().number);
    tentative_.pop_front();
  }
  if (base_ <= durable_)
    for (const Pending& covered : std::exchange(covered_, {})) own.push_back(covered.number);
  return own;
}

base::Result<std::vector<Dropped>> Replica::settle(std::uint64_t last_number, std::uint64_t accepted_from) {
  std::vector<Dropped> dropped;
  if (pending_.empty() || pending_.front().number > last_number) return dropped;
  if (auto done = take_pending_back(); !done) return tl::unexpected(done.error());
  while (!pending_.empty() && pending_.front().number <= last_number) {
    const bool is_known = pending_.front().number >= accepted_from;
    dropped.push_back(
        drop(0,
             is_known ? "The server refused it while the connection was lost."
                      : "The connection was lost for so long that nobody knows whether it was done: look "
                        "before doing it again.",
             0));
  }
  redo_pending();
  return dropped;
}

base::Result<std::vector<Dropped>> Replica::give_up_pending(const std::string& why) {
  std::vector<Dropped> dropped;
  if (auto done = take_pending_back(); !done) return tl::unexpected(done.error());
  while (!pending_.empty()) dropped.push_back(drop(0, why, 0));
  return dropped;
}

bool Replica::keep_in(KeptCopy& copy) const {
  if (!can_resume() || !covered_.empty()) return false;
  copy.sequence = base_;
  copy.author = author_;
  copy.last_number = last_number_;
  copy.lives = lives_;
  copy.world = world_;
  for (auto it = pending_.rbegin(); it != pending_.rend(); ++it)
    if (it->inverse) (void)world::apply(copy.world, *it->inverse);
  for (auto it = tentative_.rbegin(); it != tentative_.rend(); ++it)
    (void)world::apply(copy.world, it->inverse);
  for (const Tentative& it : tentative_)
    if (it.number > 0) copy.edits.push_back({it.number, it.name, it.base, it.fences, it.edit});
  for (const Pending& it : pending_) copy.edits.push_back({it.number, it.name, it.base, it.fences, it.edit});
  return true;
}

void Replica::resume(const KeptCopy& copy) {
  world_ = copy.world;
  if (listener_) listener_(nullptr);
  base_ = sequence_ = durable_ = copy.sequence;
  has_base_ = true;
  lives_ = copy.lives + 1;
  set_author(copy.author, copy.last_number + kNumbersOfALife);
  for (const KeptEdit& it : copy.edits) {
    pending_.push_back({it.number, it.name, it.edit, it.fences, it.base, false, true, std::nullopt});
    own_.insert_or_assign(it.number, Own{world::EditGroup{}, 0, false});
    done_.push_back({it.name, {it.number}});
  }
  redo_pending();
}

std::uint64_t Replica::first_free_number() const {
  constexpr unsigned kThingsOfALife = 24;  // bits
  return std::max(world_.next_number(author_), lives_ << kThingsOfALife);
}

world::World Replica::world_of_server() {
  world::World copy = world_;
  for (auto it = pending_.rbegin(); it != pending_.rend(); ++it)
    if (it->inverse) (void)world::apply(copy, *it->inverse);
  return copy;
}

std::vector<world::Edit> Replica::pending_edits() const {
  std::vector<world::Edit> edits;
  for (const Pending& it : pending_) edits.push_back(it.edit);
  return edits;
}

base::Result<void> Replica::give_up(Item item) {
  if (auto done = take_pending_back(); !done) return done;
  for (std::size_t i = pending_.size(); i > 0; --i) {
    const auto touched = touched_by(pending_[i - 1].edit);
    if (std::ranges::any_of(touched, [&](const Touched& it) { return it.item == item; }))
      (void)drop(i - 1, {}, 0);
  }
  redo_pending();
  return {};
}

void Replica::join_actions(std::size_t count, const std::string& name) {
  if (done_.size() < count + 2) return;
  Action joined{name, {}};
  for (std::size_t i = count; i < done_.size(); ++i)
    joined.numbers.insert(joined.numbers.end(), done_[i].numbers.begin(), done_[i].numbers.end());
  done_.resize(count);
  done_.push_back(std::move(joined));
}

void Replica::begin_history() {
  durable_ = 0;
  has_base_ = false;
  own_.clear();
  done_.clear();
  undone_.clear();
  others_.clear();
}

base::Result<void> Replica::rewind() {
  if (auto done = take_pending_back(); !done) return done;
  for (; !tentative_.empty(); tentative_.pop_back()) {
    Tentative& it = tentative_.back();
    if (auto done = take_back(it.inverse); !done) return done;
    if (it.number == 0) continue;
    if (const auto own = own_.find(it.number); own != own_.end()) own->second.sequence = 0;
    pending_.push_front(pending_again(std::move(it)));
  }
  for (; !covered_.empty(); covered_.pop_back()) pending_.push_front(std::move(covered_.back()));
  sequence_ = base_;
  // People choose where others worked meanwhile, so the server need not guard against it.
  for (Pending& it : pending_) it.sent = it.takes_back = false;
  redo_pending();
  return {};
}

void Replica::note_others(const world::Edit& edit, std::uint64_t sequence, std::uint32_t author) {
  if (author == author_) return;
  for (const Touched& it : touched_by(edit)) others_[it.item][it.aspect] = {sequence, author};
}

std::uint32_t Replica::last_other(Item item) const {
  const auto found = others_.find(item);
  if (found == others_.end()) return 0;
  return std::ranges::max_element(found->second, {}, [](const auto& it) { return it.second.sequence; })
      ->second.author;
}

/// The last edit of another behind `since` that gets in the way of taking something back by `edit`.
std::optional<Replica::Touch> Replica::later_touch(const world::Edit& edit, std::uint64_t since) const {
  for (const Touched& mine : touched_by(edit)) {
    const auto found = others_.find(mine.item);
    if (found == others_.end()) continue;
    for (const auto& [aspect, touch] : found->second)
      if (touch.sequence > since && get_in_the_way(mine.aspect, aspect)) return touch;
  }
  return std::nullopt;
}

base::Result<std::uint64_t> Replica::turn(std::vector<Action>& from, std::vector<Action>& to,
                                          std::vector<std::uint64_t> fences, std::uint32_t* whose) {
  const Action action = from.back();
  const auto stays = [&](const std::string& why) {
    return base::fail(
        fmt::format("\"{}\" stays as it is, as the design has changed since: {}", action.name, why));
  };
  world::EditGroup group;
  for (auto number = action.numbers.rbegin(); number != action.numbers.rend(); ++number) {
    const Own& own = own_.at(*number);
    const std::uint64_t since = own.sequence > 0 ? own.sequence : sequence_;
    if (const auto touch = later_touch(own.inverse, since)) {
      if (whose != nullptr) *whose = touch->author;
      return stays("somebody has changed the same thing after it.");
    }
    if (!own.is_covered) group.edits.push_back(own.inverse);
  }
  world::Edit edit =
      group.edits.size() == 1 ? world::Edit(group.edits.front()) : world::Edit(std::move(group));
  auto inverse = change(edit);
  if (!inverse) return stays(inverse.error().message);
  const std::uint64_t number = add_pending(edit, action.name, std::move(*inverse), std::move(fences));
  pending_.back().takes_back = true;
  from.pop_back();
  for (const std::uint64_t old : action.numbers) own_.erase(old);
  to.push_back({action.name, {number}});
  return number;
}

base::Result<std::uint64_t> Replica::undo(std::vector<std::uint64_t> fences, std::uint32_t* whose) {
  if (done_.empty()) return base::fail("There is nothing to undo.");
  return turn(done_, undone_, std::move(fences), whose);
}

base::Result<std::uint64_t> Replica::redo(std::vector<std::uint64_t> fences, std::uint32_t* whose) {
  if (undone_.empty()) return base::fail("There is nothing to redo.");
  return turn(undone_, done_, std::move(fences), whose);
}

}  // namespace icome::collab
