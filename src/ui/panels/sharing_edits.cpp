#include "ui/panels/sharing_edits.h"

#include <map>

#include "ui/panels/object_look.h"

namespace icome::ui {

using world::ObjectId;
using world::PhysicalObject;

namespace {

/// The selected objects, grouped by their shape or material.
template <typename AnyId>
std::map<AnyId, std::vector<ObjectId>> users_by(const session::Session& session,
                                                AnyId PhysicalObject::*member) {
  std::map<AnyId, std::vector<ObjectId>> users;
  for (const ObjectId id : session.selection()) {
    if (const PhysicalObject* object = session.world().find(id)) users[object->*member].push_back(id);
  }
  return users;
}

}  // namespace

bool shares_shapes(const session::Session& session) {
  for (const auto& [shape, users] : users_by(session, &PhysicalObject::geometry)) {
    if (shape && session.world().find(shape)->users > users.size()) return true;
  }
  return false;
}

base::Result<void> make_own_shapes(session::Session& session) {
  world::EditGroup group;
  for (const auto& [shape, users] : users_by(session, &PhysicalObject::geometry)) {
    if (!shape || session.world().find(shape)->users <= users.size()) continue;
    const auto own = session.ids().next<world::GeometryId>();
    group.edits.emplace_back(world::CopyGeometry{own, shape});
    for (const ObjectId id : users) group.edits.emplace_back(world::ChooseGeometry{id, own});
  }
  if (group.edits.empty()) return {};
  return session.history().perform(world::Edit(std::move(group)),
                                   action_name("Make own shape for", session.world(), session.selection()));
}

bool needs_own_materials(const session::Session& session) {
  for (const auto& [material, users] : users_by(session, &PhysicalObject::material)) {
    if (!material || session.world().find(material)->users > users.size()) return true;
  }
  return false;
}

base::Result<void> make_own_materials(session::Session& session) {
  world::EditGroup group;
  for (const auto& [material, users] : users_by(session, &PhysicalObject::material)) {
    const world::Material* model = session.world().find(material);
    if (model && model->users <= users.size()) continue;
    const auto own = session.ids().next<world::MaterialId>();
    group.edits.emplace_back(world::CreateMaterial{own, model ? *model : world::Material{}});
    for (const ObjectId id : users) group.edits.emplace_back(world::ChooseMaterial{id, own});
  }
  if (group.edits.empty()) return {};
  return session.history().perform(
      world::Edit(std::move(group)),
      action_name("Make own material for", session.world(), session.selection()));
}

base::Result<void> choose_material(session::Session& session, world::MaterialId material) {
  world::EditGroup group;
  for (const ObjectId id : session.selection()) {
    const PhysicalObject* object = session.world().find(id);
    if (object && object->material != material) group.edits.emplace_back(world::ChooseMaterial{id, material});
  }
  if (group.edits.empty()) return {};
  return session.history().perform(world::Edit(std::move(group)),
                                   action_name("Choose material of", session.world(), session.selection()));
}

}  // namespace icome::ui
