#include "collab/server/floor.h"

#include <algorithm>

namespace icome::collab {

std::optional<Hold> Floor::request(const world::World& world, std::uint32_t holder, Item item) {
  if (obstacle(world, holder, item)) return std::nullopt;
  const auto [place, is_new] = holds_.try_emplace(item, Hold{item, holder, last_fence_ + 1});
  if (is_new) ++last_fence_;
  std::erase(waiting_, Waiting{item, holder});
  return place->second;
}

void Floor::wait(std::uint32_t holder, Item item) {
  const Waiting waiting{item, holder};
  if (std::find(waiting_.begin(), waiting_.end(), waiting) == waiting_.end()) waiting_.push_back(waiting);
}

bool Floor::release(std::uint32_t holder, Item item) {
  std::erase(waiting_, Waiting{item, holder});
  const auto found = holds_.find(item);
  if (found == holds_.end() || found->second.holder != holder) return false;
  holds_.erase(found);
  return true;
}

std::vector<Hold> Floor::release_if(const auto& is_released) {
  std::vector<Hold> released;
  for (const auto& [item, hold] : holds_)
    if (is_released(hold)) released.push_back(hold);
  // Tables keep no order, but what is told to clients should not depend on that.
  std::ranges::sort(released, {}, &Hold::fence);
  for (const Hold& hold : released) holds_.erase(hold.item);
  return released;
}

std::vector<Hold> Floor::release_all(std::uint32_t holder) {
  std::erase_if(waiting_, [holder](const Waiting& it) { return it.holder == holder; });
  return release_if([holder](const Hold& hold) { return hold.holder == holder; });
}

std::optional<Hold> Floor::take_away(Item item) {
  const auto found = holds_.find(item);
  if (found == holds_.end()) return std::nullopt;
  const Hold hold = found->second;
  holds_.erase(found);
  return hold;
}

std::vector<Hold> Floor::drop_missing(const world::World& world) {
  std::erase_if(waiting_, [&](const Waiting& it) { return !is_there(world, it.item); });
  return release_if([&](const Hold& hold) { return !is_there(world, hold.item); });
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
    return found ? found : below(world, holder, object);
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

/// The oldest hold of another below the object.
std::optional<Obstacle> Floor::below(const world::World& world, std::uint32_t holder,
                                     world::ObjectId object) const {
  const Hold* oldest = nullptr;
  for (const auto& [item, hold] : holds_) {
    if (item.kind != ItemKind::Object || hold.holder == holder) continue;
    if (oldest != nullptr && oldest->fence < hold.fence) continue;
    if (world::is_within(world, world::ObjectId{item.id}, object)) oldest = &hold;
  }
  if (oldest == nullptr) return std::nullopt;
  return Obstacle{oldest->item, oldest->holder};
}

bool Floor::is_held(std::uint32_t holder, std::uint64_t fence) const {
  return std::ranges::any_of(
      holds_, [&](const auto& it) { return it.second.holder == holder && it.second.fence == fence; });
}

std::size_t Floor::count_of(std::uint32_t holder) const {
  return std::size_t(
      std::ranges::count_if(holds_, [holder](const auto& it) { return it.second.holder == holder; }));
}

}  // namespace icome::collab
