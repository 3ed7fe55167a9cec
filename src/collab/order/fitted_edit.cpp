#include "collab/order/fitted_edit.h"

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

std::optional<world::Edit> with_fitted_place(const world::World& world, const world::Edit& edit) {
  const auto fitted = [&](const auto& it) -> std::optional<world::Edit> {
    if constexpr (requires { it.place; }) {
      if (const std::size_t most = most_place(world, it); it.place > most) {
        auto nearer = it;
        nearer.place = most;
        return world::Edit(std::move(nearer));
      }
    }
    return std::nullopt;
  };
  return std::visit(fitted, edit.what);
}

}  // namespace

base::Result<world::SharedEdit> apply_fitted(world::World& world, const world::Edit& edit) {
  return world::perform_shared(world, edit, with_fitted_place);
}

}  // namespace icome::collab
