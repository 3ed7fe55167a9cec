#pragma once
#include <compare>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "world/edit/edit.h"

namespace icome::collab {

/// The kinds of things of a design that can be requested, held and changed (thesis 2.4.1: "an item, e.g. an
/// object or a material").
enum class ItemKind : std::uint8_t { Object, Shape, Material, Texture, Scene };

/// A thing of a design by its kind and id.
struct Item {
  ItemKind kind = ItemKind::Object;
  std::uint64_t id = 0;

  auto operator<=>(const Item&) const = default;
};

inline Item item_of(world::ObjectId id) { return {ItemKind::Object, id.value}; }
inline Item item_of(world::GeometryId id) { return {ItemKind::Shape, id.value}; }
inline Item item_of(world::MaterialId id) { return {ItemKind::Material, id.value}; }
inline Item item_of(world::TextureId id) { return {ItemKind::Texture, id.value}; }
inline Item item_of(world::SceneId id) { return {ItemKind::Scene, id.value}; }

/// Is the thing in the world?
bool is_there(const world::World& world, Item item);
/// The name of a thing; empty for a shape, and for one without a name or that is not there.
std::string name_of(const world::World& world, Item item);
/// The thing in sentences: "leg", or "object 12" for one without a name.
std::string called(const world::World& world, Item item);

/// The side of a thing that an edit changes: edits of different sides do not get in each other's way.
enum class Aspect : std::uint8_t {
  Existence,  // it is made or deleted: gets in the way of all others
  Place,      // also under which parent
  Name,
  Shape,     // which one
  Material,  // which one
  Fixture,
  Motion,
  Content,  // of a shape, a material or a texture, or what is in a scene
};

inline constexpr std::size_t kAspects = std::size_t(Aspect::Content) + 1;
/// Do changes of these two sides of one thing get in each other's way?
inline bool get_in_the_way(Aspect one, Aspect other) {
  return one == other || one == Aspect::Existence || other == Aspect::Existence;
}

/// A side of a thing that an edit changes.
struct Touched {
  Item item;
  Aspect aspect = Aspect::Existence;

  auto operator<=>(const Touched&) const = default;
};

/// All that an edit changes, each once.
std::vector<Touched> touched_by(const world::Edit& edit);

/// The items that an edit needs for itself alone: what it changes, but for what it makes.
struct Needs {
  std::vector<Item> items = {};
  std::vector<world::ObjectId> entered =
      {};  // objects that get a child: neither they nor an ancestor may be held
};
Needs needs_of(const world::Edit& edit);

/// The word for what an edit does, for logs and scripts: "create", "translate", "delete" and so on. That of a
/// group is that of the first edit of an object in it, or the first of all; "group" for an empty
/// one.
std::string edit_word(const world::Edit& edit);

}  // namespace icome::collab

template <>
struct std::hash<icome::collab::Item> {
  std::size_t operator()(const icome::collab::Item& item) const noexcept {
    return std::size_t((item.id ^ (item.id >> 29) ^ std::uint64_t(item.kind) << 59) * 0x9e3779b97f4a7c15ULL);
  }
};

template <>
struct std::hash<icome::collab::Touched> {
  std::size_t operator()(const icome::collab::Touched& it) const noexcept {
    return std::hash<icome::collab::Item>()(it.item) + 0x9e3779b97f4a7c15ULL * std::size_t(it.aspect);
  }
};
