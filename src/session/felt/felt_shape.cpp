#include "session/felt/felt_shape.h"

#include <fmt/format.h>

#include <utility>

#include "base/decompositions.h"
#include "geometry/csg/csg_emptiness.h"
#include "geometry/csg/csg_offset.h"
#include "geometry/csg/csg_solid.h"
#include "geometry/implicit/implicit_offset.h"
#include "geometry/loop/loop_offset.h"
#include "geometry/mesh/mesh_frame.h"
#include "geometry/mesh/mesh_repair.h"
#include "haptics/shapes/mesh_shape.h"
#include "haptics/shapes/primitive_shape.h"
#include "haptics/shapes/smooth_shape.h"
#include "session/felt/still_surface.h"
#include "session/felt/stretched.h"
#include "world/shape/geometry_check.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/visit_geometry.h"

namespace icome::session {
namespace {

using base::Matrix3;
using base::Vector3;
using Felt = std::shared_ptr<FeltShape>;

constexpr double kToleranceOfSize = 1.0 / 2000.0;
constexpr double kCellOfSize = 1.0 / 100.0;  // of solids that are sampled: facets are far nearer than a cell
constexpr double kLargestCoordinate = 1e70;  // what repairing a mesh can take

/// Makes felt shapes of all kinds of shapes.
class FeltShapeMaker {
 public:
  FeltShapeMaker(const Matrix3& felt_from_geometry, const FeltSettings& settings, const FeltShape* before)
      : map_(felt_from_geometry), settings_(settings), before_(before) {}

  Felt make(const world::Geometry& shape) const {
    if (map_.determinant() == 0.0) return untouchable("is too flat or too far away to be touched");
    Felt felt = world::visit_geometry(
        shape, [&](const world::MeshGeometry& it) { return of_mesh(it); },
        [&](const world::PrimitiveGeometry& it) { return of_primitive(it); },
        [&](const world::LoopGeometry& it) { return of_loop(it); },
        [&](const world::CsgGeometry& it) { return of_csg(it); },
        [&](const world::ImplicitGeometry& it) { return of_implicit(it); },
        [&](const world::Geometry& it) {
          return of_triangles(it, fmt::format("of the kind \"{}\"", it.kind()));
        });
    felt->felt_from_geometry = map_;
    return felt;
  }

 private:
  static Felt untouchable(std::string why) {
    auto felt = std::make_shared<FeltShape>();
    felt->remark = std::move(why);
    return felt;
  }

  bool sphere_tip() const { return settings_.tip_radius > 0.0; }

  Felt of_mesh(const world::MeshGeometry& shape) const {
    if (shape.mesh.triangles.empty()) return untouchable("is empty: there is nothing to touch");
    if (!world::complaint(shape.mesh).empty()) return untouchable("is damaged and cannot be touched");
    geometry::TriangleMesh mesh = shape.mesh;
    stretch(mesh, map_);
    const base::Bounds box = geometry::bounds(mesh);
    if (!(box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() < kLargestCoordinate))
      return untouchable("is too large to be touched");
    if (can_follow(mesh)) return following(std::move(mesh));
    const geometry::RepairReport report = geometry::repair(mesh);
    if (mesh.triangles.empty()) return untouchable("has no triangle with an area: there is nothing to touch");
    auto felt = std::make_shared<FeltShape>();
    felt->closed = report.surface.closed;
    felt->sound = !report.changed();
    felt->repairs = report.sentences();
    felt->middle = geometry::bring_near(mesh);
    felt->mesh = shared_mesh(shape, std::move(mesh));
    haptics::MeshShapeSettings settings;
    settings.closed = felt->closed;
    settings.interpolate_normals = settings_.interpolate_normals;
    settings.tip_radius = settings_.tip_radius;
    felt->shape = std::make_shared<haptics::MeshShape>(felt->mesh, settings);
    return felt;
  }

  /// The felt mesh: the shape's own where that is the same and may be shared.
  std::shared_ptr<const geometry::TriangleMesh> shared_mesh(const world::MeshGeometry& shape,
                                                            geometry::TriangleMesh felt) const {
    if (settings_.shares_meshes && felt.positions == shape.mesh.positions &&
        felt.triangles == shape.mesh.triangles) {
      if (auto owner = shape.weak_from_this().lock()) return {std::move(owner), &shape.mesh};
    }
    return std::make_shared<const geometry::TriangleMesh>(std::move(felt));
  }

