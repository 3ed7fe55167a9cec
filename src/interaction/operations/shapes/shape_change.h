#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "interaction/operations/operation.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {

// Common parts of operations on the vertices and triangles of one object's shape. All objects that share the
// shape change with it (thesis 2.4.1), unless `alone` is given.

/// The shape of an object that an operation is about to change.
struct ShapeChange {
  const world::World* world;
  world::ObjectId object;
  world::GeometryId shared;      // the object's shape
  world::GeometryPointer shape;  // to be changed: that one, or the triangles made of it
  bool made_triangles = false;   // is `shape` the triangles?
  bool alone = false;            // gets the object a shape of its own?
};

/// The triangles of the shape to be changed, off by no more than `tolerance` (m). Fails, too, where there
/// are none.
base::Result<world::GeometryPointer> triangles_of(const ShapeChange& change, double tolerance);

/// `object`; `alone`; and `as_mesh`, for operations that can make triangles first.
Parameter object_parameter(std::string meaning);
Parameter alone_parameter();
Parameter as_mesh_parameter();

/// The shape of the object that the arguments name, as it is. Fails for objects without one.
base::Result<ShapeChange> shape_change(const world::World& world, const Arguments& arguments);
/// The shape of one of several objects, with `alone` of the arguments.
base::Result<ShapeChange> shape_change(const world::World& world, world::ObjectId object,
                                       const Arguments& arguments);

/// The mesh to be changed. Triangles are made of other shapes first where `as_mesh` is given, else it fails,
/// saying what to do. Fails, too, for invalid meshes.
base::Result<std::shared_ptr<const world::MeshGeometry>> mesh_to_change(ShapeChange& change,
                                                                        const Arguments& arguments);
/// The mesh or control mesh whose vertices are to be moved, got in the same way. Valid while the change is.
base::Result<const geometry::TriangleMesh*> vertices_to_change(ShapeChange& change,
                                                               const Arguments& arguments);

/// "a mesh", "a Loop surface", "an exact shape", for sentences.
std::string kind_in_words(const world::Geometry& shape);

/// The mesh with its vertices at other positions (m, as many). All else stays, but for normals, which bend
/// with the surface, and the recipe, which is dropped.
world::GeometryPointer with_positions(const world::MeshGeometry& shape, std::vector<Vector3> positions);

/// The plan that puts another shape in the place of the one to be changed.
base::Result<Plan> plan_of_shape(const ShapeChange& change, const world::GeometryPointer& shape,
                                 world::IdSource& ids);
/// The plan that moves vertices of vertices_to_change() (each once, m). Corner normals bend with the surface.
/// Fails for places that are not finite.
base::Result<Plan> plan_of_vertices(const ShapeChange& change, std::vector<std::uint32_t> vertices,
                                    std::vector<Vector3> positions, world::IdSource& ids);

}  // namespace icome::interaction
