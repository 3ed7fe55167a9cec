#include "files/journal/journal_mending.h"

#include <fmt/format.h>

#include <algorithm>

namespace icome::files {
namespace {

using world::Edit;

}  // namespace

std::optional<base::Error> JournalMending::perform(const Edit& edit) {
  const auto* const group = std::get_if<world::EditGroup>(&edit.what);
  if (group == nullptr) {
    const auto done = perform_one(edit);
    return done ? std::nullopt : std::optional(done.error());
  }
  std::optional<base::Error> first;
  for (const Edit& it : group->edits) {
    auto refused = perform(it);
    if (!first) first = std::move(refused);
  }
  return first;
}

base::Result<void> JournalMending::perform_one(const Edit& edit) {
  return world::replay(world_, std::visit([this](const auto& it) { return mended(it); }, edit.what), permit_);
}

std::size_t JournalMending::siblings(world::ObjectId parent) const {
  return parent ? world_.find(parent)->children.size() : world_.roots().size();
}

void JournalMending::drop_lost_parent(world::ObjectId& parent, const std::string& child) {
  if (!parent || world_.find(parent) != nullptr) return;
  lost_parents_.push_back({child, parent});
  parent = {};
}

Edit JournalMending::mended(world::CreateObject edit) {
  world::PhysicalObject& object = edit.object;
  drop_lost_parent(object.parent, object.name);
  if (object.geometry && world_.find(object.geometry) == nullptr) {
    findings_.tell(fmt::format("The object {} has lost its shape.", quoted_name(object.name)));
    object.geometry = {};
  }
  if (object.material && world_.find(object.material) == nullptr) {
    findings_.tell(fmt::format("The object {} has lost its material.", quoted_name(object.name)));
    object.material = {};
  }
  edit.place = std::min(edit.place, siblings(object.parent));
  return edit;
}

Edit JournalMending::mended(world::MoveObject edit) {
  const world::PhysicalObject* const object = world_.find(edit.id);
  if (object == nullptr) return edit;
  drop_lost_parent(edit.parent, object->name);
  const bool stays = object->parent == edit.parent;  // itself is not counted
  edit.place = std::min(edit.place, siblings(edit.parent) - (stays ? 1 : 0));
  return edit;
}

Edit JournalMending::mended(world::EnterScene edit) const {
  if (const world::Scene* const scene = world_.find(edit.scene))
    edit.place = std::min(edit.place, scene->roots.size());
  return edit;
}

void JournalMending::drop_lost_texture(world::Material& material) {
  if (!material.texture || world_.find(material.texture) != nullptr) return;
  findings_.tell(fmt::format("The material {} has lost its texture.", quoted_name(material.name)));
  material.texture = {};
}

Edit JournalMending::mended(world::CreateMaterial edit) {
  drop_lost_texture(edit.material);
  return edit;
}

Edit JournalMending::mended(world::ChangeMaterial edit) {
  drop_lost_texture(edit.material);
  return edit;
}

void JournalMending::compare(const JournalNames& names) {
  for (const auto& [id, name] : names) {
    if (world_.find(id) != nullptr || !missing_.try_emplace(id, name).second) continue;
    findings_.tell(fmt::format("The object {} is lost.", quoted_name(name)));
  }
}

std::vector<Remark> JournalMending::remarks() const {
  Findings all = findings_;
  for (const auto& [child, parent] : lost_parents_) {
    const auto known = missing_.find(parent);
    all.tell(fmt::format("The object {} has lost {}, which it was a part of, and stands at the top now.",
                         quoted_name(child),
                         known == missing_.end() ? "its parent" : quoted_name(known->second)));
  }
  return all.remarks();
}

}  // namespace icome::files
