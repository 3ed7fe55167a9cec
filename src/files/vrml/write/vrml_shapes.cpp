#include "files/vrml/write/vrml_shapes.h"

#include <fmt/format.h>

#include <variant>

#include "drawing/shape/drawing_shape.h"
#include "drawing/shape/drawing_text.h"
#include "files/csg/csg_text.h"
#include "files/exact_looks.h"
#include "files/shown_world.h"
#include "files/vrml/write/vrml_faces.h"
#include "io/number_text.h"
#include "world/shape/geometry_check.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/visit_geometry.h"

namespace icome::files {
namespace {

using base::Bounds;
using world::Axis;
using world::CsgGeometry;
using world::Geometry;
using world::ImplicitGeometry;
using world::LoopGeometry;
using world::MeshGeometry;
using world::PrimitiveGeometry;
using world::Vector3;

/// Has VRML 2.0 a node for the primitive with its axis?
bool is_native(const PrimitiveGeometry& shape) {
  if (const auto* cone = std::get_if<geometry::Cone>(&shape.primitive))
    return shape.axis == Axis::Y && cone->top_radius == 0.0;
  if (std::holds_alternative<geometry::Cylinder>(shape.primitive)) return shape.axis == Axis::Y;
  return shape.axis == Axis::Z && (std::holds_alternative<geometry::Box>(shape.primitive) ||
                                   std::holds_alternative<geometry::Sphere>(shape.primitive));
}

bool has_own_primitive(const geometry::CsgTree& tree) {
  for (geometry::CsgTree::Index i = 0; i < tree.size(); ++i) {
    const geometry::CsgTree::Node& node = tree.node(i);
    if (node.is_leaf && std::holds_alternative<std::shared_ptr<const geometry::CsgPrimitive>>(*node.shape))
      return true;
  }
  return false;
}

}  // namespace

/// Writes one shape; each function is for a kind.
class VrmlShapes::ByKind {
 public:
  ByKind(VrmlShapes& shapes, std::string head, const std::string& owner)
      : text_(shapes.text_), remarks_(shapes.remarks_), head_(std::move(head)), owner_(owner) {}

