#include "collab/server/floor.h"

#include <algorithm>

namespace icome::collab {

std::optional<Hold> Floor::request(const world::World& world, std::uint32_t holder, Item item) {
  if (obstacle(world, holder, item)) return std::nullopt;
  const auto [place, is_new] = holds_.try_emplace(item, Hold{item, holder, last_fence_ + 1});
  if (is_new) {
    ++last_fence_;
    ++counts_[holder];
    note_path(world, place->second);
  }
  erase_waiting([&](const Waiting& it) { return it == Waiting{item, holder}; });
  return place->second;
}

void Floor::wait(std::uint32_t holder, Item item) {
  const Waiting waiting{item, holder};
  if (std::find(waiting_.begin(), waiting_.end(), waiting) != waiting_.end()) return;
  waiting_.push_back(waiting);
  ++waiting_counts_[holder];
}

bool Floor::release(std::uint32_t holder, Item item) {
  erase_waiting([&](const Waiting& it) { return it == Waiting{item, holder}; });
  const auto found = holds_.find(item);
  if (found == holds_.end() || found->second.holder != holder) return false;
  erase(Hold(found->second));
  return true;
}

void Floor::erase_waiting(const auto& is_erased) {
  if (waiting_.empty()) return;
  std::erase_if(waiting_, [&](const Waiting& it) {
    if (!is_erased(it)) return false;
    if (--waiting_counts_[it.holder] == 0) waiting_counts_.erase(it.holder);
    return true;
  });
}

void Floor::erase(const Hold& hold) {
  forget_path(hold);
  if (--counts_[hold.holder] == 0) counts_.erase(hold.holder);
  holds_.erase(hold.item);
}

std::vector<Hold> Floor::release_if(const auto& is_released) {
  std::vector<Hold> released;
  for (const auto& [item, hold] : holds_)
    if (is_released(hold)) released.push_back(hold);
  // Tables keep no order, but what is told to clients should not depend on that.
  std::ranges::sort(released, {}, &Hold::fence);
  for (const Hold& hold : released) erase(hold);
  return released;
}

std::vector<Hold> Floor::release_all(std::uint32_t holder) {
  erase_waiting([holder](const Waiting& it) { return it.holder == holder; });
  if (count_of(holder) == 0) return {};
  return release_if([holder](const Hold& hold) { return hold.holder == holder; });
}

std::optional<Hold> Floor::take_away(Item item) {
  const auto found = holds_.find(item);
  if (found == holds_.end()) return std::nullopt;
  const Hold hold = found->second;
  erase(hold);
  return hold;
}

std::vector<Hold> Floor::drop_missing(const world::World& world) {
  erase_waiting([&](const Waiting& it) { return !is_there(world, it.item); });
  return release_if([&](const Hold& hold) { return !is_there(world, hold.item); });
}

void Floor::note_path(const world::World& world, const Hold& hold) {
  if (hold.item.kind != ItemKind::Object) return;
  std::vector<world::ObjectId>& path = paths_[hold.item];
  const world::PhysicalObject* object = world.find(world::ObjectId{hold.item.id});
  for (world::ObjectId above = object->parent; above; above = object->parent) {
    below_[above][hold.holder].insert(hold.item);
    path.push_back(above);
    object = world.find(above);
  }
}

void Floor::forget_path(const Hold& hold) {
  const auto path = paths_.find(hold.item);
  if (path == paths_.end()) return;
  for (const world::ObjectId above : path->second) {
    auto& holders = below_[above];
    holders[hold.holder].erase(hold.item);
    if (holders[hold.holder].empty()) holders.erase(hold.holder);
    if (holders.empty()) below_.erase(above);
  }
  paths_.erase(path);
}

void Floor::objects_moved(const world::World& world) {
  below_.clear();
  paths_.clear();
  for (const auto& [item, hold] : holds_)
    if (is_there(world, item)) note_path(world, hold);
}

std::vector<Hold> Floor::grant_waiting(const world::World& world) {
  std::vector<Hold> granted;
  const std::vector<Waiting> in_order = waiting_;
  for (const Waiting& it : in_order)
    if (const auto hold = request(world, it.holder, it.item)) granted.push_back(*hold);
  return granted;
}

std::optional<Obstacle> Floor::obstacle(const world::World& world, std::uint32_t holder, Item item) const {
  if (!is_there(world, item)) return Obstacle{item, 0};
  if (item.kind == ItemKind::Object) {
    const world::ObjectId object{item.id};
    const auto found = above(world, holder, object);
    return found ? found : below(holder, object);
  }
  const auto found = holds_.find(item);
  if (found == holds_.end() || found->second.holder == holder) return std::nullopt;
  return Obstacle{item, found->second.holder};
}

std::optional<Obstacle> Floor::obstacle(const world::World& world, std::uint32_t holder,
                                        const Needs& needs) const {
  for (const Item item : needs.items)
    if (const auto found = obstacle(world, holder, item)) return found;
  for (const world::ObjectId parent : needs.entered)
    if (const auto found = above(world, holder, parent)) return found;
  return std::nullopt;
}

/// The first hold of another on the way from the object, itself counted, to its root.
std::optional<Obstacle> Floor::above(const world::World& world, std::uint32_t holder,
                                     world::ObjectId object) const {
  if (holds_.empty()) return std::nullopt;
  while (object) {
    const auto found = holds_.find(item_of(object));
    if (found != holds_.end() && found->second.holder != holder)
      return Obstacle{found->first, found->second.holder};
    const world::PhysicalObject* const it = world.find(object);
    object = it == nullptr ? world::ObjectId{} : it->parent;
  }
  return std::nullopt;
}

/// A hold of another below the object.
std::optional<Obstacle> Floor::below(std::uint32_t holder, world::ObjectId object) const {
  const auto found = below_.find(object);
  if (found == below_.end()) return std::nullopt;
  for (const auto& [other, items] : found->second)
    if (other != holder) return Obstacle{*items.begin(), other};
  return std::nullopt;
}

bool Floor::is_held(std::uint32_t holder, std::uint64_t fence) const {
  return std::ranges::any_of(
      holds_, [&](const auto& it) { return it.second.holder == holder && it.second.fence == fence; });
}

std::size_t Floor::count_in(const Counts& counts, std::uint32_t holder) {
  const auto found = counts.find(holder);
  return found == counts.end() ? 0 : found->second;
}

}  // namespace icome::collab
