#include "haptics/mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace icome::haptics {
namespace {

using geometry::Corners;

// A triangle's slot in the tree and which of its parts make an element's feature number.
constexpr std::uint32_t kPartBits = 3;
constexpr std::uint32_t kFirstEdge = 1;
constexpr std::uint32_t kFirstCorner = 4;

// Spreads of normals are kept in steps of 1/180 of the unit sphere's radius.
constexpr double kSpreadSteps = 180.0;
constexpr std::uint8_t kWide = 180;  // too wide to be worth telling apart

/// The same order for the two triangles that share an edge, so that their rods are the same.
bool comes_first(const Vector3& a, const Vector3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// Turns one triangle into elements.
class TriangleElements {
 public:
  TriangleElements(const Corners& corners, std::uint32_t slot, double tip, TouchableSides sides)
      : corners_(corners), slot_(slot), tip_(tip), two_sided_(sides == TouchableSides::Both) {
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
    e.w = normal_;
    return e;
  }

  Element corner(int i) const {
    Element e = blank(Element::Kind::Ball, kFirstCorner + std::uint32_t(i));
    e.origin = corners_[i];
    e.guarded = true;
    e.u = (corners_[(i + 1) % 3] - corners_[i]).normalized();
    e.v = (corners_[(i + 2) % 3] - corners_[i]).normalized();
    e.w = normal_;
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

  const Corners& corners_;
  std::uint32_t slot_;
  double tip_;
  bool two_sided_;
  Vector3 normal_;
  std::array<Vector3, 3> inward_;  // unit normals of the edges in the triangle's plane
};

}  // namespace

MeshShape::MeshShape(std::shared_ptr<const geometry::TriangleMesh> mesh, bool closed, Shading shading)
    : mesh_(std::move(mesh)), tree_(*mesh_), closed_(closed) {
  if (closed) measure_spread();
  if (shading == Shading::Interpolated) normals_ = geometry::vertex_normals(*mesh_);
}

// A chord of the unit sphere, from the triangle's normal to the farthest of its neighbours' normals,
// goes by way of the mean normal at the corner that they share.
void MeshShape::measure_spread() {
  const std::size_t count = mesh_->triangles.size();
  const auto face_normal = [&](std::size_t i) {
    const Vector3& a = mesh_->corner(i, 0);
    return Vector3((mesh_->corner(i, 1) - a).cross(mesh_->corner(i, 2) - a).normalized());
  };
  std::vector<Vector3> mean(mesh_->positions.size(), Vector3::Zero());
  std::vector<double> farthest(mesh_->positions.size(), 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint32_t vertex : mesh_->triangles[i]) mean[vertex] += face_normal(i);
  }
  for (Vector3& normal : mean) normal.normalize();
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint32_t vertex : mesh_->triangles[i]) {
      farthest[vertex] = std::max(farthest[vertex], (mean[vertex] - face_normal(i)).norm());
    }
  }
  spread_.resize(count);
  base::parallel_for(count, std::size_t{1} << 15, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      const std::uint32_t triangle = tree_.triangle(std::uint32_t(slot));
      double chord = 0.0;
      for (const std::uint32_t vertex : mesh_->triangles[triangle]) {
        chord = std::max(chord, farthest[vertex] + (mean[vertex] - face_normal(triangle)).norm());
      }
      spread_[slot] = std::uint8_t(std::min(double(kWide), std::ceil(chord * kSpreadSteps) + 1.0));
    }
  });
}

void MeshShape::gather(const GatherRequest& request, ElementSink& sink) const {
  const Vector3 margin = Vector3::Constant(request.reach);
  const Bounds wanted(request.a.cwiseMin(request.b) - margin, request.a.cwiseMax(request.b) + margin);
  tree_.near(request.a, request.b, request.reach + request.tip, [&](std::uint32_t slot) {
    const Bounds bounds = tip_bounds(slot, request);
    if (bounds.intersects(wanted)) sink.defer(slot, bounds);
  });
}

// Where the tip's centre can be while it rests on the triangle, its edges or its corners: the triangle
// moved out along its normal and, as the normals of edges and corners differ from it, a bit around.
Bounds MeshShape::tip_bounds(std::uint32_t slot, const GatherRequest& request) const {
  const Corners& corners = tree_.corners(slot);
  Bounds bounds(corners[0]);
  bounds.extend(corners[1]);
  bounds.extend(corners[2]);
  if (request.tip <= 0.0) return bounds;
  const bool narrow = !spread_.empty() && request.sides == TouchableSides::Front && spread_[slot] < kWide;
  const Vector3 out = narrow ? Vector3((corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized())
                             : Vector3::Zero();
  const Vector3 around = Vector3::Constant(request.tip * (narrow ? spread_[slot] / kSpreadSteps : 1.0));
  return {bounds.min() + request.tip * out - around, bounds.max() + request.tip * out + around};
}

void MeshShape::expand(std::uint32_t piece, double tip, TouchableSides sides, PieceElements& elements) const {
  const TriangleElements triangle(tree_.corners(piece), piece, tip, sides);
  elements.add(triangle.face());
  if (tip <= 0.0) return;
  for (int i = 0; i < 3; ++i) {
    elements.add(triangle.edge(i));
    elements.add(triangle.corner(i));
  }
}

std::optional<geometry::SurfacePoint> MeshShape::way_out(const Vector3& position) const {
  if (!closed_ || !tree_.bounds().contains(position) || !tree_.encloses(position)) return std::nullopt;
  const std::optional<geometry::MeshHit> hit = tree_.nearest(position);
  const Vector3 away = hit->point - position;
  const double length = away.norm();
  const auto& triangle = *mesh_;
  const Vector3 face = (triangle.corner(hit->triangle, 1) - triangle.corner(hit->triangle, 0))
                           .cross(triangle.corner(hit->triangle, 2) - triangle.corner(hit->triangle, 0))
                           .normalized();
  return geometry::SurfacePoint{hit->point, length > 0.0 ? Vector3(away / length) : face};
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

std::size_t MeshShape::bytes() const { return tree_.bytes() + spread_.capacity() + normals_.capacity() * sizeof(Vector3); }

}  // namespace icome::haptics
