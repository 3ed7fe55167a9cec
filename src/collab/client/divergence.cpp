#include "collab/client/divergence.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "world/edit/edit_bytes.h"

namespace icome::collab {
namespace {

using world::ObjectId;
using world::World;

bool same_place(const world::PhysicalObject& a, const world::PhysicalObject& b) {
  return a.parent == b.parent && a.parent_from_object.matrix() == b.parent_from_object.matrix();
}

/// Worlds that were read anew have shapes, fixtures and motions of their own that are equal.
bool same_bytes(const world::Edit& a, const world::Edit& b) {
  const auto one = world::to_bytes(a), other = world::to_bytes(b);
  return one && other && *one == *other;
}

bool same_shape(world::GeometryId id, const world::GeometryPointer& a, const world::GeometryPointer& b) {
  return a == b || same_bytes(world::ReplaceGeometry{id, a}, world::ReplaceGeometry{id, b});
}

bool same_fixture(ObjectId id, const world::PhysicalObject& a, const world::PhysicalObject& b) {
  return a.fixture == b.fixture ||
         same_bytes(world::ChangeFixture{id, a.fixture}, world::ChangeFixture{id, b.fixture});
}

bool same_motion(ObjectId id, const world::PhysicalObject& a, const world::PhysicalObject& b) {
  return a.motion == b.motion ||
         same_bytes(world::ChangeMotion{id, a.motion}, world::ChangeMotion{id, b.motion});
}

bool same_texture(const world::Texture& a, const world::Texture& b) {
  return a.name == b.name && *a.bytes == *b.bytes && a.repeats == b.repeats;
}

bool same_material(world::Material a, world::Material b) {
  a.users = b.users = 0;  // by which objects it is used is no side of it
  return a == b;
}

bool same_object(ObjectId id, const world::PhysicalObject& a, const world::PhysicalObject& b, Aspect aspect) {
  const bool all = aspect == Aspect::Existence;
  if ((all || aspect == Aspect::Place) && !same_place(a, b)) return false;
  if ((all || aspect == Aspect::Name) && a.name != b.name) return false;
  if ((all || aspect == Aspect::Shape) && a.geometry != b.geometry) return false;
  if ((all || aspect == Aspect::Material) && a.material != b.material) return false;
  if ((all || aspect == Aspect::Fixture) && !same_fixture(id, a, b)) return false;
  return !(all || aspect == Aspect::Motion) || same_motion(id, a, b);
}

/// Is that side of a thing the same in both worlds? Its existence stands for all sides.
bool is_same(const World& before, const World& now, const Touched& side) {
  const std::uint64_t id = side.item.id;
  switch (side.item.kind) {
    case ItemKind::Object:
      return same_object(ObjectId{id}, *before.find(ObjectId{id}), *now.find(ObjectId{id}), side.aspect);
    case ItemKind::Shape:
      return same_shape(world::GeometryId{id}, before.find(world::GeometryId{id})->shape,
                        now.find(world::GeometryId{id})->shape);
    case ItemKind::Material:
      return same_material(*before.find(world::MaterialId{id}), *now.find(world::MaterialId{id}));
    case ItemKind::Texture:
      return same_texture(*before.find(world::TextureId{id}), *now.find(world::TextureId{id}));
    case ItemKind::Scene: {
      const world::Scene &a = *before.find(world::SceneId{id}), &b = *now.find(world::SceneId{id});
      return side.aspect == Aspect::Name ? a.name == b.name : a.name == b.name && a.roots == b.roots;
    }
  }
  return true;
}

/// Makes the edits of a copy.
class Copying {
 public:
  Copying(const World& model, const World& design, world::IdSource& ids)
      : model_(model), design_(design), ids_(ids) {}

  void add(ObjectId id, ObjectId parent, std::size_t place, const std::string& name) {
    world::PhysicalObject object = *model_.find(id);
    const std::vector<ObjectId> children = std::exchange(object.children, {});
    object.parent = parent;
    object.name = name;
    object.geometry = copied(object.geometry);
    if (!design_.find(object.material)) object.material = {};
    const auto fresh = ids_.next<ObjectId>();
    edits_.emplace_back(world::CreateObject{fresh, place, std::move(object)});
    for (std::size_t i = 0; i < children.size(); ++i)
      add(children[i], fresh, i, model_.find(children[i])->name);
  }
  world::Edit take() { return world::EditGroup{std::move(edits_)}; }

 private:
  world::GeometryId copied(world::GeometryId id) {
    if (!id) return id;
    const auto [found, is_new] = shapes_.try_emplace(id.value);
    if (is_new) {
      found->second = ids_.next<world::GeometryId>();
      edits_.emplace_back(world::CreateGeometry{found->second, model_.find(id)->shape});
    }
    return found->second;
  }

  const World& model_;
  const World& design_;
  world::IdSource& ids_;
  std::unordered_map<std::uint64_t, world::GeometryId> shapes_;
  std::vector<world::Edit> edits_;
};

}  // namespace

std::vector<Conflict> conflicts_of(std::span<const world::Edit> own, const World& before, const World& now) {
  std::vector<Conflict> conflicts;
  std::set<Item> met;
  for (const world::Edit& edit : own) {
    for (const Touched& side : touched_by(edit)) {
      if (!is_there(before, side.item) || met.contains(side.item)) continue;  // made here, or known already
      const bool is_gone = !is_there(now, side.item);
      if (!is_gone && is_same(before, now, side)) continue;
      met.insert(side.item);
      conflicts.push_back({.item = side.item, .is_gone = is_gone});
    }
  }
  return conflicts;
}

world::Edit copy_into(const World& model, ObjectId object, const World& design, world::IdSource& ids) {
  const world::PhysicalObject& it = *model.find(object);
  const world::PhysicalObject* const parent = design.find(it.parent);
  Copying copying(model, design, ids);
  copying.add(object, parent == nullptr ? ObjectId{} : it.parent,
              parent == nullptr ? design.roots().size() : parent->children.size(), it.name + " (copy)");
  return copying.take();
}

}  // namespace icome::collab
