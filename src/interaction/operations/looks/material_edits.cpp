#include "interaction/operations/looks/material_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_set>

#include "interaction/operations/looks/material_library.h"
#include "interaction/operations/near_names.h"
#include "interaction/operations/object_frames.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using world::Material;
using world::MaterialId;
using world::ObjectId;
using world::World;

/// Names for new materials; none is given twice.
class MaterialNames {
 public:
  explicit MaterialNames(const World& world) {
    for (const auto& [id, material] : world.materials()) taken_.insert(material.name);
  }

  std::string unused(const std::string& wanted) {
    std::string name = wanted;
    for (std::size_t number = 2; !taken_.insert(name).second; ++number)
      name = fmt::format("{} {}", wanted, number);
    return name;
  }

 private:
  std::unordered_set<std::string> taken_;
};

/// The design's material of that name or number; none where there is none. Fails where there are several.
Result<MaterialId> named_material(const World& world, std::string_view name) {
  std::vector<MaterialId> found;
  for (const auto& [id, material] : world.materials()) {
    if (fmt::format("#{}", id.value) == name) return id;
    if (material.name == name) found.push_back(id);
  }
  std::ranges::sort(found);
  if (found.size() > 1)
    return fail(fmt::format("there are {} materials named '{}'; name one by its number, such as '#{}'",
                            found.size(), name, found.front().value));
  return found.empty() ? MaterialId() : found.front();
}

}  // namespace

Result<std::vector<ObjectId>> with_shapes(const World& world, std::span<const ObjectId> objects) {
  std::vector<ObjectId> found;
  std::unordered_set<ObjectId> taken;
  for (const ObjectId id : objects) {
    const bool shaped = bool(world.find(id)->geometry);
    bool any = false;
    for (const ObjectId part : shaped ? std::vector{id} : world::subtree(world, id)) {
      if (!world.find(part)->geometry) continue;
      any = true;
      if (taken.insert(part).second) found.push_back(part);
    }
    if (!any) return fail(fmt::format("{} has no shape to be seen or felt", called(world, id)));
  }
  return found;
}

world::Edit change_materials(const World& world, std::span<const ObjectId> objects,
                             const MaterialChange& change, world::IdSource& ids) {
  std::map<MaterialId, std::vector<ObjectId>> by_material;
  for (const ObjectId id : objects) by_material[world.find(id)->material].push_back(id);
  MaterialNames names(world);
  world::EditGroup group;
  for (const auto& [id, users] : by_material) {
    const Material* now = world.find(id);
    Material changed = now ? *now : Material();
    change.change(changed);
    if (now && (change.shared || now->users == users.size())) {
      group.edits.emplace_back(world::ChangeMaterial{id, std::move(changed)});
      continue;
    }
    changed.name = names.unused(now && !now->name.empty() ? now->name : change.name);
    const auto made = ids.next<MaterialId>();
    group.edits.emplace_back(world::CreateMaterial{made, std::move(changed)});
    for (const ObjectId user : users) group.edits.emplace_back(world::ChooseMaterial{user, made});
  }
  return group;
}

Result<ChosenMaterial> chosen_material(const World& world, const std::string& name, world::IdSource& ids) {
  const auto own = named_material(world, name);
  if (!own) return tl::unexpected(own.error());
  if (*own) return ChosenMaterial{*own};
  if (const Material* material = library_material(name)) {
    const auto id = ids.next<MaterialId>();
    return ChosenMaterial{id, {{world::CreateMaterial{id, *material}}}};
  }
  std::vector<std::string> names;
  for (const auto& [id, material] : world.materials()) names.push_back(material.name);
  for (const Material& material : material_library()) names.push_back(material.name);
  return fail(fmt::format("there is no material named '{}'{}", name, suggestion(name, std::move(names))));
}

std::string material_meaning() {
  std::string names;
  for (const Material& material : material_library()) names += (names.empty() ? "" : ", ") + material.name;
  return "a material of the design, or else one of " + names;
}

}  // namespace icome::interaction
