#include "interaction/snapping/snap_shape.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/mesh/mesh_repair.h"
#include "geometry/tree/hilbert.h"
#include "world/shape/exact_surface.h"
#include "world/shape/geometry_check.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {
namespace {

using geometry::Corners;
using geometry::TriangleMesh;
using Place = SnapShape::Place;

constexpr double kMostCoordinate = 1e70;  // what repairing a mesh can take

/// The factor by which a map stretches all directions alike; nothing if it does not.
std::optional<double> alike_stretch(const Affine3& map) {
  const base::Matrix3 metric = map.linear().transpose() * map.linear();
  const double square = metric.trace() / 3.0;
  if ((metric - square * base::Matrix3::Identity()).cwiseAbs().maxCoeff() > 1e-12 * square)
    return std::nullopt;
  return std::sqrt(square);
}

/// A bound of the factor by which the map shrinks lengths.
double most_shrink(const Affine3& map) {
  if (const auto stretch = alike_stretch(map)) return (1.0 + 1e-11) / *stretch;
  return map.linear().inverse().norm();
}

Vector3 nearest_on(const Vector3& from, const Vector3& to, const Vector3& point) {
  const Vector3 along = to - from;
  const double square = along.squaredNorm();
  if (!(square > 0.0)) return from;
  return from + std::clamp((point - from).dot(along) / square, 0.0, 1.0) * along;
}

Vector3 out_of(const Affine3& frame, const Vector3& normal) {
  return (frame.linear().inverse().transpose() * normal).normalized();
}

/// The angle at which an ellipse (as in SnapShape::Rim) is nearest to the point: the best of many, refined
/// by halving the step around it.
double nearest_angle(const Vector3& centre, const Vector3& one, const Vector3& other, const Vector3& point) {
  constexpr int kTries = 64;
  const auto square = [&](double angle) {
    return (centre + std::cos(angle) * one + std::sin(angle) * other - point).squaredNorm();
  };
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  double step = 2.0 * std::numbers::pi / kTries;
  for (int i = 0; i < kTries; ++i) {
    if (square(i * step) < least) least = square(best = i * step);
  }
  // In a smooth valley the derivative tells more than the height does.
  const auto slope = [&](double angle) {
    const Vector3 there = centre + std::cos(angle) * one + std::sin(angle) * other;
    return (there - point).dot(std::cos(angle) * other - std::sin(angle) * one);
  };
  double low = best - step, high = best + step;
  for (int i = 0; i < 60; ++i) {
    const double half = 0.5 * (low + high);
    (slope(half) > 0.0 ? high : low) = half;
  }
  const double found = 0.5 * (low + high);
  return square(found) <= least ? found : best;
}

/// The nearest of the things in a tree: `place(number)` gives the nearest place of one.
template <typename PlaceOf>
std::optional<Place> nearest_of(const PlaceTree& tree, const Affine3& world_from_shape, const Vector3& point,
                                double reach, const PlaceOf& place) {
  const double shrink = most_shrink(world_from_shape);
  if (!std::isfinite(shrink)) return std::nullopt;
  std::optional<Place> best;
  // The first of equally near ones wins: the order in the tree must not matter.
  std::uint32_t number_of_best = 0;
  const double rounding = 1.0 + 1e-9;
  tree.nearest(world_from_shape.inverse() * point, reach * shrink * rounding, [&](std::uint32_t number) {
    const Place found = place(number);
    const double distance = (found.point - point).norm();
    if (distance < reach || (distance == reach && (!best || number < number_of_best))) {
      best = found;
      reach = distance;
      number_of_best = number;
    }
    return std::max(reach * shrink * rounding, std::numeric_limits<double>::min());
  });
  return best;
}

/// The surface of a primitive that is placed, and maybe stretched unevenly.
class PlacedSurface {
 public:
  PlacedSurface(const geometry::Primitive& primitive, const Affine3& world_from_it)
      : primitive_(primitive), world_from_it_(world_from_it), it_from_world_(world_from_it.inverse()) {}

  /// A place of it next to `point`: the nearest in the primitive's own frame.
  geometry::SurfacePoint near(const Vector3& point) const {
    const Vector3 own = it_from_world_ * point;
    const geometry::SurfacePoint found = geometry::inside(primitive_, own)
                                             ? scp_from_inside(primitive_, own)
                                             : scp_from_outside(primitive_, own);
    return {world_from_it_ * found.point, out_of(world_from_it_, found.normal)};
  }

