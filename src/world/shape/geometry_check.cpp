#include "world/shape/geometry_check.h"

#include <algorithm>
#include <cmath>

namespace icome::world {
namespace {

using geometry::CsgTree;

constexpr const char* kNotFinite =
    "A shape's vertices, normals, colours and texture coordinates must be finite.";

template <typename Vector>
bool finite(const Vector& it) {
  return it.allFinite();
}
bool finite(const Colour& it) {
  return std::all_of(it.begin(), it.end(), [](float part) { return std::isfinite(part); });
}

template <typename Corners>
bool all_finite(const std::vector<Corners>& triangles) {
  return std::all_of(triangles.begin(), triangles.end(), [](const Corners& corners) {
    return std::all_of(corners.begin(), corners.end(), [](const auto& it) { return finite(it); });
  });
}

template <typename Element>
bool all_below(const std::vector<Element>& elements, std::size_t vertices) {
  return std::all_of(elements.begin(), elements.end(), [&](const Element& element) {
    return std::all_of(element.begin(), element.end(), [&](std::uint32_t it) { return it < vertices; });
  });
}

bool can_be_undone(const Affine3& frame) {
  return frame.matrix().allFinite() && !frame.linear().isZero(0.0) &&
         geometry::unplacing(frame).matrix().allFinite();
}

std::string complaint_of_leaf(const geometry::CsgShape& shape, const CsgTree::Colour& colour) {
  if (!std::all_of(colour.begin(), colour.end(), [](float it) { return std::isfinite(it); }))
    return "The colours of a CSG tree must be finite.";
  if (const auto* primitive = std::get_if<geometry::Primitive>(&shape)) return complaint(*primitive);
  if (const auto* solid = std::get_if<std::shared_ptr<const geometry::MeshSolid>>(&shape)) {
    if ((*solid)->mesh.triangles.empty()) return "A mesh in a CSG tree needs triangles.";
    return complaint((*solid)->mesh);
  }
  return {};
}

}  // namespace

std::string complaint(const geometry::TriangleMesh& mesh) {
  const auto is_finite = [](const Vector3& it) { return it.allFinite(); };
  if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), is_finite)) return kNotFinite;
  if (!all_below(mesh.triangles, mesh.positions.size()))
    return "A triangle names a vertex that is not there.";
  return {};
}

std::string complaint(const MeshGeometry& shape) {
  const std::size_t triangles = shape.mesh.triangles.size();
  for (const std::size_t count :
       {shape.texture_coordinates.size(), shape.normals.size(), shape.colours.size()}) {
    if (count != 0 && count != triangles)
      return "A mesh needs texture coordinates, normals and colours for all of its triangles or for none.";
  }
  if (shape.recipe.size() > kMostRecipeBytes)
    return "A shape's parameters can take 1 MiB at most: make it in several parts.";
  if (!all_finite(shape.texture_coordinates) || !all_finite(shape.normals) || !all_finite(shape.colours))
    return kNotFinite;
  return complaint(shape.mesh);
}

std::string complaint(const LoopGeometry& shape) {
  const std::size_t vertices = shape.control.mesh.positions.size();
  const std::vector<std::uint32_t>& corners = shape.control.corners;
  if (!all_below(shape.control.creases, vertices) ||
      !std::all_of(corners.begin(), corners.end(), [&](std::uint32_t it) { return it < vertices; }))
    return "A crease or a corner names a vertex that is not there.";
  return complaint(shape.control.mesh);
}

/// Functions on primitives require the sizes that parse_primitive accepts.
std::string complaint(const geometry::Primitive& primitive) {
  const auto same = geometry::parse_primitive(geometry::name(primitive));
  return same ? std::string() : same.error().message;
}

std::string CsgNodeCheck::complaint(CsgTree::Index index, const CsgTree::Node& node) {
  if (!can_be_undone(node.parent_from_node))
    return "A node of a CSG tree needs a finite transform that does not flatten it.";
  if (node.is_leaf) return complaint_of_leaf(*node.shape, node.colour.value_or(CsgTree::Colour{}));
  for (const CsgTree::Index operand : {node.left, node.right}) {
    if (operand >= index) return "The operands of a CSG operation must come before it.";
    if (used_[operand]) return "A node of a CSG tree can be an operand once only.";
    used_[operand] = true;
  }
  return {};
}

}  // namespace icome::world
