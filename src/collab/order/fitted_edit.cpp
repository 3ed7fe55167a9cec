#include "collab/order/fitted_edit.h"

#include <algorithm>

namespace icome::collab {
namespace {

std::size_t siblings_in(const world::World& world, world::ObjectId parent) {
  if (!parent) return world.roots().size();
  const world::PhysicalObject* const object = world.find(parent);
  return object == nullptr ? 0 : object->children.size();
}

std::size_t most_place(const world::World& world, const world::CreateObject& it) {
  return siblings_in(world, it.object.parent);
}
std::size_t most_place(const world::World& world, const world::MoveObject& it) {
  const world::PhysicalObject* const object = world.find(it.id);
  const bool is_among_them = object != nullptr && object->parent == it.parent;
  return siblings_in(world, it.parent) - (is_among_them ? 1 : 0);
}
std::size_t most_place(const world::World& world, const world::EnterScene& it) {
  const world::Scene* const scene = world.find(it.scene);
  return scene == nullptr ? 0 : scene->roots.size();
}

/// All edits of the group, or none.
base::Result<world::Edit> apply_all(world::World& world, const world::EditGroup& group) {
  world::EditGroup back;
  for (const world::Edit& edit : group.edits) {
    auto inverse = apply_fitted(world, edit);
    if (!inverse) {
      for (auto done = back.edits.rbegin(); done != back.edits.rend(); ++done)
        (void)world::apply(world, *done);
      return inverse;
    }
    back.edits.push_back(std::move(*inverse));
  }
  std::reverse(back.edits.begin(), back.edits.end());
  return world::Edit(std::move(back));
}

}  // namespace

base::Result<world::Edit> apply_fitted(world::World& world, const world::Edit& edit) {
  if (const auto* const group = std::get_if<world::EditGroup>(&edit.what)) return apply_all(world, *group);
  const auto with_place = [&](const auto& it) -> base::Result<world::Edit> {
    if constexpr (requires { it.place; }) {
      if (const std::size_t most = most_place(world, it); it.place > most) {
        auto fitted = it;
        fitted.place = most;
        return world::apply(world, world::Edit(std::move(fitted)));
      }
    }
    return world::apply(world, edit);
  };
  return std::visit(with_place, edit.what);
}

}  // namespace icome::collab
