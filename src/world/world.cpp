#include "world/world.h"

#include <algorithm>
#include <vector>

#include "world/hasher.h"
#include "world/motion.h"

namespace icome::world {
namespace {

void add_id(Hasher& hasher, std::uint64_t value) { hasher.add(value); }

void add_to(Hasher& hasher, const Light& it) {
  hasher.add(it.kind);
  hasher.add(it.on);
  for (const float part : it.colour) hasher.add(double(part));
  for (const float part : it.attenuation) hasher.add(double(part));
  for (const double value :
       {double(it.intensity), double(it.ambient), it.radius, it.cut_off_angle, it.beam_width})
    hasher.add(value);
  if (it.scoped) hasher.add(std::string_view("scoped"));
}

void add_to(Hasher& hasher, const Viewpoint& it) { hasher.add(it.field_of_view); }

void add_to(Hasher& hasher, const Inert& it) {
  hasher.add(std::string_view(it.type));
  hasher.add(std::string_view(it.source));
}

void add_to(Hasher& hasher, const ForceEffect& it) {
  hasher.add(std::string_view(it.text));
  hasher.add(it.on);
}

void add_to(Hasher& hasher, const KeyFrames& it) {
  hasher.add(it.interpolation);
  for (const std::vector<double>* numbers : {&it.times, &it.values}) {
    hasher.add(numbers->size());
    for (const double number : *numbers) hasher.add(number);
  }
  hasher.add(it.cycle);
  hasher.add(it.loops);
}

void add_to(Hasher& hasher, const Motion& it) {
  hasher.add(it.rest.translation);
  hasher.add(it.rest.rotation.coeffs());
  hasher.add(it.rest.scale);
  hasher.add(it.rest.centre);
  hasher.add(it.rest.stretch_axes.coeffs());
  for (const KeyFrames* frames : {&it.translation, &it.rotation, &it.scale}) add_to(hasher, *frames);
}

void add_to(Hasher& hasher, const PhysicalObject& it) {
  hasher.add(std::string_view(it.name));
  add_id(hasher, it.parent.value);
  hasher.add(it.children.size());
  for (const ObjectId child : it.children) add_id(hasher, child.value);
  hasher.add(it.parent_from_object.matrix());
  add_id(hasher, it.geometry.value);
  add_id(hasher, it.material.value);
  hasher.add(it.fixture ? it.fixture->index() + 1 : 0);
  if (it.fixture) std::visit([&](const auto& fixture) { add_to(hasher, fixture); }, *it.fixture);
  if (it.motion) add_to(hasher, *it.motion);
}

void add_to(Hasher& hasher, const GeometryObject& it) { hasher.add(it.shape->hash()); }

/// Adds nothing for materials that VRML 2.0 can express completely.
void add_beyond_vrml(Hasher& hasher, const Material& it) {
  const Material usual;
  if (it.picture_frame != usual.picture_frame) {
    for (const double number : it.picture_frame) hasher.add(number);
  }
  const auto add = [&](std::string_view what, auto Material::*member, auto as_number) {
    if (it.*member == usual.*member) return;
    hasher.add(what);
    hasher.add(as_number(it.*member));
  };
  const auto number = [](auto value) { return double(value); };
  const auto part = [](const std::optional<float>& value) { return double(value.value_or(-1.0F)); };
  add("tints", &Material::tints, number);
  add("alpha mode", &Material::alpha_mode, number);
  add("alpha cutoff", &Material::alpha_cutoff, number);
  add("unlit", &Material::unlit, number);
  add("double sided", &Material::double_sided, number);
  add("metallic", &Material::metallic, part);
  add("roughness", &Material::roughness, part);
}

void add_to(Hasher& hasher, const Material& it) {
  hasher.add(std::string_view(it.name));
  for (const float value : {it.ambient, it.shininess, it.transparency}) hasher.add(double(value));
  for (const Colour& colour : {it.diffuse, it.specular, it.emission}) {
    for (const float part : colour) hasher.add(double(part));
  }
  add_id(hasher, it.texture.value);
  for (const std::optional<double>& value : {it.touch.stiffness, it.touch.damping}) {
    hasher.add(value.has_value());
    hasher.add(value.value_or(0.0));
  }
  hasher.add(it.touch.static_friction);
  hasher.add(it.touch.dynamic_friction);
  hasher.add(std::string_view(it.touch.texture));
  add_beyond_vrml(hasher, it);
}

void add_to(Hasher& hasher, const Texture& it) {
  hasher.add(std::string_view(it.name));
  hasher.add(std::string_view(it.media_type));
  hasher.add(std::string_view(*it.bytes));
  for (const bool repeats : it.repeats) hasher.add(repeats);
}

void add_to(Hasher& hasher, const Scene& it) {
  hasher.add(std::string_view(it.name));
  hasher.add(it.roots.size());
  for (const ObjectId root : it.roots) add_id(hasher, root.value);
}

/// Adds a table in the order of ids, as tables keep no order.
template <typename Named>
void add_table(Hasher& hasher, const World::Table<Named>& table) {
  std::vector<Id<Named>> ids;
  for (const auto& [id, named] : table) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  hasher.add(ids.size());
  for (const Id<Named> id : ids) {
    add_id(hasher, id.value);
    add_to(hasher, table.at(id));
  }
}

}  // namespace

std::uint64_t World::next_number(std::uint32_t author) const {
  const auto found = last_numbers_.find(author);
  return found == last_numbers_.end() ? 1 : found->second + 1;
}

Affine3 world_from_object(const World& world, ObjectId id) {
  Affine3 result = Affine3::Identity();
  for (const PhysicalObject* object = world.find(id); object; object = world.find(object->parent))
    result = object->parent_from_object * result;
  return result;
}

bool is_within(const World& world, ObjectId id, ObjectId ancestor) {
  for (ObjectId at = id; at; at = world.find(at)->parent) {
    if (at == ancestor) return true;
  }
  return false;
}

std::vector<ObjectId> subtree(const World& world, ObjectId root) {
  std::vector<ObjectId> result{root};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::vector<ObjectId>& children = world.find(result[i])->children;
    result.insert(result.end(), children.begin(), children.end());
  }
  return result;
}

