#include "apps/touch/design_eyes.h"

#include <utility>

#include "haptics/shapes/mesh_shape.h"
#include "session/felt/stretched.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::apps {
namespace {

using base::Affine3;
using base::Bounds;
using base::Vector3;
using geometry::TriangleMesh;

constexpr double kSmoothOff = 0.0005;       // of the size: tolerance for pictures of smooth surfaces
constexpr double kSampledCell = 1.0 / 100;  // of the size, of solids that are sampled

double tolerance_for(const world::Geometry& shape, const Bounds& box) {
  const bool sampled = shape.kind() == "csg" || shape.kind() == "implicit";
  return (sampled ? kSampledCell : kSmoothOff) * box.sizes().maxCoeff();
}

/// The triangles of a shape in the felt frame; none where it cannot be made triangles.
TriangleMesh triangles_of(const world::Geometry& shape, const session::FeltShape& felt) {
  const auto triangles = shape.triangles(tolerance_for(shape, shape.bounds()));
  if (!triangles) return {};
  TriangleMesh mesh = (*triangles)->mesh;
  session::stretch(mesh, felt.felt_from_geometry);
  for (Vector3& position : mesh.positions) position -= felt.middle;
  return mesh;
}

std::shared_ptr<TouchEye> make_eye(const world::GeometryPointer& shape,
                                   const session::FeltShapePointer& felt) {
  if (const auto mesh_shape = std::dynamic_pointer_cast<const haptics::MeshShape>(felt->shape))
    return std::make_shared<TouchEye>(mesh_shape);
  if (shape->kind() == "csg" && felt->solid) return nullptr;
  if (felt->primitive) return eye_of(*felt->primitive);
  return std::make_shared<TouchEye>([=] { return triangles_of(*shape, *felt); });
}

/// The box around a placed shape, as tight as the shape allows; empty for an unlimited one.
Bounds placed_bounds(const world::Geometry& shape, const Affine3& placing) {
  Bounds box;
  if (const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(&shape)) {
    if (std::holds_alternative<geometry::Plane>(primitive->primitive)) return box;
    return geometry::shape_bounds(primitive->primitive, placing * Affine3(primitive->shape_from_primitive()));
  }
  if (const auto* csg = dynamic_cast<const world::CsgGeometry*>(&shape)) {
    geometry::CsgTree tree = csg->tree;
    if (tree.empty()) return box;
    tree.set_transform(tree.root(), placing * tree.node(tree.root()).parent_from_node);
    return geometry::bounds(tree);
  }
  const Bounds own = shape.bounds();
  if (own.isEmpty() || !own.sizes().allFinite()) return box;
  const auto triangles = shape.triangles(tolerance_for(shape, own));
  if (!triangles) return own.transformed(placing);
  for (const Vector3& position : (*triangles)->mesh.positions) box.extend(placing * position);
  return box;
}

}  // namespace

const std::shared_ptr<TouchEye>& DesignEyes::eye(const world::GeometryPointer& shape,
                                                 const session::FeltShapePointer& felt) {
  const auto [found, fresh] = eyes_.try_emplace(felt.get());
  if (fresh) found->second = make_eye(shape, felt);
  return found->second;
}

double longest_side(const world::World& world) {
  Bounds box;
  for (const auto& [id, object] : world.objects()) {
    if (!object.geometry) continue;
    const Bounds own = placed_bounds(*world.find(object.geometry)->shape, world_from_object(world, id));
    if (!own.isEmpty() && own.sizes().allFinite()) box.extend(own);
  }
  return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

}  // namespace icome::apps