  void write(const PrimitiveGeometry& shape) {
    if (std::string why = world::complaint(shape.primitive); !why.empty()) return leave_out(why);
    if (!is_native(shape)) {
      open(kPrimitiveProto.name);
      text_.text_field("shape", geometry::name(shape.primitive));
      if (shape.axis == Axis::Y) text_.text_field("axis", "y");
      return show(shape, VrmlEdges::SharpWhereBent);
    }
    if (const auto* box = std::get_if<geometry::Box>(&shape.primitive)) {
      open("Box");
      text_.field("size", Vector3(2.0 * box->half));
    } else if (const auto* sphere = std::get_if<geometry::Sphere>(&shape.primitive)) {
      open("Sphere");
      text_.field("radius", sphere->radius);
    } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape.primitive)) {
      open("Cylinder");
      text_.field("radius", cylinder->radius);
      text_.field("height", cylinder->height);
    } else {
      const auto& cone = std::get<geometry::Cone>(shape.primitive);
      open("Cone");
      text_.field("bottomRadius", cone.bottom_radius);
      text_.field("height", cone.height);
    }
    text_.close();
  }

  void write(const MeshGeometry& shape) {
    if (std::string why = world::complaint(shape); !why.empty()) return leave_out(why);
    write_faces(shape, head_ + "IndexedFaceSet", text_);
  }

  void write(const LoopGeometry& shape) {
    if (std::string why = world::complaint(shape); !why.empty()) return leave_out(why);
    open(kLoopProto.name);
    text_.open_list("controlPoint");
    for (const Vector3& position : shape.control.mesh.positions) text_.row(position);
    text_.close_list();
    text_.open_list("controlIndex");
    for (const auto& triangle : shape.control.mesh.triangles) text_.polygon(triangle);
    text_.close_list();
    if (!shape.control.creases.empty()) {
      text_.open_list("crease");
      for (const auto& edge : shape.control.creases) text_.indices(edge);
      text_.close_list();
    }
    if (!shape.control.corners.empty()) {
      text_.open_list("corner");
      for (const std::uint32_t& corner : shape.control.corners) text_.indices({&corner, 1});
      text_.close_list();
    }
    show(shape, shape.control.creases.empty() && shape.control.corners.empty() ? VrmlEdges::Smooth
                                                                               : VrmlEdges::SharpWhereBent);
  }

  void write(const CsgGeometry& shape) {
    const auto tree = csg_text(shape.tree);
    if (!tree) return write_triangles(shape, tree.error().message);
    open(kCsgProto.name);
    text_.text_field("tree", *tree);
    if (has_part_colours(shape)) tell_of_part_colours_left(false);
    show(shape, VrmlEdges::SharpWhereBent);
  }

  void write(const ImplicitGeometry& shape) {
    const Bounds& box = shape.surface()->box();
    std::string corners;
    for (const Vector3& corner : {box.min(), box.max()}) {
      for (const double coordinate : corner) {
        if (!corners.empty()) corners += ' ';
        io::append_number(corners, coordinate);
      }
    }
    open(kImplicitProto.name);
    text_.text_field("formula", shape.formula());
    text_.text_field("box", corners);
    show(shape, VrmlEdges::SharpWhereBent);
  }

  void write(const drawing::DrawingShape& shape) {
    open(kDrawingProto.name);
    text_.text_field("svg", drawing::svg_of(shape));
    text_.text_field("body", drawing::text_of(shape.body()));
    tell_of_part_colours_left(false);
    show(shape, VrmlEdges::SharpWhereBent);
  }

  void write_triangles(const Geometry& shape, const std::string& why) {
    const auto triangles = shown_triangles(shape);
    const std::string wrong = triangles ? world::complaint(**triangles) : triangles.error().message;
    if (!wrong.empty()) return leave_out(wrong);
    remark("is written as triangles", why);
    if (has_part_colours(shape)) tell_of_part_colours_left(true);
    write_faces(**triangles, head_ + "IndexedFaceSet", text_);
  }

 private:
  void open(const char* node) { text_.open(head_ + node); }

  /// Writes the fields for other programs, and the end of the node.
  void show(const Geometry& shape, VrmlEdges edges) {
    static const geometry::TriangleMesh kNothing;
    const auto triangles = shown_triangles(shape);
    const std::string wrong = triangles ? world::complaint((*triangles)->mesh) : triangles.error().message;
    if (!wrong.empty()) remark("is not seen by other programs", wrong);
    write_coordinates(wrong.empty() ? (*triangles)->mesh : kNothing, text_);
    write_crease_angle(edges, text_);
    text_.close();
  }

  void tell_of_part_colours_left(bool loses) {
    remarks_.push_back({"", 0,
                        fmt::format("The colours of parts of the shape of {} are {}.", owner_,
                                    loses ? "left out" : "not seen by other programs"),
                        loses});
  }
  void leave_out(const std::string& why) {
    remark("is left out", why);
    write_faces(MeshGeometry(geometry::TriangleMesh{}), head_ + "IndexedFaceSet", text_);
  }
  void remark(const char* what, const std::string& why) {
    remarks_.push_back({"", 0, fmt::format("The shape of {} {}: {}", owner_, what, why)});
  }

  VrmlText& text_;
  std::vector<Remark>& remarks_;
  const std::string head_;
  const std::string& owner_;
};

const VrmlProto* VrmlShapes::proto_of(const Geometry& shape) {
  using Proto = const VrmlProto*;
  return world::visit_geometry(
      shape, [](const PrimitiveGeometry& it) -> Proto { return is_native(it) ? nullptr : &kPrimitiveProto; },
      [](const CsgGeometry& it) -> Proto { return has_own_primitive(it.tree) ? nullptr : &kCsgProto; },
      [](const LoopGeometry&) -> Proto { return &kLoopProto; },
      [](const ImplicitGeometry&) -> Proto { return &kImplicitProto; },
      [](const Geometry& it) -> Proto { return drawing::drawing_in(it) ? &kDrawingProto : nullptr; });
}

void VrmlShapes::write(const Geometry& shape, const std::string& def, const std::string& owner) {
  ByKind by_kind(*this, def.empty() ? "geometry " : fmt::format("geometry DEF {} ", def), owner);
  world::visit_geometry(
      shape, [&](const MeshGeometry& it) { by_kind.write(it); },
      [&](const PrimitiveGeometry& it) { by_kind.write(it); },
      [&](const LoopGeometry& it) { by_kind.write(it); }, [&](const CsgGeometry& it) { by_kind.write(it); },
      [&](const ImplicitGeometry& it) { by_kind.write(it); },
      [&](const Geometry& it) {
        if (const auto* const drawn = drawing::drawing_in(it)) return by_kind.write(*drawn);
        by_kind.write_triangles(
            it, fmt::format("VRML 2.0 has nothing for shapes of the kind \"{}\".", it.kind()));
      });
}

}  // namespace icome::files