  /// Is the mesh the one before, with its vertices elsewhere?
  bool can_follow(const geometry::TriangleMesh& mesh) const {
    return before_ && before_->sound && before_->felt_from_geometry == map_ &&
           before_->mesh->positions.size() == mesh.positions.size() &&
           before_->mesh->triangles == mesh.triangles && !geometry::has_flat_triangle(mesh);
  }

  Felt following(geometry::TriangleMesh mesh) const {
    auto felt = std::make_shared<FeltShape>(*before_);
    for (Vector3& position : mesh.positions) position -= felt->middle;
    felt->mesh = std::make_shared<const geometry::TriangleMesh>(std::move(mesh));
    const auto& shape = static_cast<const haptics::MeshShape&>(*before_->shape);
    felt->shape = std::make_shared<haptics::MeshShape>(shape, felt->mesh);
    return felt;
  }

  /// The triangles of a shape that cannot be touched as it is.
  Felt of_triangles(const world::Geometry& shape, const std::string& because,
                    double tolerance_of_size = kToleranceOfSize) const {
    const base::Bounds box = shape.bounds();
    if (box.isEmpty()) return untouchable("is empty: there is nothing to touch");
    const auto triangles = shape.triangles(tolerance_of_size * box.sizes().maxCoeff());
    if (!triangles) return untouchable("cannot be touched: " + triangles.error().message);
    Felt felt = of_mesh(**triangles);
    felt->exact = false;
    felt->repairs.clear();  // of triangles that nobody has made by hand
    if (felt->shape)
      felt->remark =
          fmt::format("is felt as {} triangles, as it is {}", felt->mesh->triangles.size(), because);
    return felt;
  }

  Felt of_primitive(const world::PrimitiveGeometry& shape) const {
    if (const std::string complaint = world::complaint(shape.primitive); !complaint.empty())
      return untouchable("cannot be touched: " + complaint);
    const Matrix3 map = map_ * shape.shape_from_primitive();
    if (const auto primitive = stretched(shape.primitive, map)) {
      auto felt = std::make_shared<FeltShape>();
      felt->primitive = *primitive;
      felt->shape = std::make_shared<haptics::PrimitiveShape>(*primitive);
      return felt;
    }
    geometry::CsgTree tree;
    tree.add_leaf(shape.primitive, base::Affine3(map));
    return of_tree(shape, std::move(tree), "stretched", kToleranceOfSize);
  }

  Felt of_csg(const world::CsgGeometry& shape) const {
    if (shape.bounds().isEmpty()) return untouchable("is empty: there is nothing to touch");
    return of_tree(shape, stretched(shape.tree, map_), "a CSG tree", kCellOfSize);
  }

  /// A tree as the tip feels it: triangles where a tip with a radius has no surface in closed form.
  Felt of_tree(const world::Geometry& shape, geometry::CsgTree tree, const std::string& what,
               double tolerance_of_size) const {
    const Vector3 middle = geometry::bring_near(tree);
    Felt felt = of_near_tree(shape, std::move(tree), what, tolerance_of_size);
    if (felt->exact) felt->middle = middle;
    return felt;
  }

  Felt of_near_tree(const world::Geometry& shape, geometry::CsgTree tree, const std::string& what,
                    double tolerance_of_size) const {
    if (!sphere_tip()) return of_tree(std::move(tree));
    const auto centres = geometry::CsgOffset::create(tree, settings_.tip_radius);
    if (!centres) {
      const std::string why = fmt::format("{} and the tip has a radius: {}", what, centres.error().message);
      return of_triangles(shape, why, tolerance_of_size);
    }
    Felt felt = of_tree(std::move(tree));
    if (felt->shape) felt->shape = std::make_shared<haptics::SmoothShape>(*centres, settings_.tip_radius);
    return felt;
  }

  static Felt of_tree(geometry::CsgTree tree) {
    const auto solid = std::make_shared<const geometry::CsgSolid>(tree);
    if (geometry::proved_empty(solid->program())) return untouchable("is empty: there is nothing to touch");
    auto felt = std::make_shared<FeltShape>();
    felt->shape = std::make_shared<haptics::SmoothShape>(solid);
    felt->solid = std::make_shared<const geometry::CsgTree>(std::move(tree));
    felt->inside = [solid = felt->solid](const Vector3& point, double) {
      return geometry::inside(*solid, point);
    };
    return felt;
  }

