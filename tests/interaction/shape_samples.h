#pragma once
#include <cmath>
#include <numbers>

#include "interaction/command_samples.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {

inline const world::PhysicalObject& object_named(const OperationRunner& runner, std::string_view name) {
  const auto id = named_object(runner.world(), name);
  if (!id) throw std::runtime_error(id.error().message);
  return *runner.world().find(*id);
}

inline const world::GeometryPointer& shape_named(const OperationRunner& runner, std::string_view name) {
  return runner.world().find(object_named(runner, name).geometry)->shape;
}

/// The primitive of an object that must be one.
template <typename Kind>
const Kind& solid_of(const OperationRunner& runner, std::string_view name) {
  return std::get<Kind>(dynamic_cast<const world::PrimitiveGeometry&>(*shape_named(runner, name)).primitive);
}

/// The mesh of an object that must be one.
inline const geometry::TriangleMesh& triangles_of(const OperationRunner& runner, std::string_view name) {
  return dynamic_cast<const world::MeshGeometry&>(*shape_named(runner, name)).mesh;
}

inline double polygon_area(int sides, double radius) {
  return 0.5 * sides * radius * radius * std::sin(2 * std::numbers::pi / sides);
}

}  // namespace icome::interaction