  /// The nearest place, downhill from the one next to `start`: by Newton's method along the surface, whose
  /// curvature is measured a little beside the place.
  geometry::SurfacePoint nearest(const Vector3& point, const Vector3& start) const {
    geometry::SurfacePoint best = near(start);
    for (int i = 0; i < kMostSteps; ++i) {
      const Vector3 off = point - best.point;
      const Vector3 along = off - off.dot(best.normal) * best.normal;
      if (along.norm() <= 1e-14 * off.norm()) break;
      if (!go_on(point, newton_step(best, off, along), best) && !go_on(point, along, best)) break;
    }
    return best;
  }

 private:
  static constexpr int kMostSteps = 50;

  /// Half of the squared distance rises along the surface with the curvature 1 + height * bend.
  Vector3 newton_step(const geometry::SurfacePoint& at, const Vector3& off, const Vector3& along) const {
    const Vector3 one = along.normalized();
    const Vector3 other = at.normal.cross(one);
    const double beside = 1e-6 * (world_from_it_.linear().norm() + off.norm());
    const auto bend = [&](const Vector3& direction) {
      const geometry::SurfacePoint there = near(at.point + beside * direction);
      const Vector3 turned = (there.normal - at.normal) / beside;
      return base::Vector2(one.dot(turned), other.dot(turned));
    };
    Eigen::Matrix2d rise;
    rise << bend(one), bend(other);
    rise = Eigen::Matrix2d::Identity() + off.dot(at.normal) * 0.5 * (rise + rise.transpose()).eval();
    if (!(rise.determinant() > 0.0 && rise.trace() > 0.0)) return along;
    const base::Vector2 step = rise.inverse() * base::Vector2(along.norm(), 0.0);
    return step.x() * one + step.y() * other;
  }

  /// Goes as much of the step as leads nearer; false where none does.
  bool go_on(const Vector3& point, const Vector3& step, geometry::SurfacePoint& best) const {
    if (!step.allFinite()) return false;
    for (double share = 1.0; share > 1e-6; share *= 0.5) {
      const geometry::SurfacePoint next = near(best.point + share * step);
      if (!((next.point - point).squaredNorm() < (best.point - point).squaredNorm())) continue;
      best = next;
      return true;
    }
    return false;
  }

  const geometry::Primitive& primitive_;
  Affine3 world_from_it_, it_from_world_;
};

std::optional<Place> nearest_triangle(const Affine3& world_from_shape, const Vector3& point, double reach,
                                      const geometry::TriangleTree& tree) {
  const double shrink = most_shrink(world_from_shape);
  const Vector3 own = world_from_shape.inverse() * point;
  const auto hit = tree.nearest(own, reach * shrink);
  if (!hit) return std::nullopt;
  // In stretched space another may be nearer; all that are as near as the nearest are among those visited.
  constexpr double kAbove = 1.0 + 1e-9;
  const double limit = std::min(reach, (world_from_shape * hit->point - point).norm()) * kAbove;
  std::optional<std::uint32_t> best;
  Place place;
  double least = std::numeric_limits<double>::infinity();
  tree.near(own, own, limit * shrink * kAbove, [&](std::uint32_t slot) {
    const Corners& corners = tree.corners(slot);
    const Corners placed = {world_from_shape * corners[0], world_from_shape * corners[1],
                            world_from_shape * corners[2]};
    const Vector3 there = geometry::nearest_point(placed, point);
    const double distance = (there - point).norm();
    if (distance < least || (distance == least && tree.triangle(slot) < tree.triangle(*best))) {
      const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      place = {there, out_of(world_from_shape, normal)};
      least = distance;
      best = slot;
    }
    return true;
  });
  if (!best || !(least <= reach)) return std::nullopt;
  return place;
}

/// The place of the surface that triangles stand for, next to the nearest triangle: across it, or, where
/// they end beyond it, on the line from the point; the nearest where space is not stretched unevenly.
Place on_surface(const Affine3& world_from_shape, const Vector3& point, const Place& near, double deviation,
                 const geometry::SmoothSurface& surface) {
  const Affine3 shape_from_world = world_from_shape.inverse();
  const auto into = [&](const Vector3& way) {
    return world::way_into(surface, shape_from_world * Vector3(near.point - way),
                           shape_from_world * Vector3(near.point + way));
  };
  auto found = into(-2.0 * deviation * near.direction);
  if (!found) found = into(4.0 * deviation * (near.point - point).stableNormalized());
  if (!found) return near;
  geometry::SurfacePlace best = found->place;
  const auto off = [&](const geometry::SurfacePlace& it) {
    return (world_from_shape * it.point - point).norm();
  };
  const Vector3 own = shape_from_world * point;
  const geometry::SurfacePlace foot = surface.nearest_local(best, own, 0.0);
  const double slack = 1e-11 * surface.bounds().diagonal().norm();
  if (foot.point.allFinite() && off(foot) < off(best) && surface.covers(foot, own, 0.0, slack)) best = foot;
  return {world_from_shape * best.point, out_of(world_from_shape, best.normal)};
}

/// The straight edges and the corners of a mesh to snap to.
struct MeshEdges {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<bool> corner;  // by vertex
};

MeshEdges sharp_edges(const TriangleMesh& mesh, double sharp_angle) {
  MeshEdges result;
  result.corner.resize(mesh.positions.size(), false);
  const geometry::EdgeNeighbours neighbours = edge_neighbours(mesh);
  std::vector<Vector3> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t)
    normals[t] =
        (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).normalized();
  for (std::uint32_t t = 0; t < normals.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t other = neighbours[t][i];
      if (other != geometry::kNoTriangle) {
        if (other < t) continue;  // seen from there
        const double bend =
            std::atan2(normals[t].cross(normals[other]).norm(), normals[t].dot(normals[other]));
        if (bend < sharp_angle) continue;
      }
      const std::array edge = {mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]};
      result.edges.push_back(edge);
      result.corner[edge[0]] = result.corner[edge[1]] = true;
    }
  }
  return result;
}

}  // namespace

