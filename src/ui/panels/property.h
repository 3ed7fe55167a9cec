#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "world/edit/edit.h"

namespace icome::ui {

/// A property of an object, which people see and change.
template <typename Value>
struct Property {
  using Get = std::function<std::optional<Value>(const world::World&, world::ObjectId)>;
  using Set = std::function<base::Result<world::Edit>(const world::World&, world::ObjectId, const Value&)>;

  Get get;  // nothing: the object has no such property
  Set set;  // for objects that have it
};

/// The value of a property that several objects have in common.
template <typename Value>
struct Common {
  bool shared_by_all = false;    // all have the property
  std::optional<Value> value{};  // the same for all; none: mixed
};

template <typename Value>
Common<Value> common(const world::World& world, const std::vector<world::ObjectId>& objects,
                     const Property<Value>& property) {
  Common<Value> result;
  for (const world::ObjectId id : objects) {
    const std::optional<Value> value = property.get(world, id);
    if (!value) return {};
    if (!result.shared_by_all) result.value = value;
    result.shared_by_all = true;
    if (result.value && *result.value != *value) result.value.reset();
  }
  return result;
}

/// The edit that sets the value for all objects; fails where one of them refuses it.
template <typename Value>
base::Result<world::Edit> edit_all(const world::World& world, const std::vector<world::ObjectId>& objects,
                                   const Property<Value>& property, const Value& value) {
  world::EditGroup group;
  for (const world::ObjectId id : objects) {
    auto edit = property.set(world, id, value);
    if (!edit) return tl::unexpected(edit.error());
    group.edits.push_back(std::move(*edit));
  }
  return world::Edit(std::move(group));
}

/// The selected objects by the parts that they consist of: one object stands for all that share a shape or a
/// material, so that a shared part is changed once.
struct Subjects {
  std::vector<world::ObjectId> objects = {};
  std::vector<world::ObjectId> dressed = {};    // all that have a shape or a material
  std::vector<world::ObjectId> shapes = {};     // one for each shape
  std::vector<world::ObjectId> materials = {};  // one for each material
  std::vector<world::ObjectId> lights = {};
  std::vector<world::ObjectId> viewpoints = {};
  std::vector<world::ObjectId> effects = {};
  bool all_have_materials = false;  // of those with a shape
};
Subjects subjects_of(const world::World& world, const std::vector<world::ObjectId>& selection);

}  // namespace icome::ui
