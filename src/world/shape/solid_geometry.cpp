#include "world/shape/solid_geometry.h"

#include <utility>
#include <variant>

#include "world/hasher.h"

namespace icome::world {
namespace {

/// Adds the shape of a leaf to the hash.
struct AddShape {
  Hasher& hasher;

  void operator()(const geometry::Primitive& primitive) const {
    hasher.add(primitive.index());
    std::visit(*this, primitive);
  }
  void operator()(const geometry::Plane&) const {}
  void operator()(const geometry::Box& it) const { hasher.add(it.half); }
  void operator()(const geometry::Sphere& it) const { hasher.add(it.radius); }
  void operator()(const geometry::Cylinder& it) const {
    hasher.add(it.radius);
    hasher.add(it.height);
  }
  void operator()(const geometry::Cone& it) const {
    hasher.add(it.bottom_radius);
    hasher.add(it.top_radius);
    hasher.add(it.height);
  }
  void operator()(const geometry::Torus& it) const {
    hasher.add(it.major_radius);
    hasher.add(it.minor_radius);
  }
  void operator()(const geometry::Capsule& it) const {
    hasher.add(it.radius);
    hasher.add(it.height);
  }
  void operator()(const std::shared_ptr<const geometry::MeshSolid>& it) const {
    for (const Vector3& position : it->mesh.positions) hasher.add(position);
    for (const auto& triangle : it->mesh.triangles) {
      for (const std::uint32_t vertex : triangle) hasher.add(vertex);
    }
  }
  void operator()(const std::shared_ptr<const geometry::CsgPrimitive>& it) const {
    hasher.add(std::string_view(it->name()));
    hasher.add(it->bounds().min());
    hasher.add(it->bounds().max());
  }
};

std::size_t shape_bytes(const geometry::CsgShape& shape) {
  const auto* solid = std::get_if<std::shared_ptr<const geometry::MeshSolid>>(&shape);
  if (!solid) return 0;
  const geometry::TriangleMesh& mesh = (*solid)->mesh;
  return (*solid)->tree.bytes() + mesh.positions.capacity() * sizeof(Vector3) +
         mesh.triangles.capacity() * sizeof(geometry::TriangleMesh::Triangle);
}

}  // namespace

std::uint64_t PrimitiveGeometry::hash() const {
  Hasher hasher;
  hasher.add(kind());
  AddShape{hasher}(primitive);
  hasher.add(axis);
  return hasher.value();
}

base::Matrix3 PrimitiveGeometry::shape_from_primitive() const {
  if (axis == Axis::Z) return base::Matrix3::Identity();
  base::Matrix3 turn;  // exact: its x stays, y becomes -z and z becomes y
  turn << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
  return turn;
}

Bounds PrimitiveGeometry::bounds() const {
  const Bounds own = geometry::bounds(primitive);
  if (axis == Axis::Z) return own;
  // Corner by corner: a plane's bounds are infinite, and 0 times infinity would be no number.
  const Vector3 low = own.min(), high = own.max();
  return {Vector3(low.x(), low.z(), -high.y()), Vector3(high.x(), high.z(), -low.y())};
}

std::uint64_t CsgGeometry::hash() const {
  Hasher hasher;
  hasher.add(kind());
  hasher.add(tree.size());
  for (geometry::CsgTree::Index i = 0; i < tree.size(); ++i) {
    const geometry::CsgTree::Node& node = tree.node(i);
    hasher.add(node.is_leaf);
    hasher.add(node.op);
    hasher.add(node.left);
    hasher.add(node.right);
    hasher.add(node.parent_from_node.matrix());
    if (node.shape) {
      hasher.add(node.shape->index());
      std::visit(AddShape{hasher}, *node.shape);
    }
    if (!node.colour) continue;
    for (const float part : *node.colour) hasher.add(double(part));
  }
  if (!tree.empty()) hasher.add(tree.root());
  return hasher.value();
}

std::size_t CsgGeometry::bytes() const {
  std::size_t result = sizeof(*this) + tree.size() * sizeof(geometry::CsgTree::Node);
  for (geometry::CsgTree::Index i = 0; i < tree.size(); ++i) {
    if (tree.node(i).shape) result += shape_bytes(*tree.node(i).shape);
  }
  return result;
}

base::Result<std::shared_ptr<const ImplicitGeometry>> ImplicitGeometry::create(const std::string& formula,
                                                                               const Bounds& box) {
  auto surface = geometry::ImplicitSurface::create(formula, box);
  if (!surface) return tl::unexpected(surface.error());
  return std::shared_ptr<const ImplicitGeometry>(new ImplicitGeometry(formula, std::move(*surface)));
}

std::uint64_t ImplicitGeometry::hash() const {
  Hasher hasher;
  hasher.add(kind());
  hasher.add(std::string_view(formula_));
  hasher.add(surface_->box().min());
  hasher.add(surface_->box().max());
  return hasher.value();
}

}  // namespace icome::world
