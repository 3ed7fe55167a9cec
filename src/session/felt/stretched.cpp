#include "session/felt/stretched.h"

#include <utility>

namespace icome::session {
namespace {

using base::Matrix3;
using base::Vector3;
using geometry::Primitive;

/// Primitives stretched by a diagonal map along each axis; most of them do not show that it mirrors.
class StretchedPrimitive {
 public:
  explicit StretchedPrimitive(const Matrix3& map)
      : along_(map.diagonal().cwiseAbs()),
        round_(along_.x() == along_.y()),
        even_(round_ && along_.y() == along_.z()),
        upside_down_(map(2, 2) < 0.0) {}

  using Answer = std::optional<Primitive>;
  Answer operator()(const geometry::Plane&) const { return std::nullopt; }
  Answer operator()(const geometry::Box& it) const {
    return geometry::Box{Vector3(along_.cwiseProduct(it.half))};
  }
  Answer operator()(const geometry::Sphere& it) const {
    if (!even_) return std::nullopt;
    return geometry::Sphere{along_.x() * it.radius};
  }
  Answer operator()(const geometry::Cylinder& it) const {
    if (!round_) return std::nullopt;
    return geometry::Cylinder{along_.x() * it.radius, along_.z() * it.height};
  }
  Answer operator()(const geometry::Cone& it) const {
    if (!round_) return std::nullopt;
    const double bottom = upside_down_ ? it.top_radius : it.bottom_radius;
    const double top = upside_down_ ? it.bottom_radius : it.top_radius;
    return geometry::Cone{along_.x() * bottom, along_.x() * top, along_.z() * it.height};
  }
  Answer operator()(const geometry::Torus& it) const {
    if (!even_) return std::nullopt;
    return geometry::Torus{along_.x() * it.major_radius, along_.x() * it.minor_radius};
  }
  Answer operator()(const geometry::Capsule& it) const {
    if (!even_) return std::nullopt;
    return geometry::Capsule{along_.x() * it.radius, along_.x() * it.height};
  }

 private:
  Vector3 along_;
  bool round_, even_, upside_down_;
};

}  // namespace

void stretch(geometry::TriangleMesh& mesh, const Matrix3& map) {
  for (Vector3& position : mesh.positions) position = map * position;
  if (map.determinant() > 0.0) return;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

std::optional<Primitive> stretched(const Primitive& primitive, const Matrix3& map) {
  if (map == Matrix3::Identity()) return primitive;
  if (Matrix3(map.diagonal().asDiagonal()) != map) return std::nullopt;
  return std::visit(StretchedPrimitive(map), primitive);
}

geometry::ControlMesh stretched(geometry::ControlMesh control, const Matrix3& map) {
  stretch(control.mesh, map);
  return control;
}

geometry::CsgTree stretched(geometry::CsgTree tree, const Matrix3& map) {
  if (tree.empty()) return tree;
  const geometry::CsgTree::Index root = tree.root();
  tree.set_transform(root, base::Affine3(map) * tree.node(root).parent_from_node);
  return tree;
}

}  // namespace icome::session
