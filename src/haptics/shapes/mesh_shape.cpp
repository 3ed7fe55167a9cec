#include "haptics/shapes/mesh_shape.h"

#include <algorithm>
#include <utility>

namespace icome::haptics {
namespace {

using geometry::Corners;

// An element's feature number consists of a triangle's slot in the tree and the number of its part.
constexpr std::uint32_t kPartBits = 3;
constexpr std::uint32_t kFirstEdge = 1;
constexpr std::uint32_t kFirstCorner = 4;

/// Orders the ends of an edge alike for both triangles that share it, so that their rods are the same.
bool comes_first(const Vector3& a, const Vector3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

Bounds bounds_of(const Corners& corners) {
  const auto& [a, b, c] = corners;
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// May the triangle come within `radius` of the segment from `middle` - `half` to `middle` + `half`? It lies
/// behind the plane through its point nearest to the middle, at right angles to the way there.
bool comes_within(const Corners& corners, const Vector3& middle, const Vector3& half, double radius) {
  const Vector3 away = middle - geometry::nearest_point(corners, middle);
  const double distance = away.norm();
  return distance * (distance - radius) <= std::abs(away.dot(half));
}

/// Turns one triangle into elements.
class TriangleElements {
 public:
  /// `closed`: the triangle is part of a solid, around whose edges and corners the tip may come from wherever
  /// it is outside.
  TriangleElements(const Corners& corners, std::uint32_t slot, double tip, TouchableSides sides, bool closed)
      : corners_(corners),
        slot_(slot),
        tip_(tip),
        two_sided_(sides == TouchableSides::Both),
        closed_(closed) {
    normal_ = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (int i = 0; i < 3; ++i) inward_[i] = normal_.cross(corners[(i + 1) % 3] - corners[i]).normalized();
  }

  Element face() const {
    Element e = blank(Element::Kind::Triangle, 0);
    e.origin = corners_[0];
    e.axis = normal_;
    e.u = inward_[0];
    e.v = inward_[1];
    e.w = inward_[2];
    e.b = inward_[1].dot(corners_[1] - corners_[0]);
    return e;
  }

  Element edge(int i) const {
    Element e = blank(Element::Kind::Rod, kFirstEdge + std::uint32_t(i));
    const Vector3& from = corners_[i];
    const Vector3& to = corners_[(i + 1) % 3];
    const bool forward = comes_first(from, to);
    e.origin = forward ? from : to;
    const Vector3 along = (forward ? to : from) - e.origin;
    e.a = along.norm();
    e.axis = along / e.a;
    e.guarded = true;
    e.u = inward_[i];
    e.w = front();
    return e;
  }

  Element corner(int i) const {
    Element e = blank(Element::Kind::Ball, kFirstCorner + std::uint32_t(i));
    e.origin = corners_[i];
    e.guarded = true;
    e.u = (corners_[(i + 1) % 3] - corners_[i]).normalized();
    e.v = (corners_[(i + 2) % 3] - corners_[i]).normalized();
    e.w = front();
    return e;
  }

 private:
  Element blank(Element::Kind kind, std::uint32_t part) const {
    Element e;
    e.kind = kind;
    e.two_sided = two_sided_;
    e.feature = slot_ << kPartBits | part;
    e.radius = e.tip = tip_;
    return e;
  }

  /// Normal of the half-space that confines an edge or a corner to the front of an open sheet; else zero.
  Vector3 front() const { return closed_ ? Vector3(Vector3::Zero()) : normal_; }

  const Corners& corners_;
  std::uint32_t slot_;
  double tip_;
  bool two_sided_;
  bool closed_;
  Vector3 normal_;
  std::array<Vector3, 3> inward_;  // unit normals of the edges in the triangle's plane
};

}  // namespace

MeshShape::MeshShape(std::shared_ptr<const geometry::TriangleMesh> mesh, const MeshShapeSettings& settings)
    : mesh_(std::move(mesh)), tree_(*mesh_), settings_(settings) {
  prepare();
}

MeshShape::MeshShape(const MeshShape& other, std::shared_ptr<const geometry::TriangleMesh> mesh)
    : mesh_(std::move(mesh)), tree_(other.tree_, *mesh_), settings_(other.settings_) {
  prepare();
}

void MeshShape::prepare() {
  if (settings_.tip_radius > 0.0) {
    const std::vector<MeshFeatures> by_triangle = mesh_features(*mesh_);
    features_.resize(by_triangle.size());
    for (std::uint32_t slot = 0; slot < tree_.size(); ++slot)
      features_[slot] = by_triangle[tree_.triangle(slot)];
  }
  if (settings_.interpolate_normals) normals_ = geometry::vertex_normals(*mesh_);
}

void MeshShape::gather(const GatherRequest& request, ElementSink& sink) const {
  const double radius = request.reach + request.tip;
  const Vector3 middle = 0.5 * (request.a + request.b);
  const Vector3 half = 0.5 * (request.b - request.a);
  const Vector3 margin = Vector3::Constant(radius);
  const Bounds wanted(request.a.cwiseMin(request.b) - margin, request.a.cwiseMax(request.b) + margin);
  const bool round = request.tip > 0.0;
  const geometry::SegmentQuery query(request.a, request.b, radius, round);
  tree_.near(query, [&](std::uint32_t slot) {
    const Corners& corners = tree_.corners(slot);
    const Bounds bounds = bounds_of(corners);
    if (!bounds.intersects(wanted) || (round && !comes_within(corners, middle, half, radius))) return true;
    if (!sink.wants_whole()) return sink.defer(slot, bounds);
    sink.defer_whole();
    return false;
  });
}

std::size_t MeshShape::sweep(const Vector3& start, const Vector3& step, double distance,
                             PieceVisitor& visitor) const {
  std::size_t tested = 0;
  double share = 1.0;
  tree_.sweep(start, step, distance, [&](std::uint32_t slot) {
    ++tested;
    const Vector3 half = (0.5 * share) * step;
    if (comes_within(tree_.corners(slot), start + half, half, distance)) share = visitor.visit(slot);
    return share;
  });
  return tested;
}

/// The edges and corners that the triangle hands out, numbered as in MeshFeatures.
unsigned MeshShape::features(std::uint32_t slot, TouchableSides sides) const {
  if (features_.empty()) return ~0u;
  if (sides == TouchableSides::Both) return features_[slot].both;
  return settings_.closed ? features_[slot].front : ~0u;
}

void MeshShape::expand(std::uint32_t piece, double tip, TouchableSides sides, PieceElements& elements) const {
  const TriangleElements triangle(tree_.corners(piece), piece, tip, sides, settings_.closed);
  elements.add(triangle.face());
  if (tip <= 0.0) return;
  const unsigned handed_out = features(piece, sides);
  for (int i = 0; i < 3; ++i) {
    if (handed_out >> i & 1) elements.add(triangle.edge(i));
    if (handed_out >> (3 + i) & 1) elements.add(triangle.corner(i));
  }
}

std::optional<geometry::SurfacePoint> MeshShape::way_out(const Vector3& position, double /*time*/) const {
  if (!settings_.closed || !tree_.bounds().contains(position) || !tree_.encloses(position))
    return std::nullopt;
  const std::optional<geometry::MeshHit> hit = tree_.nearest(position);
  const Vector3 away = hit->point - position;
  const auto& triangle = *mesh_;
  const Vector3 face = (triangle.corner(hit->triangle, 1) - triangle.corner(hit->triangle, 0))
                           .cross(triangle.corner(hit->triangle, 2) - triangle.corner(hit->triangle, 0))
                           .normalized();
  // At a place on the surface, give or take rounding, the way to it has no sure direction.
  const double least = Tolerance::for_coordinates(position.cwiseAbs().maxCoeff()).gap;
  const double length = away.norm();
  return geometry::SurfacePoint{hit->point, length > least ? Vector3(away / length) : face};
}

std::optional<geometry::SurfacePoint> MeshShape::nearest(const Vector3& position, double limit,
                                                         TouchableSides sides) const {
  const std::optional<geometry::MeshHit> hit = tree_.nearest(position, limit);
  if (!hit) return std::nullopt;
  const auto corner = [&](int which) { return mesh_->corner(hit->triangle, which); };
  const Vector3 front = (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
  const Vector3 away = position - hit->point;
  if (sides == TouchableSides::Front && !settings_.closed && away.dot(front) < 0.0) return std::nullopt;
  return geometry::SurfacePoint{hit->point, hit->parameter > 0.0 ? Vector3(away / hit->parameter) : front};
}

std::optional<ShapeHit> MeshShape::cast(const Vector3& start, const Vector3& step, double /*time*/) const {
  const auto hit = tree_.first_hit(start, start + step);
  if (!hit) return std::nullopt;
  const auto corner = [&](int which) { return mesh_->corner(hit->triangle, which); };
  const Vector3 across = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  return ShapeHit{hit->parameter, hit->point, across.stableNormalized()};
}

Vector3 MeshShape::shading_normal(std::uint32_t feature, const Vector3& position,
                                  const Vector3& face_normal) const {
  if (normals_.empty() || (feature & ((1u << kPartBits) - 1)) != 0) return face_normal;
  const std::uint32_t slot = feature >> kPartBits;
  const auto& [a, b, c] = tree_.corners(slot);
  const Vector3 area = (b - a).cross(c - a);
  const double whole = area.squaredNorm();
  const double at_b = (position - a).cross(c - a).dot(area) / whole;
  const double at_c = (b - a).cross(position - a).dot(area) / whole;
  const auto& vertices = mesh_->triangles[tree_.triangle(slot)];
  const Vector3 blend = (1.0 - at_b - at_c) * normals_[vertices[0]] + at_b * normals_[vertices[1]] +
                        at_c * normals_[vertices[2]];
  // A sheet touched from behind has its faces, and so its normals, turned.
  const Vector3 turned = blend.dot(face_normal) < 0.0 ? Vector3(-blend) : blend;
  const double length = turned.norm();
  return length > 0.0 ? Vector3(turned / length) : face_normal;
}

std::size_t MeshShape::bytes() const {
  return tree_.bytes() + features_.capacity() * sizeof(MeshFeatures) + normals_.capacity() * sizeof(Vector3);
}

}  // namespace icome::haptics