PlaceTree::PlaceTree(const std::vector<Bounds>& boxes) {
  std::vector<Eigen::Vector3f> middles;
  if (boxes.empty()) return;
  middles.reserve(boxes.size());
  for (const Bounds& box : boxes) middles.emplace_back(box.center().cast<float>());
  order_ = geometry::hilbert_order(middles);
  std::vector<geometry::FloatBox> leaves;
  leaves.reserve(boxes.size());
  for (const std::uint32_t number : order_) leaves.push_back(geometry::float_box(boxes[number]));
  boxes_ = geometry::BoxTree(leaves);
}

SnapShape::SnapShape(world::GeometryPointer shape, double sharp_angle) : shape_(std::move(shape)) {
  take_primitive();
  take_mesh(sharp_angle);
  std::vector<Bounds> boxes;
  for (const Vector3& it : corners_) boxes.emplace_back(it);
  corner_tree_ = PlaceTree(boxes);
  boxes.clear();
  for (const Edge& it : edges_) boxes.emplace_back(Vector3(0.5 * (it.from + it.to)));
  middle_tree_ = PlaceTree(boxes);
  boxes.clear();
  for (const Edge& it : edges_) boxes.push_back(Bounds(it.from).extend(it.to));
  edge_tree_ = PlaceTree(boxes);
}

void SnapShape::take_primitive() {
  const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(shape_.get());
  if (!primitive) return;
  if (const auto* box = std::get_if<geometry::Box>(&primitive->primitive)) add_box(box->half);
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&primitive->primitive)) {
    add_rim(cylinder->radius, -0.5 * cylinder->height);
    add_rim(cylinder->radius, 0.5 * cylinder->height);
  }
  if (const auto* cone = std::get_if<geometry::Cone>(&primitive->primitive)) {
    add_rim(cone->bottom_radius, -0.5 * cone->height);
    add_rim(cone->top_radius, 0.5 * cone->height);
  }
  const base::Matrix3 turn = primitive->shape_from_primitive();
  for (Vector3& it : corners_) it = turn * it;
  for (Edge& it : edges_) it = {turn * it.from, turn * it.to};
  for (Rim& it : rims_) it = {turn * it.centre, turn * it.one, turn * it.other};
}

void SnapShape::add_box(const Vector3& half) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto sign = [&](unsigned axis) { return ((corner >> axis) & 1U) != 0 ? 1.0 : -1.0; };
    corners_.emplace_back(sign(0) * half.x(), sign(1) * half.y(), sign(2) * half.z());
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (((corner >> axis) & 1U) == 0) edges_.push_back({corners_[corner], corners_[corner | (1U << axis)]});
    }
  }
}

/// Adds a rim; one without a radius, the tip of a cone, is a corner.
void SnapShape::add_rim(double radius, double height) {
  if (radius > 0.0)
    rims_.push_back({{0.0, 0.0, height}, radius * Vector3::UnitX(), radius * Vector3::UnitY()});
  else
    corners_.emplace_back(0.0, 0.0, height);
}