Bounds bounds(const World& world, ObjectId root) {
  Bounds result;
  std::unordered_map<ObjectId, Affine3> world_from;
  for (const ObjectId id : subtree(world, root)) {
    const PhysicalObject& object = *world.find(id);
    const Affine3 here = id == root ? world_from_object(world, root)
                                    : world_from.at(object.parent) * object.parent_from_object;
    world_from.emplace(id, here);
    if (!object.geometry) continue;
    const Bounds own = world.find(object.geometry)->shape->bounds();
    // Turning an infinite box would multiply 0 by infinity.
    const bool has_end = own.min().allFinite() && own.max().allFinite();
    if (!own.isEmpty() && has_end) result.extend(own.transformed(here));
  }
  return result;
}

ObjectId lit_group(const World& world, ObjectId light) {
  const PhysicalObject& object = *world.find(light);
  const auto* const lamp = object.fixture ? std::get_if<Light>(object.fixture.get()) : nullptr;
  if (lamp == nullptr || !lamp->scoped || lamp->kind != Light::Kind::Directional) return {};
  const bool is_nothing_else = !object.geometry && object.children.empty();
  return is_nothing_else ? object.parent : light;
}

std::uint64_t hash(const World& world) {
  Hasher hasher;
  add_table(hasher, world.objects());
  add_table(hasher, world.geometries());
  add_table(hasher, world.materials());
  add_table(hasher, world.textures());
  add_table(hasher, world.scenes());
  hasher.add(world.roots().size());
  for (const ObjectId root : world.roots()) add_id(hasher, root.value);
  return hasher.value();
}

}  // namespace icome::world
