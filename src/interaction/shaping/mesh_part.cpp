#include "interaction/shaping/mesh_part.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh/mesh_check.h"
#include "interaction/operations/shapes/shape_change.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/visit_geometry.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using geometry::Corners;
using geometry::TriangleMesh;

/// Distance behind a surface, in radii, within which things count as on it: surfaces are seen askew.
constexpr double kBehind = 4.0;
/// A probe that meets more triangles is too coarse to tell them apart.
constexpr std::size_t kMostMet = 1U << 18U;

struct SegmentPoints {
  Vector3 one, other;
  double t;  // of the first segment, in [0, 1]
};

double clamped_share(double t) { return std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.0; }

/// The points of two segments that are nearest to each other (Ericson, Real-Time Collision Detection, 5.1.9).
SegmentPoints nearest_points(const Vector3& p, const Vector3& p_way, const Vector3& q, const Vector3& q_way) {
  const Vector3 between = p - q;
  const double a = p_way.squaredNorm(), e = q_way.squaredNorm();
  const double b = p_way.dot(q_way), c = p_way.dot(between), f = q_way.dot(between);
  const double across = a * e - b * b;
  double s = across > 1e-14 * a * e ? clamped_share((b * f - c * e) / across) : 0.0;
  double t = e > 0.0 ? (b * s + f) / e : 0.0;
  if (!(t >= 0.0 && t <= 1.0)) {
    t = clamped_share(t);
    s = a > 0.0 ? clamped_share((b * t - c) / a) : 0.0;
  } else if (across <= 1e-14 * a * e && a > 0.0) {
    s = clamped_share((b * t - c) / a);
  }
  return {p + s * p_way, q + t * q_way, s};
}

/// Share of the segment at which it crosses the triangle; nothing where it does not.
std::optional<double> crossing_share(const Vector3& start, const Vector3& way, const Corners& corners) {
  const Vector3 one = corners[1] - corners[0], other = corners[2] - corners[0];
  const Vector3 across = way.cross(other);
  const double volume = one.dot(across);
  if (volume == 0.0) return std::nullopt;
  const Vector3 from = start - corners[0];
  const double u = from.dot(across) / volume;
  const Vector3 up = from.cross(one);
  const double v = way.dot(up) / volume, t = other.dot(up) / volume;
  const bool met = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= 1.0;
  return met ? std::optional(t) : std::nullopt;
}

std::optional<PartMeeting> meeting_at(const PartProbe& probe, double distance, double t) {
  const double radius = probe.radius_at(t);
  if (!(distance <= radius) || !(radius > 0.0)) return std::nullopt;
  const double behind = std::max(0.0, t - probe.surface) / kBehind;
  const PartMeeting met{(distance + behind) / radius, t};
  return met.cost <= 1.0 ? std::optional(met) : std::nullopt;
}

/// A probe that ends behind everything it looks at, and the best part found so far.
class PartSearch {
 public:
  PartSearch(PartKind kind, const PartProbe& probe, double reach)
      : kind_(kind), probe_(probe), way_(reach * probe.along), reach_(reach) {}

  void look_at(const TriangleMesh::Triangle& triangle, const Corners& corners) {
    switch (kind_) {
      case PartKind::Vertex:
        for (int i = 0; i < 3; ++i) offer({triangle[i]}, corners[i], meet(probe_, corners[i]));
        break;
      case PartKind::Edge:
        for (int i = 0; i < 3; ++i) look_at_edge(triangle, corners, i);
        break;
      case PartKind::Face:
        look_at_face(triangle, corners);
        break;
    }
  }
  std::optional<MeshPart> take() { return std::move(best_); }

 private:
  struct Met {
    Vector3 place;
    std::optional<PartMeeting> meeting;
  };

  Met meet_edge(const Vector3& from, const Vector3& to) const {
    const SegmentPoints nearest = nearest_points(probe_.from, way_, from, to - from);
    return {nearest.other, meeting_at(probe_, (nearest.one - nearest.other).norm(), nearest.t * reach_)};
  }
  void look_at_edge(const TriangleMesh::Triangle& triangle, const Corners& corners, int i) {
    const int next = (i + 1) % 3;
    const Met met = meet_edge(corners[i], corners[next]);
    offer({std::min(triangle[i], triangle[next]), std::max(triangle[i], triangle[next])}, met.place,
          met.meeting);
  }
  void look_at_face(const TriangleMesh::Triangle& triangle, const Corners& corners) {
    const std::vector<std::uint32_t> all(triangle.begin(), triangle.end());
    if (way_.isZero(0.0)) {
      const Vector3 nearest = geometry::nearest_point(corners, probe_.from);
      return offer(all, nearest, meeting_at(probe_, (nearest - probe_.from).norm(), 0.0));
    }
    if (const auto t = crossing_share(probe_.from, way_, corners))
      return offer(all, probe_.from + *t * way_, meeting_at(probe_, 0.0, *t * reach_));
    for (int i = 0; i < 3; ++i) {
      const Met met = meet_edge(corners[i], corners[(i + 1) % 3]);
      offer(all, met.place, met.meeting);
    }
  }
  void offer(std::vector<std::uint32_t> vertices, const Vector3& place,
             const std::optional<PartMeeting>& met) {
    if (!met || (best_ && !(*met < best_->meeting))) return;
    best_ = MeshPart{kind_, std::move(vertices), place, *met};
  }

  PartKind kind_;
  PartProbe probe_;
  Vector3 way_;
  double reach_;
  std::optional<MeshPart> best_ = {};
};

