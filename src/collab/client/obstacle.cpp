#include "collab/client/obstacle.h"

namespace icome::collab {
namespace {

std::optional<FloorChanged> held_by_another(const Holds& holds, std::uint32_t author, Item item) {
  const auto found = holds.find(item);
  if (found == holds.end() || found->second.holder == author) return std::nullopt;
  return found->second;
}

std::optional<FloorChanged> hold_below(const Holds& holds, const world::World& world, std::uint32_t author,
                                       world::ObjectId object) {
  for (const auto& [item, hold] : holds) {
    if (item.kind != ItemKind::Object || hold.holder == author) continue;
    const world::ObjectId held{item.id};  // which may not have come yet
    if (world.find(held) && world::is_within(world, held, object)) return hold;
  }
  return std::nullopt;
}

}  // namespace

std::optional<FloorChanged> hold_over(const Holds& holds, const world::World& world, std::uint32_t author,
                                      world::ObjectId object) {
  if (holds.empty()) return std::nullopt;
  while (const world::PhysicalObject* const it = world.find(object)) {
    if (const auto found = held_by_another(holds, author, item_of(object))) return found;
    object = it->parent;
  }
  return std::nullopt;
}

std::optional<FloorChanged> obstacle_to(const world::Edit& edit, const Holds& holds,
                                        const world::World& world, std::uint32_t author) {
  if (holds.empty()) return std::nullopt;
  const Needs needs = needs_of(edit);
  for (const Item item : needs.items) {
    if (item.kind != ItemKind::Object) {
      if (const auto found = held_by_another(holds, author, item)) return found;
      continue;
    }
    const world::ObjectId object{item.id};
    if (const auto found = hold_over(holds, world, author, object)) return found;
    if (const auto found = hold_below(holds, world, author, object)) return found;
  }
  for (const world::ObjectId parent : needs.entered)
    if (const auto found = hold_over(holds, world, author, parent)) return found;
  return std::nullopt;
}

}  // namespace icome::collab
