#include "files/vrml/write/vrml_faces.h"

#include <algorithm>
#include <numbers>

#include "files/crease_normals.h"
#include "files/vrml/write/corner_table.h"
#include "geometry/mesh/mesh_topology.h"
#include "io/number_text.h"
#include "io/single.h"

namespace icome::files {
namespace {

using geometry::TriangleMesh;
using world::Colour;
using world::MeshGeometry;
using world::Vector2;
using world::Vector3;

/// Does the mesh show its fronts only, seen from anywhere outside?
bool is_solid(const TriangleMesh& mesh) {
  const geometry::MeshReport report = geometry::analyse_topology(mesh).report;
  return report.closed && report.inconsistent_edges == 0 && geometry::signed_volume(mesh) > 0.0;
}

/// Do all corners have the normals of their triangles, as those of readers that get no normals?
bool looks_flat(const MeshGeometry& shape) {
  constexpr double kSame = 1e-6;
  for (std::size_t t = 0; t < shape.normals.size(); ++t) {
    const Vector3& first = shape.mesh.corner(t, 0);
    const Vector3 across = (shape.mesh.corner(t, 1) - first).cross(shape.mesh.corner(t, 2) - first);
    const Vector3 normal = across.stableNormalized();
    for (const Vector3& corner : shape.normals[t]) {
      if (!((corner - normal).cwiseAbs().maxCoeff() < kSame)) return false;
    }
  }
  return true;
}

/// Will readers find no crease between the faces, and take the mesh for a smooth one? True also for a single
/// face, which looks alike both ways.
bool has_no_creases(const TriangleMesh& mesh) {
  PolygonMesh faces;
  faces.positions.reserve(mesh.positions.size());
  for (const Vector3& it : mesh.positions)
    faces.positions.push_back(it.unaryExpr([](double x) { return io::from_single(io::to_single(x)); }));
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    faces.corners.insert(faces.corners.end(), triangle.begin(), triangle.end());
    faces.begins.push_back(std::uint32_t(faces.corners.size()));
  }
  return crease_normals(faces, 0.0).empty();
}

std::array<float, 2> parts(const Vector2& value) {
  return {io::to_single(value.x()), io::to_single(value.y())};
}
/// Readers may make the normal a unit vector again, which would be written differently: this one stays.
/// All parts are rounded to the same decimal, or small ones would change each time.
std::array<float, 3> parts(const Vector3& normal) {
  constexpr double kDecimals = 1e7;
  constexpr int kMostRounds = 16;
  Vector3 result = normal;
  for (int i = 0; i < kMostRounds; ++i) {
    const Vector3 again = (result.normalized() * kDecimals).array().round() / kDecimals;
    if (again == result || !again.allFinite()) break;
    result = again;
  }
  return {float(result.x()), float(result.y()), float(result.z())};
}

Colour parts(Colour value) {
  for (float& part : value) part = std::clamp(part, 0.0F, 1.0F);
  return value;
}

template <std::size_t kParts>
struct Corners {
  std::vector<std::array<float, kParts>> values;  // each once
  std::vector<TriangleMesh::Triangle> indices;    // of every triangle
};

template <std::size_t kParts, typename Value>
Corners<kParts> gather(const std::vector<std::array<Value, 3>>& corners) {
  CornerTable<kParts> table(3 * corners.size());
  Corners<kParts> result;
  result.indices.reserve(corners.size());
  for (const auto& [a, b, c] : corners)
    result.indices.push_back({table.add(parts(a)), table.add(parts(b)), table.add(parts(c))});
  result.values = table.take();
  return result;
}

/// Writes fields such as "normal Normal { vector [ ... ] }" and "normalIndex [ ... ]".
template <std::size_t kParts>
void write_corners(const Corners<kParts>& corners, std::string_view node, std::string_view list,
                   std::string_view index, VrmlText& text) {
  text.open(node);
  text.open_list(list);
  for (const auto& value : corners.values) text.row(value);
  text.close_list();
  text.close();
  text.open_list(index);
  for (const TriangleMesh::Triangle& triangle : corners.indices) text.polygon(triangle);
  text.close_list();
}

void write_normals(const MeshGeometry& shape, VrmlText& text) {
  const bool flat = !shape.normals.empty() && looks_flat(shape);
  if (shape.normals.empty() || (flat && has_no_creases(shape.mesh)))
    return write_crease_angle(VrmlEdges::Smooth, text);
  if (flat) return;  // VRML's default
  write_corners(gather<3>(shape.normals), "normal Normal", "vector", "normalIndex", text);
}

}  // namespace

void write_coordinates(const TriangleMesh& mesh, VrmlText& text) {
  text.open("coord Coordinate");
  text.open_list("point");
  for (const Vector3& position : mesh.positions) text.row(position);
  text.close_list();
  text.close();
  text.open_list("coordIndex");
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) text.polygon(triangle);
  text.close_list();
  if (!is_solid(mesh)) text.field("solid", false);
}

void write_crease_angle(VrmlEdges edges, VrmlText& text) {
  constexpr double kBent = 0.5;
  text.field("creaseAngle", edges == VrmlEdges::Smooth ? std::numbers::pi : kBent);
}

void write_faces(const MeshGeometry& shape, std::string_view head, VrmlText& text) {
  text.open(head);
  write_coordinates(shape.mesh, text);
  if (!shape.texture_coordinates.empty())
    write_corners(gather<2>(shape.texture_coordinates), "texCoord TextureCoordinate", "point",
                  "texCoordIndex", text);
  write_normals(shape, text);
  if (!shape.colours.empty())
    write_corners(gather<3>(shape.colours), "color Color", "color", "colorIndex", text);
  text.close();
}

}  // namespace icome::files