/// Distance along the line up to which anything in the box may be found, m.
double reach_to(const PartProbe& probe, const base::Bounds& box) {
  double reach = 0.0;
  for (int corner = 0; corner < 8; ++corner)
    reach = std::max(
        reach, (box.corner(static_cast<base::Bounds::CornerType>(corner)) - probe.from).dot(probe.along));
  const double behind = probe.surface + kBehind * probe.radius_at(probe.surface);
  return std::isfinite(behind) ? std::min(reach, behind) : reach;
}

Result<void> check_parts(const world::Geometry& shape) {
  const TriangleMesh* mesh = draggable_mesh(shape);
  if (!mesh)
    return fail(
        fmt::format("A shape of the kind \"{}\" has no vertices to take hold of: make a mesh of it first.",
                    shape.kind()));
  if (mesh->triangles.empty()) return fail("There is nothing to take hold of: the shape has no triangles.");
  return geometry::check_mesh(*mesh);
}

}  // namespace

bool PartProbe::is_usable() const {
  return from.allFinite() && along.allFinite() && std::isfinite(radius) && std::isfinite(spread) &&
         radius >= 0.0 && spread >= 0.0 && surface >= 0.0;
}

PartProbe probe_along(const Ray& ray, double spread, double surface) {
  return {ray.origin, ray.direction.stableNormalized(), 0.0, spread, surface};
}

PartProbe probe_round(const Vector3& tip, double radius) {
  return {.from = tip, .along = Vector3::Zero(), .radius = radius};
}

std::optional<PartMeeting> meet(const PartProbe& probe, const Vector3& point) {
  const double t = std::max(0.0, (point - probe.from).dot(probe.along));
  return meeting_at(probe, (point - probe.from - t * probe.along).norm(), t);
}

const TriangleMesh* draggable_mesh(const world::Geometry& shape) {
  using Mesh = const TriangleMesh*;
  return world::visit_geometry(
      shape, [](const world::MeshGeometry& it) -> Mesh { return &it.mesh; },
      [](const world::LoopGeometry& it) -> Mesh { return &it.control.mesh; },
      [](const world::Geometry&) -> Mesh { return nullptr; });
}

Result<world::GeometryPointer> draggable_shape(const world::World& world, world::ObjectId id) {
  const world::PhysicalObject* object = world.find(id);
  if (!object) return fail("What was to be shaped is not there any more.");
  const world::GeometryObject* geometry = world.find(object->geometry);
  if (!geometry)
    return fail(fmt::format("'{}' has no shape of its own, it only holds others together: take one of those.",
                            object->name));
  if (!draggable_mesh(*geometry->shape))
    return fail(
        fmt::format("'{}' is {} and has no vertices to drag: make a mesh of it first (Make Mesh in "
                    "the Model menu).",
                    object->name, kind_in_words(*geometry->shape)));
  return geometry->shape;
}

PartFinder::PartFinder(world::GeometryPointer shape)
    : shape_(std::move(shape)), mesh_(draggable_mesh(*shape_)), tree_(*mesh_) {}

Result<PartFinder> PartFinder::create(world::GeometryPointer shape) {
  if (const auto good = check_parts(*shape); !good) return tl::unexpected(good.error());
  return PartFinder(std::move(shape));
}

Result<void> PartFinder::follow(const world::GeometryPointer& shape) {
  if (shape == shape_) return {};
  if (const auto good = check_parts(*shape); !good) return good;
  const TriangleMesh* mesh = draggable_mesh(*shape);
  if (mesh->triangles == mesh_->triangles) {
    tree_.refit(*mesh);
  } else {
    tree_ = geometry::TriangleTree(*mesh);
  }
  shape_ = shape;
  mesh_ = mesh;
  return {};
}

std::optional<MeshPart> PartFinder::find(PartKind kind, const Affine3& world_from_shape,
                                         const PartProbe& probe) const {
  const Affine3 shape_from_world = world_from_shape.inverse();
  if (!probe.is_usable() || !world_from_shape.matrix().allFinite() || !shape_from_world.matrix().allFinite())
    return std::nullopt;
  const double reach = reach_to(probe, tree_.bounds().transformed(world_from_shape));
  PartSearch search(kind, probe, reach);
  const double radius = probe.radius_at(reach) * shape_from_world.linear().norm();
  std::size_t met = 0;
  tree_.near(shape_from_world * probe.from, shape_from_world * (probe.from + reach * probe.along), radius,
             [&](std::uint32_t slot) {
               Corners corners = tree_.corners(slot);
               for (Vector3& corner : corners) corner = world_from_shape * corner;
               search.look_at(mesh_->triangles[tree_.triangle(slot)], corners);
               return ++met < kMostMet;
             });
  return search.take();
}

std::vector<std::uint32_t> PartFinder::vertices_near(const Affine3& world_from_shape, const Vector3& place,
                                                     double radius, std::size_t most) const {
  const Affine3 shape_from_world = world_from_shape.inverse();
  if (!shape_from_world.matrix().allFinite() || !place.allFinite() || !(radius >= 0.0)) return {};
  const Vector3 there = shape_from_world * place;
  std::vector<std::pair<double, std::uint32_t>> found;
  std::size_t met = 0;
  tree_.near(there, there, radius * shape_from_world.linear().norm(), [&](std::uint32_t slot) {
    for (const std::uint32_t vertex : mesh_->triangles[tree_.triangle(slot)]) {
      const double distance = (world_from_shape * mesh_->positions[vertex] - place).norm();
      if (distance <= radius) found.emplace_back(distance, vertex);
    }
    return ++met < kMostMet;
  });
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<std::uint32_t> vertices;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i) vertices.push_back(found[i].second);
  return vertices;
}

}  // namespace icome::interaction
