#include "haptics/mesh_shape.h"

#include <algorithm>
#include <utility>

namespace icome::haptics {
namespace {

using geometry::Corners;

// A triangle's slot in the tree and which of its parts make an element's feature number.
constexpr std::uint32_t kPartBits = 3;
constexpr std::uint32_t kFirstEdge = 1;
constexpr std::uint32_t kFirstCorner = 4;

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

MeshShape::MeshShape(std::shared_ptr<const geometry::TriangleMesh> mesh, const MeshShapeSettings& settings)
    : mesh_(std::move(mesh)), tree_(*mesh_), settings_(settings) {
  prepare();
}

MeshShape::MeshShape(const MeshShape& other, std::shared_ptr<const geometry::TriangleMesh> mesh)
    : mesh_(std::move(mesh)), tree_(other.tree_, *mesh_), settings_(other.settings_) {
  prepare();
}

void MeshShape::prepare() {
  if (settings_.closed && settings_.tip_radius > 0.0) thicken();
  if (settings_.interpolate_normals) normals_ = geometry::vertex_normals(*mesh_);
}

// For a sphere tip on a smooth closed mesh: boxes around where the tip's centre can be, much smaller
// than boxes around the triangles grown by the tip on all sides.
void MeshShape::thicken() {
  const std::vector<Neighbourhood> by_triangle = neighbourhoods(*mesh_);
  neighbourhood_.resize(by_triangle.size());
  for (std::uint32_t slot = 0; slot < tree_.size(); ++slot)
    neighbourhood_[slot] = by_triangle[tree_.triangle(slot)];
  thick_ = tree_.boxes_around(
      [this](std::uint32_t slot) { return tip_bounds(slot, settings_.tip_radius, TouchableSides::Front); });
}

void MeshShape::gather(const GatherRequest& request, ElementSink& sink) const {
  const Vector3 margin = Vector3::Constant(request.reach);
  const Bounds wanted(request.a.cwiseMin(request.b) - margin, request.a.cwiseMax(request.b) + margin);
  const auto look = [&](std::uint32_t slot) {
    const Bounds bounds = tip_bounds(slot, request.tip, request.sides);
    return !bounds.intersects(wanted) || sink.defer(slot, bounds);
  };
  const bool prepared = thick_.leaf_count() > 0 && request.tip == settings_.tip_radius &&
                        request.sides == TouchableSides::Front;
  if (prepared) {
    tree_.near_in(thick_, request.a, request.b, request.reach, look);
  } else {
    tree_.near(request.a, request.b, request.reach + request.tip, look);
  }
}

/// Do all normals around the triangle point much the same way, and is the free side known?
bool MeshShape::narrow(std::uint32_t slot, TouchableSides sides) const {
  return !neighbourhood_.empty() && sides == TouchableSides::Front && neighbourhood_[slot].spread < kWide;
}

// Where the tip's centre can be while it rests on the triangle, its edges or its corners: the triangle
// moved out along its normal and, as the normals of edges and corners differ from it, a bit around.
Bounds MeshShape::tip_bounds(std::uint32_t slot, double tip, TouchableSides sides) const {
  const Corners& corners = tree_.corners(slot);
  const Bounds triangle(corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
                        corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]));
  if (tip <= 0.0) return triangle;
  const bool tight = narrow(slot, sides);
  const Vector3 margin = Vector3::Constant(tight ? tip * neighbourhood_[slot].spread / kSpreadSteps : tip);
  const Vector3 out =
      tight ? Vector3(tip * (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized())
            : Vector3::Zero();
  return {triangle.min() + out - margin, triangle.max() + out + margin};
}

void MeshShape::expand(std::uint32_t piece, double tip, TouchableSides sides, PieceElements& elements) const {
  const TriangleElements triangle(tree_.corners(piece), piece, tip, sides);
  elements.add(triangle.face());
  if (tip <= 0.0) return;
  const unsigned owned = narrow(piece, sides) ? neighbourhood_[piece].owned : ~0u;
  for (int i = 0; i < 3; ++i) {
    if (owned >> i & 1) elements.add(triangle.edge(i));
    if (owned >> (3 + i) & 1) elements.add(triangle.corner(i));
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
  // From a place on the surface, give or take rounding, the way to it says nothing.
  const double least = Tolerance::for_coordinates(position.cwiseAbs().maxCoeff()).gap;
  const double length = away.norm();
  return geometry::SurfacePoint{hit->point, length > least ? Vector3(away / length) : face};
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
  return tree_.bytes() + thick_.bytes() + neighbourhood_.capacity() * sizeof(Neighbourhood) +
         normals_.capacity() * sizeof(Vector3);
}

}  // namespace icome::haptics