void SnapShape::take_mesh(double sharp_angle) {
  const auto* geometry = dynamic_cast<const world::MeshGeometry*>(shape_.get());
  if (!geometry || !world::complaint(geometry->mesh).empty()) return;
  const Bounds box = geometry->bounds();
  if (box.isEmpty() || !(box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() < kMostCoordinate))
    return;
  TriangleMesh mesh = geometry->mesh;
  geometry::repair(mesh);  // corners that are only written twice are one
  const MeshEdges sharp = sharp_edges(mesh, sharp_angle);
  for (const auto& [from, to] : sharp.edges) edges_.push_back({mesh.positions[from], mesh.positions[to]});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (sharp.corner[v]) corners_.push_back(mesh.positions[v]);
  }
}

std::optional<Place> SnapShape::corner(const Affine3& world_from_shape, const Vector3& point,
                                       double reach) const {
  return nearest_of(corner_tree_, world_from_shape, point, reach,
                    [&](std::uint32_t number) { return Place{world_from_shape * corners_[number]}; });
}

std::optional<Place> SnapShape::middle(const Affine3& world_from_shape, const Vector3& point,
                                       double reach) const {
  return nearest_of(middle_tree_, world_from_shape, point, reach, [&](std::uint32_t number) {
    const Vector3 from = world_from_shape * edges_[number].from, to = world_from_shape * edges_[number].to;
    return Place{0.5 * (from + to), (to - from).normalized(), from, to};
  });
}

std::optional<Place> SnapShape::edge(const Affine3& world_from_shape, const Vector3& point,
                                     double reach) const {
  auto best = nearest_of(edge_tree_, world_from_shape, point, reach, [&](std::uint32_t number) {
    const Vector3 from = world_from_shape * edges_[number].from, to = world_from_shape * edges_[number].to;
    return Place{nearest_on(from, to, point), (to - from).normalized(), from, to};
  });
  for (const Rim& it : rims_) {
    const Vector3 centre = world_from_shape * it.centre;
    const Vector3 one = world_from_shape.linear() * it.one, other = world_from_shape.linear() * it.other;
    const double angle = nearest_angle(centre, one, other, point);
    const Vector3 there = centre + std::cos(angle) * one + std::sin(angle) * other;
    const double distance = (there - point).norm();
    if (distance > reach || (best && distance >= (best->point - point).norm())) continue;
    const Vector3 along = std::cos(angle) * other - std::sin(angle) * one;
    best =
        Place{there, along.normalized(), there - std::numbers::pi * along, there + std::numbers::pi * along};
  }
  return best;
}

std::optional<Place> SnapShape::face(const Affine3& world_from_shape, const Vector3& point, double reach,
                                     world::CollisionShape& triangles) const {
  if (const auto space = triangles.half_space(world_from_shape)) {
    const double height = space->normal.dot(point - space->foot);
    if (!(std::abs(height) <= reach)) return std::nullopt;
    return Place{point - height * space->normal, space->normal};
  }
  const double shrink = most_shrink(world_from_shape);
  if (triangles.nothing() || !std::isfinite(shrink)) return std::nullopt;
  const Affine3 shape_from_world = world_from_shape.inverse();
  if (triangles.bounds().exteriorDistance(shape_from_world * point) > reach * shrink) return std::nullopt;
  const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(shape_.get());
  if (primitive && !std::holds_alternative<geometry::Box>(primitive->primitive)) {
    Affine3 world_from_primitive = world_from_shape;
    world_from_primitive.linear() *= primitive->shape_from_primitive();
    const PlacedSurface surface(primitive->primitive, world_from_primitive);
    auto found = surface.nearest(point, point);
    // In stretched space the nearest place may be on another face: the triangles know on which.
    std::optional<Place> hint;
    if (!alike_stretch(world_from_shape))
      hint = nearest_triangle(world_from_shape, point, std::numeric_limits<double>::infinity(),
                              triangles.triangle_tree());
    if (hint) {
      const auto other = surface.nearest(point, hint->point);
      if ((other.point - point).norm() < (found.point - point).norm()) found = other;
    }
    const double distance = (found.point - point).norm();
    // A rim has no single normal that could lead there.
    const auto rim = edge(world_from_shape, point, std::min(reach, (1.0 - 1e-9) * distance));
    if (rim) return Place{rim->point, (point - rim->point).normalized()};
    if (!(distance <= reach)) return std::nullopt;
    return Place{found.point, found.normal};
  }
  const double deviation = triangles.deviation(world_from_shape);
  const auto near = nearest_triangle(world_from_shape, point, reach + deviation, triangles.triangle_tree());
  if (!near || !triangles.surface()) return near;
  const Place found = on_surface(world_from_shape, point, *near, deviation, *triangles.surface());
  return (found.point - point).norm() <= reach ? std::optional(found) : std::nullopt;
}

}  // namespace icome::interaction
