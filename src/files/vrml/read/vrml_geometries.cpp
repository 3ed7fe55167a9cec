#include "files/vrml/read/vrml_geometries.h"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>
#include <vrml_answer_generated.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "drawing/shape/drawing_text.h"
#include "files/csg/csg_text.h"
#include "files/vrml/read/taken_faces.h"
#include "geometry/loop/loop_topology.h"
#include "geometry/mesh/polygon_triangulation.h"
#include "io/single.h"
#include "world/shape/geometry_check.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

using base::Result;
using base::Vector3;
using world::GeometryPointer;

constexpr FindingKind kWrongSizes = {
    "Boxes, spheres, cylinders and cones must have sizes from 1e-9 to 1e6 m: shapes are left out", "shapes"};
constexpr FindingKind kUnknownKind = {"Shapes of a kind that is unknown here are left out", "shapes"};
constexpr FindingKind kEmpty = {"Shapes without triangles are left out", "shapes"};
constexpr FindingKind kWrongEdges = {"Creases and corners at vertices that are not there are left out",
                                     "Loop surfaces"};

constexpr std::size_t kLongestPrimitive = 200;  // letters: three numbers, and errors of a readable length

VrmlFaceSet faces_of(const flat::Geometry& geometry, world::FlatReader& reader) {
  VrmlFaceSet faces;
  faces.name = reader.text(geometry.name());
  faces.positions = reader.items<float>(geometry.positions());
  faces.polygons = reader.items<std::int32_t>(geometry.polygons());
  faces.texture_coordinates = reader.items<float>(geometry.texture_coordinates());
  faces.texture_polygons = reader.items<std::int32_t>(geometry.texture_polygons());
  faces.normals = reader.items<float>(geometry.normals());
  faces.normal_polygons = reader.items<std::int32_t>(geometry.normal_polygons());
  faces.normal_per_vertex = geometry.normal_per_vertex();
  faces.colours = reader.items<float>(geometry.colours());
  faces.colour_polygons = reader.items<std::int32_t>(geometry.colour_polygons());
  faces.colour_per_vertex = geometry.colour_per_vertex();
  faces.ccw = geometry.ccw();
  faces.crease_angle =
      std::isfinite(geometry.crease_angle()) ? io::from_single(geometry.crease_angle()) : 0.0;
  return faces;
}

Result<GeometryPointer> checked(const geometry::Primitive& primitive, world::Axis axis) {
  if (std::string why = world::complaint(primitive); !why.empty()) return base::fail(std::move(why));
  return GeometryPointer(std::make_shared<world::PrimitiveGeometry>(primitive, axis));
}

/// One of the primitives of VRML; sizes are those of its fields.
Result<GeometryPointer> vrml_primitive(flat::GeometryKind kind, const std::vector<double>& sizes) {
  const std::size_t count = kind == flat::GeometryKind::Box ? 3 : kind == flat::GeometryKind::Sphere ? 1 : 2;
  if (sizes.size() != count) return base::fail("has too few sizes");
  if (kind == flat::GeometryKind::Box)
    return checked(geometry::Box{0.5 * Vector3(sizes[0], sizes[1], sizes[2])}, world::Axis::Z);
  if (kind == flat::GeometryKind::Sphere) return checked(geometry::Sphere{sizes[0]}, world::Axis::Z);
  if (kind == flat::GeometryKind::Cylinder)
    return checked(geometry::Cylinder{sizes[0], sizes[1]}, world::Axis::Y);
  return checked(geometry::Cone{sizes[0], 0.0, sizes[1]}, world::Axis::Y);
}

Result<GeometryPointer> primitive_of_text(const std::string& text, bool along_y) {
  if (text.size() > kLongestPrimitive) return base::fail("its text is too long");
  const auto primitive = geometry::parse_primitive(text);
  if (!primitive) return tl::unexpected(primitive.error());
  return checked(*primitive, along_y ? world::Axis::Y : world::Axis::Z);
}

Result<GeometryPointer> implicit_of(const std::string& formula, const std::vector<double>& box) {
  if (box.size() != 6) return base::fail("it has no box");
  base::Bounds bounds;
  bounds.min() = Vector3(box[0], box[1], box[2]);
  bounds.max() = Vector3(box[3], box[4], box[5]);
  auto shape = world::ImplicitGeometry::create(formula, bounds);
  if (!shape) return tl::unexpected(shape.error());
  return GeometryPointer(std::move(*shape));
}

Result<GeometryPointer> csg_of(const std::string& text) {
  auto tree = csg_from_text(text);
  if (!tree) return tl::unexpected(tree.error());
  return GeometryPointer(std::make_shared<world::CsgGeometry>(std::move(*tree)));
}

/// Makes the control mesh of a Loop surface, whose vertices keep their order.
class LoopMaker {
 public:
  LoopMaker(const VrmlFaceSet& faces, Findings& findings) : faces_(faces), findings_(findings) {
    numbers_.resize(faces.positions.size() / 3);
  }

  Result<GeometryPointer> make(const std::vector<std::int32_t>& creases,
                               const std::vector<std::int32_t>& corners, io::TimeBudget& time_budget) {
    const TakenFaces taken =
        take_faces(faces_.positions, faces_.polygons, faces_.ccw, faces_.name, findings_);
    control_.mesh.positions = taken.mesh.positions;
    for (std::size_t i = 0; i < taken.vertices.size(); ++i)
      numbers_[taken.vertices[i]] = std::uint32_t(taken.mesh.corners[i]) + 1;
    if (!cut(taken.mesh, time_budget)) return base::fail("it takes too long");
    add_sharp(creases, corners);
    if (const auto good = geometry::loop_topology(control_); !good) return tl::unexpected(good.error());
    return GeometryPointer(std::make_shared<world::LoopGeometry>(std::move(control_)));
  }

