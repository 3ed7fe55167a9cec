#pragma once
#include <functional>
#include <memory>
#include <utility>

#include "geometry/primitive/primitive.h"
#include "haptics/shapes/mesh_shape.h"

namespace icome::apps {

/// The triangles that show a body: for pictures, for the looks of the simulated hand, and for the judge of a
/// body that is felt as them. For a body that is felt exactly they are made when they are first asked
/// for, and then kept. Bodies that share a shape share its eye. One thread owns it.
class TouchEye {
 public:
  using Mesh = std::shared_ptr<const geometry::TriangleMesh>;

  /// `make` is called once at most.
  explicit TouchEye(std::function<geometry::TriangleMesh()> make) : make_(std::move(make)) {}
  explicit TouchEye(Mesh mesh) : mesh_(std::move(mesh)) {}
  /// For a body that is felt as triangles, whose tree serves both.
  explicit TouchEye(const std::shared_ptr<const haptics::MeshShape>& felt);

  const Mesh& mesh();
  const geometry::TriangleTree& tree();

 private:
  using Tree = std::shared_ptr<const geometry::TriangleTree>;

  std::function<geometry::TriangleMesh()> make_;  // empty once it was called
  Mesh mesh_;                                     // null: not made yet
  Tree tree_;                                     // over `mesh_`; null: not made yet
};

/// The eye of a primitive for pictures: within 1/2000 of its size.
std::shared_ptr<TouchEye> eye_of(const geometry::Primitive& primitive);

}  // namespace icome::apps
