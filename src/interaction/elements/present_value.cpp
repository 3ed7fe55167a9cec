#include "interaction/elements/present_value.h"

#include <array>
#include <optional>

#include "interaction/elements/colour_wheel.h"
#include "interaction/operations/looks/material_edits.h"
#include "interaction/operations/shapes/shape_making.h"

namespace icome::interaction {
namespace {

using world::Material;

Value number_or_nothing(const std::optional<double>& number) { return number ? Value(*number) : Value(); }

Value present_feel(const world::TouchProperties& touch, std::string_view argument) {
  if (argument == "stiffness") return number_or_nothing(touch.stiffness);
  if (argument == "damping") return number_or_nothing(touch.damping);
  if (argument == "texture")
    return touch.texture.empty() ? "smooth" : touch.texture.substr(0, touch.texture.find(':'));
  return {};
}

/// The scale that is the same along all axes; nothing of what is mirrored.
Value present_factor(const base::Affine3& parent_from_object) {
  if (parent_from_object.linear().determinant() < 0.0) return {};
  const base::Vector3 scale = parent_from_object.linear().colwise().norm().transpose();
  constexpr double kEqual = 1e-9;  // share
  return scale.maxCoeff() - scale.minCoeff() <= kEqual * scale.maxCoeff() ? Value(scale.mean()) : Value();
}

Value present_making(const world::World& world, const world::PhysicalObject& object,
                     std::string_view argument) {
  const auto making = making_of(*world.find(object.geometry)->shape);
  const Value* const made_with = making ? field(*making, argument) : nullptr;
  return made_with != nullptr ? *made_with : Value();
}

}  // namespace

Value present_value(const world::World& world, world::ObjectId object, std::string_view operation,
                    std::string_view argument) {
  if (operation == "place" && argument == "factor")
    return present_factor(world.find(object)->parent_from_object);
  const auto shaped = with_shapes(world, std::array{object});
  if (!shaped) return {};
  const world::PhysicalObject& first = *world.find(shaped->front());
  if (operation == "reshape") return present_making(world, first, argument);
  const Material* const own = first.material ? world.find(first.material) : nullptr;
  if (operation == "material" && argument == "name") return own != nullptr ? Value(own->name) : Value();
  const Material material = own != nullptr ? *own : Material();
  if (operation == "colour" && argument == "colour") return colour_text(material.diffuse);
  return operation == "feel" ? present_feel(material.touch, argument) : Value();
}

}  // namespace icome::interaction
