#include "world/collision/collision_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/mesh/mesh_repair.h"
#include "world/collision/triangle_meeting.h"
#include "world/shape/exact_surface.h"
#include "world/shape/geometry_check.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/usual_tolerance.h"
#include "world/shape/visit_geometry.h"

namespace icome::world {
namespace {

using geometry::Corners;
using geometry::TriangleMesh;

constexpr double kRounding = 1e-10;          // of the largest coordinate
constexpr double kLargestCoordinate = 1e70;  // limit of what mesh repair can take

double largest_coordinate(const Bounds& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

bool finite(const Bounds& box) { return box.min().allFinite() && box.max().allFinite(); }

/// Factor by which a map stretches all directions alike; nothing if they differ.
std::optional<double> even_stretch(const base::Matrix3& linear) {
  const base::Matrix3 metric = linear.transpose() * linear;
  const double square = metric.trace() / 3.0;
  if ((metric - square * base::Matrix3::Identity()).cwiseAbs().maxCoeff() > 1e-12 * square)
    return std::nullopt;
  return std::sqrt(square);
}

Bounds box_around(const Corners& corners) {
  Bounds box(corners[0]);
  return box.extend(corners[1]).extend(corners[2]);
}

TriangleMesh box_mesh(const Bounds& box) {
  TriangleMesh mesh = geometry::tessellate(geometry::Box{0.5 * box.sizes()}, 1.0);
  for (Vector3& position : mesh.positions) position += box.center();
  return mesh;
}

using Hit = CollisionShape::Hit;

/// The unit normal of the triangle that was hit on the way `step`. The hit point is rounded in proportion
/// to the length of the way, even near the origin.
Vector3 normal_at(const geometry::TriangleTree& tree, const geometry::MeshHit& hit, const Vector3& step) {
  Vector3 normal = Vector3::Zero();
  const double rounding = kRounding * std::max(hit.point.norm(), step.norm());
  tree.near(hit.point, hit.point, rounding, [&](std::uint32_t slot) {
    if (tree.triangle(slot) != hit.triangle) return true;
    const Corners& corners = tree.corners(slot);
    normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    return false;
  });
  return normal;
}

/// The first hit that leads into a closed mesh, or through an open one; ways out are passed over.
std::optional<Hit> hit_of_mesh(const geometry::TriangleTree& tree, bool closed, const Vector3& a,
                               const Vector3& b) {
  constexpr int kMostPassages = 8;
  constexpr double kOn = 1e-9;  // of the way: to be past the last one
  const Vector3 step = b - a;
  double from = 0.0;
  for (int i = 0; i < kMostPassages && from < 1.0; ++i) {
    const auto hit = tree.first_hit(a + from * step, b);
    if (!hit) return std::nullopt;
    const double share = from + hit->parameter * (1.0 - from);
    const Vector3 normal = normal_at(tree, *hit, step);
    const bool against = normal.dot(step) < 0.0;
    if (against || !closed) return Hit{share, against ? normal : Vector3(-normal)};
    from = share + kOn;
  }
  return std::nullopt;
}

/// The meeting that the gap between two surfaces means; a negative gap is an overlap.
Meeting by_gap(double gap, double rounding) {
  return gap > rounding ? Meeting::Apart : gap < -rounding ? Meeting::Overlapping : Meeting::Touching;
}

}  // namespace

CollisionShape::CollisionShape(GeometryPointer shape) : shape_(std::move(shape)), bounds_(shape_->bounds()) {
  if (const auto* primitive = dynamic_cast<const PrimitiveGeometry*>(shape_.get())) {
    shape_from_primitive_ = primitive->shape_from_primitive();
    if (std::holds_alternative<geometry::Plane>(primitive->primitive)) {
      kind_ = Kind::HalfSpace;
      return;
    }
    if (const auto* sphere = std::get_if<geometry::Sphere>(&primitive->primitive)) {
      kind_ = Kind::Sphere;
      radius_ = sphere->radius;
    }
  }
  if (bounds_.isEmpty() || !finite(bounds_) || largest_coordinate(bounds_) > kLargestCoordinate) {
    kind_ = Kind::Nothing;
    bounds_.setEmpty();
  }
}

const CollisionShape::Solid& CollisionShape::solid() {
  if (solid_) return *solid_;
  const auto made = shape_->triangles(usual_tolerance(*shape_));
  if (!made || !complaint((*made)->mesh).empty())
    solid_ = std::make_shared<const Solid>(box_mesh(bounds_), nullptr);
  else
    solid_ = std::make_shared<const Solid>((*made)->mesh, exact_surface(*shape_));
  return *solid_;
}

double CollisionShape::deviation(const Affine3& world_from_shape) const {
  const std::optional<double> stretch = even_stretch(world_from_shape.linear());
  if (kind_ == Kind::Sphere && stretch) return 0.0;
  if (kind_ == Kind::Nothing || kind_ == Kind::HalfSpace || !has_exact_surface(*shape_)) return 0.0;
  return stretch.value_or(world_from_shape.linear().norm()) * usual_deviation(*shape_);
}

std::optional<CollisionShape::Hit> CollisionShape::first_hit(const Vector3& a, const Vector3& b) {
  switch (kind_) {
    case Kind::Nothing:
      return std::nullopt;
    case Kind::HalfSpace:
      return hit_of_half_space(a, b);
    case Kind::Sphere:
      return hit_of_sphere(a, b);
    case Kind::Triangles:
      break;
  }
  const Solid& it = solid();
  if (!it.exact) return hit_of_mesh(*it.tree, it.closed, a, b);
  const auto place = way_into(*it.exact, a, b);
  return place ? std::optional(Hit{place->t, place->place.normal}) : std::nullopt;
}

std::optional<CollisionShape::Hit> CollisionShape::hit_of_half_space(const Vector3& a,
                                                                     const Vector3& b) const {
  const Vector3 normal = shape_from_primitive_ * Vector3::UnitZ();
  const double share = normal.dot(a) / normal.dot(a - b);
  if (!(normal.dot(b - a) < 0.0 && share >= 0.0 && share <= 1.0)) return std::nullopt;
  return Hit{share, normal};
}

std::optional<CollisionShape::Hit> CollisionShape::hit_of_sphere(const Vector3& a, const Vector3& b) const {
  const Vector3 step = b - a;
  const double square = step.squaredNorm(), half = a.dot(step);
  const double discriminant = half * half - square * (a.norm() - radius_) * (a.norm() + radius_);
  if (!(discriminant > 0.0)) return std::nullopt;
  const double share = (-half - std::sqrt(discriminant)) / square;
  if (!(share >= 0.0 && share <= 1.0)) return std::nullopt;
  return Hit{share, (a + share * step).normalized()};
}

std::uint64_t effort_to_look_into(const Geometry& shape) {
  constexpr std::uint64_t kPrimitive = 2'000;   // some hundred triangles
  constexpr std::uint64_t kATriangle = 20;      // repaired, sorted, and looked through for parts
  constexpr std::uint64_t kSolid = 20'000'000;  // meshed first: far too slow to wait for
  return visit_geometry(
      shape, [](const PrimitiveGeometry&) { return kPrimitive; },
      [](const MeshGeometry& it) { return kATriangle * it.mesh.triangles.size(); },
      [](const Geometry&) { return kSolid; });
}

std::uint64_t CollisionShape::effort_to_make() const {
  const bool is_made = solid_ || kind_ != Kind::Triangles;
  return is_made ? 0 : effort_to_look_into(*shape_);
}

CollisionShape::Solid::Solid(TriangleMesh mesh, std::shared_ptr<const geometry::SmoothSurface> surface)
    : exact(std::move(surface)) {
  const geometry::RepairReport report = geometry::repair(mesh);
  closed = report.surface.closed;
  tree.emplace(mesh);
  find_probes(mesh);
}

void CollisionShape::Solid::find_probes(const TriangleMesh& mesh) {
  const geometry::Patches patches = find_patches(mesh, edge_neighbours(mesh));
  struct Largest {
    double area = -1.0;
    std::size_t triangle = 0;
  };
  std::vector<Largest> largest(patches.count());
  const auto cross = [&](std::size_t t) {
    return Vector3((mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Largest& of_patch = largest[patches.patch_of_triangle[t]];
    const double area = cross(t).squaredNorm();
    if (area > of_patch.area) of_patch = {area, t};
  }
  const double size = tree->bounds().diagonal().norm();
  for (const Largest& it : largest) {
    const std::size_t t = it.triangle;
    const Vector3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    probes.push_back(middle);
    if (!closed) continue;
    // The probe lies half way to the opposite wall.
    const Vector3 inwards = -cross(t).normalized();
    const auto wall = tree->first_hit(middle + 1e-9 * size * inwards, middle + 2.0 * size * inwards);
    if (wall) probes.back() = 0.5 * (middle + wall->point);
  }
}

std::optional<CollisionShape::Ball> CollisionShape::ball(const Affine3& world_from_shape) const {
  if (kind_ != Kind::Sphere) return std::nullopt;
  const std::optional<double> stretch = even_stretch(world_from_shape.linear());
  if (!stretch) return std::nullopt;
  return Ball{world_from_shape.translation(), *stretch * radius_};
}

std::optional<CollisionShape::HalfSpace> CollisionShape::half_space(const Affine3& world_from_shape) const {
  if (kind_ != Kind::HalfSpace) return std::nullopt;
  const base::Matrix3 linear = world_from_shape.linear() * shape_from_primitive_;
  return HalfSpace{world_from_shape.translation(),
                   (linear.inverse().transpose() * Vector3::UnitZ()).normalized()};
}

/// The query whether two placed shapes meet; neither is of the kind Nothing.
class CollisionShape::Pair {
 public:
  Pair(const Placed& one, const Placed& other, Effort* effort) : one_(one), other_(other), effort_(effort) {
    for (const Placed& it : {one, other}) {
      if (!it.shape.unlimited())
        extent_ = std::max(extent_, largest_coordinate(it.shape.bounds_.transformed(it.world_from_shape)));
      extent_ = std::max(extent_, it.world_from_shape.translation().cwiseAbs().maxCoeff());
    }
    rounding_ = kRounding * extent_;
  }

  Meeting meeting() const {
    const std::optional<Ball> one = one_.shape.ball(one_.world_from_shape);
    const std::optional<Ball> other = other_.shape.ball(other_.world_from_shape);
    if (one_.shape.unlimited()) return with_half_space(one_, other_, other);
    if (other_.shape.unlimited()) return with_half_space(other_, one_, one);
    if (one && other)
      return by_gap((one->centre - other->centre).norm() - one->radius - other->radius, rounding_);
    if (one) return of_ball(*one, other_);
    if (other) return of_ball(*other, one_);
    return of_triangles();
  }

 private:
  Meeting with_half_space(const Placed& space, const Placed& other, const std::optional<Ball>& ball) const {
    const HalfSpace plane = *space.shape.half_space(space.world_from_shape);
    const auto height = [&](const Vector3& point) { return plane.normal.dot(point - plane.foot); };
    if (other.shape.unlimited()) {
      const HalfSpace facing = *other.shape.half_space(other.world_from_shape);
      // Only half-spaces with opposite normals can be apart.
      const bool parallel = (plane.normal + facing.normal).cwiseAbs().maxCoeff() < 1e-12;
      return parallel ? by_gap(height(facing.foot), rounding_) : Meeting::Overlapping;
    }
    if (ball) return by_gap(height(ball->centre) - ball->radius, rounding_);
    const Bounds box = other.shape.bounds_.transformed(other.world_from_shape);
    if (height(box.center()) - 0.5 * box.sizes().dot(plane.normal.cwiseAbs()) > rounding_)
      return Meeting::Apart;
    const geometry::TriangleTree& tree = *other.shape.solid().tree;
    constexpr std::uint64_t kTrianglesAUnit = 8;
    (void)may_go_on(tree.size() / kTrianglesAUnit);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
      for (const Vector3& corner : tree.corners(slot))
        lowest = std::min(lowest, height(other.world_from_shape * corner));
    }
    return by_gap(lowest, rounding_);
  }

  static Corners placed(const Affine3& frame, const Corners& corners) {
    return {frame * corners[0], frame * corners[1], frame * corners[2]};
  }

  /// Upper bound of the factor by which the map stretches lengths.
  static double most_stretch(const Affine3& map) { return map.linear().norm(); }

  Meeting of_ball(const Ball& ball, const Placed& other) const {
    const Solid& solid = other.shape.solid();
    const Affine3 shape_from_world = other.world_from_shape.inverse();
    const Vector3 middle = shape_from_world * ball.centre;
    if (solid.closed && solid.tree->encloses(middle)) return Meeting::Overlapping;
    double gap = std::numeric_limits<double>::infinity();
    const double reach = (ball.radius + rounding_) * most_stretch(shape_from_world);
    solid.tree->near(middle, middle, reach, [&](std::uint32_t slot) {
      const Corners corners = placed(other.world_from_shape, solid.tree->corners(slot));
      gap = std::min(gap, (geometry::nearest_point(corners, ball.centre) - ball.centre).norm() - ball.radius);
      return gap >= -rounding_ && may_go_on();
    });
    return by_gap(gap, rounding_);
  }

  /// Looks for the triangles of the shape that has fewer in the other shape.
  Meeting of_triangles() const {
    const bool other_has_fewer = other_.shape.solid().tree->size() < one_.shape.solid().tree->size();
    return other_has_fewer ? Pair(other_, one_, effort_).surfaces_and_insides() : surfaces_and_insides();
  }

  Meeting surfaces_and_insides() const {
    const Meeting surfaces = of_surfaces();
    if (surfaces == Meeting::Overlapping || holds_part(one_, other_) || holds_part(other_, one_))
      return Meeting::Overlapping;
    return surfaces;
  }

  bool may_go_on(std::uint64_t units = 1) const { return !effort_ || effort_->spend(units); }

  /// Tests every triangle of `one` near the other's box against the other's triangles around it.
  Meeting of_surfaces() const {
    const Solid& one = one_.shape.solid();
    const Solid& other = other_.shape.solid();
    const Affine3 one_from_world = one_.world_from_shape.inverse();
    const Affine3 other_from_world = other_.world_from_shape.inverse();
    Bounds common = one_.shape.bounds_.transformed(one_.world_from_shape)
                        .intersection(other_.shape.bounds_.transformed(other_.world_from_shape));
    common = Bounds(common.min() - Vector3::Constant(rounding_), common.max() + Vector3::Constant(rounding_));
    if (common.isEmpty()) return Meeting::Apart;
    const bool solids = one.closed && other.closed;
    Meeting result = Meeting::Apart;
    const Vector3 middle = one_from_world * Vector3(common.center());
    const double reach = 0.5 * common.diagonal().norm() * most_stretch(one_from_world);
    geometry::SegmentQuery query(middle, middle, reach);
    query.only_in(common.transformed(one_from_world));
    one.tree->near(query, [&](std::uint32_t slot) {
      const Corners corners = placed(one_.world_from_shape, one.tree->corners(slot));
      if (!box_around(corners).intersects(common)) return may_go_on();
      result = std::max(result, against(corners, other_from_world, other, solids));
      return result != Meeting::Overlapping && may_go_on();
    });
    return result;
  }

  Meeting against(const Corners& corners, const Affine3& other_from_world, const Solid& other,
                  bool solids) const {
    const bool mirrored = (one_.world_from_shape.linear().determinant() > 0.0) !=
                          (other_.world_from_shape.linear().determinant() > 0.0);
    const Corners there = placed(other_from_world, corners);
    const double slack = rounding_ * most_stretch(other_from_world);
    const Vector3 middle = (there[0] + there[1] + there[2]) / 3.0;
    double reach = 0.0;
    for (const Vector3& corner : there) reach = std::max(reach, (corner - middle).norm());
    // Long triangles, and flat ones, fill little of the ball around them.
    const Bounds box = box_around(there);
    geometry::SegmentQuery query(middle, middle, reach + slack);
    query.only_in({box.min() - Vector3::Constant(slack), box.max() + Vector3::Constant(slack)});
    Meeting result = Meeting::Apart;
    other.tree->near(query, [&](std::uint32_t slot) {
      Corners facing = placed(other_.world_from_shape, other.tree->corners(slot));
      if (mirrored) std::swap(facing[1], facing[2]);  // so that both have their fronts on the same side
      const TriangleMeeting found = world::meeting(corners, facing, rounding_);
      if (found == TriangleMeeting::Crossing || (found == TriangleMeeting::Flush && solids))
        result = Meeting::Overlapping;
      else if (found != TriangleMeeting::Apart)
        result = std::max(result, Meeting::Touching);
      return result != Meeting::Overlapping && may_go_on();
    });
    return result;
  }

  /// Does a connected part of `part` lie in `whole`? Asked when no surfaces cross: then one point of each
  /// part decides.
  bool holds_part(const Placed& whole, const Placed& part) const {
    const Solid& solid = whole.shape.solid();
    if (!solid.closed) return false;
    const Affine3 whole_from_world = whole.world_from_shape.inverse();
    const double slack = rounding_ * most_stretch(whole_from_world);
    for (const Vector3& probe : part.shape.solid().probes) {
      const Vector3 there = whole_from_world * (part.world_from_shape * probe);
      if (solid.tree->bounds().contains(there) && solid.tree->encloses(there) &&
          !solid.tree->nearest(there, slack))
        return true;
    }
    return false;
  }

  const Placed& one_;
  const Placed& other_;
  Effort* effort_;  // null: unlimited
  double extent_ = 0.0;
  double rounding_ = 0.0;
};

Meeting meeting(const CollisionShape::Placed& one, const CollisionShape::Placed& other, Effort* effort) {
  using Kind = CollisionShape::Kind;
  if (one.shape.kind_ == Kind::Nothing || other.shape.kind_ == Kind::Nothing) return Meeting::Apart;
  const bool enough = !effort || (effort->spend(one.shape.effort_to_make() + other.shape.effort_to_make()));
  if (!enough) return Meeting::Overlapping;
  const Meeting found = CollisionShape::Pair(one, other, effort).meeting();
  return effort && effort->is_spent() ? Meeting::Overlapping : found;
}

}  // namespace icome::world
