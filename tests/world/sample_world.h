#pragma once
#include <gtest/gtest.h>

#include "base/random.h"
#include "world/edit/copy.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::world {

inline GeometryPointer box(double size) {
  return std::make_shared<PrimitiveGeometry>(geometry::Box{Vector3::Constant(0.5 * size)});
}

inline GeometryPointer one_triangle() {
  geometry::TriangleMesh mesh;
  mesh.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  return std::make_shared<MeshGeometry>(std::move(mesh));
}

/// A triangle that was made of parameters.
inline GeometryPointer made_mesh(const std::string& recipe = "{\"shape\":\"Dreieck \xc3\xa4\",\"side\":1}") {
  auto shape = std::make_shared<MeshGeometry>(dynamic_cast<const MeshGeometry&>(*one_triangle()));
  shape->recipe = recipe;
  return shape;
}

inline Affine3 at(double x, double y, double z) { return Affine3(Eigen::Translation3d(x, y, z)); }

/// Applies what must work.
inline Edit applied(World& world, const Edit& edit) {
  auto inverse = apply(world, edit);
  if (!inverse) throw std::runtime_error(inverse.error().message);
  return std::move(*inverse);
}

/// Adds a shape and an object of it.
inline ObjectId add_object(World& world, IdSource& ids, const std::string& name, GeometryPointer shape,
                           ObjectId parent = {}, const Affine3& frame = Affine3::Identity()) {
  GeometryId geometry;
  if (shape) {
    geometry = ids.next<GeometryId>();
    applied(world, CreateGeometry{geometry, std::move(shape)});
  }
  const ObjectId id = ids.next<ObjectId>();
  const std::size_t place = parent ? world.find(parent)->children.size() : world.roots().size();
  applied(
      world,
      CreateObject{
          id, place, {.name = name, .parent = parent, .parent_from_object = frame, .geometry = geometry}});
  return id;
}

inline ObjectId duplicated(World& world, IdSource& ids, ObjectId model, Duplicate how, ObjectId parent = {}) {
  const auto made = duplicate(world, model, how, parent, ids);
  if (!made) throw std::runtime_error(made.error().message);
  applied(world, made->edit);
  return made->object;
}

}  // namespace icome::world