 private:
  bool cut(const PolygonMesh& mesh, io::TimeBudget& time_budget) {
    std::vector<Vector3> corners;
    std::vector<std::array<std::uint32_t, 3>> cut;
    for (std::size_t i = 0; i < mesh.polygons(); ++i) {
      if (!time_budget.lasts()) return false;
      const std::uint32_t* const polygon = mesh.corners.data() + mesh.begins[i];
      corners.clear();
      cut.clear();
      for (std::uint32_t k = 0; k < mesh.begins[i + 1] - mesh.begins[i]; ++k)
        corners.push_back(mesh.positions[polygon[k]]);
      geometry::triangulate_polygon(corners, cut);
      for (const auto& [a, b, c] : cut)
        control_.mesh.triangles.push_back({polygon[a], polygon[b], polygon[c]});
    }
    return true;
  }

  /// The number of a vertex among those that are left, from 1; 0: it is missing.
  std::uint32_t number(std::int32_t vertex) const {
    return vertex >= 0 && std::size_t(vertex) < numbers_.size() ? numbers_[std::size_t(vertex)] : 0;
  }

  void add_sharp(const std::vector<std::int32_t>& creases, const std::vector<std::int32_t>& corners) {
    std::size_t wrong = creases.size() % 2;
    for (std::size_t i = 0; i + 1 < creases.size(); i += 2) {
      const std::uint32_t a = number(creases[i]), b = number(creases[i + 1]);
      if (a != 0 && b != 0)
        control_.creases.push_back({a - 1, b - 1});
      else
        ++wrong;
    }
    for (const std::int32_t corner : corners) {
      if (number(corner) != 0)
        control_.corners.push_back(number(corner) - 1);
      else
        ++wrong;
    }
    if (wrong > 0) findings_.add(kWrongEdges, faces_.name, wrong);
  }

  const VrmlFaceSet& faces_;
  Findings& findings_;
  std::vector<std::uint32_t> numbers_;  // of vertices of the file
  geometry::ControlMesh control_;
};

/// Reads one geometry.
class GeometryReader {
 public:
  GeometryReader(const flat::Geometry& geometry, world::FlatReader& reader, Findings& findings,
                 io::TimeBudget& time_budget)
      : geometry_(geometry),
        reader_(reader),
        findings_(findings),
        time_budget_(time_budget),
        faces_(faces_of(geometry, reader)) {}

  GeometryPointer shape(bool shows_picture) {
    if (geometry_.kind() > flat::GeometryKind::MAX) {
      findings_.add(kUnknownKind, faces_.name);
      return nullptr;
    }
    if (geometry_.kind() != flat::GeometryKind::Faces) {
      if (GeometryPointer shape = exact()) return shape;
      if (faces_.polygons.empty()) return nullptr;
    }
    GeometryPointer mesh = mesh_of_faces(faces_, shows_picture, findings_, time_budget_);
    if (!mesh) findings_.add(kEmpty, faces_.name);
    return mesh;
  }

 private:
  /// Null, with a remark, when it cannot be made.
  GeometryPointer exact() {
    auto shape = make();
    if (!reader_.fault().empty()) return nullptr;
    if (shape) return *shape;
    if (geometry_.kind() < flat::GeometryKind::Faces) {
      findings_.add(kWrongSizes, faces_.name);
    } else {
      findings_.tell(fmt::format("The shape {} {}: {}", quoted_name(faces_.name),
                                 faces_.polygons.empty() ? "is left out" : "becomes a mesh of triangles",
                                 shape.error().message));
    }
    return nullptr;
  }

  Result<GeometryPointer> make() {
    switch (geometry_.kind()) {
      case flat::GeometryKind::Loop: {
        const auto creases = reader_.items<std::int32_t>(geometry_.creases());
        const auto corners = reader_.items<std::int32_t>(geometry_.corners());
        return LoopMaker(faces_, findings_).make(creases, corners, time_budget_);
      }
      case flat::GeometryKind::Csg:
        return csg_of(reader_.text(geometry_.text()));
      case flat::GeometryKind::Implicit:
        return implicit_of(reader_.text(geometry_.text()), reader_.items<double>(geometry_.box()));
      case flat::GeometryKind::Drawing:
        return drawing::shape_of_svg(reader_.text(geometry_.text()),
                                     reader_.items<double>(geometry_.sizes()));
      case flat::GeometryKind::Primitive:
        return primitive_of_text(reader_.text(geometry_.text()), geometry_.along_y());
      default:
        return vrml_primitive(geometry_.kind(), reader_.items<double>(geometry_.sizes()));
    }
  }

  const flat::Geometry& geometry_;
  world::FlatReader& reader_;
  Findings& findings_;
  io::TimeBudget& time_budget_;
  VrmlFaceSet faces_;
};

}  // namespace

GeometryPointer shape_of(const flat::Geometry& geometry, world::FlatReader& reader, bool shows_picture,
                         Findings& findings, io::TimeBudget& time_budget) {
  return GeometryReader(geometry, reader, findings, time_budget).shape(shows_picture);
}

}  // namespace icome::files