  Felt of_loop(const world::LoopGeometry& shape) const {
    if (shape.control.mesh.triangles.empty()) return untouchable("is empty: there is nothing to touch");
    if (!world::complaint(shape).empty()) return untouchable("is damaged and cannot be touched");
    geometry::ControlMesh control = stretched(shape.control, map_);
    auto felt = std::make_shared<FeltShape>();
    felt->middle = geometry::bring_near(control.mesh);
    const auto surface = geometry::LoopSurface::create(control);
    if (!surface) return untouchable("cannot be touched: " + surface.error().message);
    felt->closed = (*surface)->closed();
    if (sphere_tip()) {
      const auto centres = geometry::LoopOffset::create(*surface, settings_.tip_radius);
      if (!centres)
        return of_triangles(shape, "a Loop surface and the tip has a radius: " + centres.error().message);
      felt->shape = std::make_shared<haptics::SmoothShape>(*centres, settings_.tip_radius);
    } else {
      felt->shape = std::make_shared<haptics::SmoothShape>(*surface);
    }
    if (felt->closed)
      felt->inside = [it = *surface](const Vector3& point, double) { return it->inside(point); };
    return felt;
  }

  Felt of_implicit(const world::ImplicitGeometry& shape) const {
    if (map_ != Matrix3::Identity()) return of_triangles(shape, "a stretched implicit surface", kCellOfSize);
    auto felt = std::make_shared<FeltShape>();
    std::shared_ptr<const geometry::SmoothSurface> surface = shape.surface();
    if (sphere_tip()) {
      const auto centres =
          geometry::ImplicitOffset::create(shape.formula(), shape.surface()->box(), settings_.tip_radius);
      if (!centres) {
        const std::string why = "an implicit surface and the tip has a radius: " + centres.error().message;
        return of_triangles(shape, why, kCellOfSize);
      }
      surface = *centres;
    }
    const bool stilled = surface->changes() && !settings_.with_time;
    if (stilled) surface = std::make_shared<const StillSurface>(std::move(surface));
    felt->shape = std::make_shared<haptics::SmoothShape>(std::move(surface), settings_.tip_radius);
    felt->inside = [it = shape.surface(), stilled](const Vector3& point, double time) {
      if (stilled) time = 0.0;
      return it->bounds().contains(point) && it->value(point, time).value < 0.0;
    };
    return felt;
  }

  Matrix3 map_;
  const FeltSettings& settings_;
  const FeltShape* before_;  // null: nothing
};

/// The pose of the half-space that a half-space becomes.
base::Pose turned_to(const base::Affine3& world_from_primitive) {
  const Vector3 normal =
      (world_from_primitive.linear().inverse().transpose() * Vector3::UnitZ()).normalized();
  base::Pose pose = base::Pose::Identity();
  pose.linear() = base::rotation_between(Vector3::UnitZ(), normal).toRotationMatrix();
  pose.translation() = world_from_primitive.translation();
  return pose;
}

}  // namespace

FeltPlace felt_place(const world::Geometry& shape, const base::Affine3& world_from_geometry) {
  // Places within places may multiply to numbers that are not finite.
  if (!world_from_geometry.matrix().allFinite()) return {base::Pose::Identity(), Matrix3::Zero()};
  const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(&shape);
  if (!primitive) {
    const RigidPart part = rigid_part(world_from_geometry);
    return {part.world_from_felt, part.felt_from_shape};
  }
  // Taken apart in the primitive's own frame, so that an upright one that is stretched upwards stays one.
  const Matrix3 turn = primitive->shape_from_primitive();
  const base::Affine3 world_from_primitive = world_from_geometry * base::Affine3(turn);
  if (std::holds_alternative<geometry::Plane>(primitive->primitive))
    return {turned_to(world_from_primitive), turn.transpose()};
  const RigidPart part = rigid_part(world_from_primitive);
  return {part.world_from_felt, part.felt_from_shape * turn.transpose()};
}

FeltShapePointer make_felt_shape(const world::Geometry& shape, const Matrix3& felt_from_geometry,
                                 const FeltSettings& settings, const FeltShape* before) {
  return FeltShapeMaker(felt_from_geometry, settings, before).make(shape);
}

}  // namespace icome::session
