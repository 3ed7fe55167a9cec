#include "interaction/operations/shapes/shape_making.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <variant>

#include "fonts/text_shape.h"
#include "geometry/mesh/mesh_check.h"
#include "geometry/mesh/polygon_triangulation.h"
#include "geometry/sweep/flat_shapes.h"
#include "interaction/operations/looks/texture_projector.h"
#include "interaction/operations/placement.h"
#include "world/shape/geometry_check.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/visit_geometry.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using geometry::TriangleMesh;
using world::GeometryPointer;
using Shape = Result<GeometryPointer>;

// The range of sizes of primitives and profiles, m.
constexpr double kSmallestSize = geometry::kSmallestProfile;
constexpr double kLargestSize = geometry::kLargestProfile;

/// The primitive, standing up; a box has the given size along each axis of its frame.
Shape solid(const geometry::Primitive& primitive) {
  if (const std::string complaint = world::complaint(primitive); !complaint.empty()) return fail(complaint);
  const bool is_box = std::holds_alternative<geometry::Box>(primitive);
  return std::make_shared<world::PrimitiveGeometry>(primitive, is_box ? world::Axis::Z : world::Axis::Y);
}

Shape made_box(const Arguments& it) { return solid(geometry::Box{it.vector("size") / 2}); }
Shape made_cube(const Arguments& it) {
  return solid(geometry::Box{Vector3::Constant(it.number("side") / 2)});
}
Shape made_sphere(const Arguments& it) { return solid(geometry::Sphere{it.number("radius")}); }
Shape made_cylinder(const Arguments& it) {
  return solid(geometry::Cylinder{it.number("radius"), it.number("height")});
}
Shape made_cone(const Arguments& it) {
  const double bottom = it.number("radius"), top = it.number("top_radius");
  if (top > 0 && top < kSmallestSize)
    return fail(fmt::format("'top_radius' must be 0 or {:g} or more, not {:g}", kSmallestSize, top));
  return solid(geometry::Cone{bottom, top, it.number("height")});
}
Shape made_torus(const Arguments& it) {
  const double radius = it.number("radius"), tube = it.number("tube");
  if (tube >= radius)
    return fail(fmt::format(
        "'tube' must be below 'radius', so that the ring has a hole: {:g} m is too much for {:g} m", tube,
        radius));
  return solid(geometry::Torus{radius, tube});
}
Shape made_capsule(const Arguments& it) {
  return solid(geometry::Capsule{it.number("radius"), it.number("height")});
}
Shape made_plane(const Arguments&) { return solid(geometry::Plane{}); }

/// The mesh with the recipe that makes it again.
Shape by_recipe(Result<TriangleMesh> mesh, const Arguments& it) {
  if (!mesh) return tl::unexpected(mesh.error());
  auto shape = std::make_shared<world::MeshGeometry>(std::move(*mesh));
  shape->recipe = json_from_value(said_of(shape_parameters(), it, it.text("shape")));
  return shape;
}

int sides_of(const Arguments& it, int otherwise) {
  return it.has("sides") ? int(it.count("sides")) : otherwise;
}

Shape made_triangle(const Arguments& it) {
  const double side = it.number("side");
  return by_recipe(geometry::triangle_sheet({side, side, side}), it);
}
Shape made_square(const Arguments& it) {
  return by_recipe(geometry::rectangle_sheet(it.number("side"), it.number("side")), it);
}
Shape made_rectangle(const Arguments& it) {
  return by_recipe(geometry::rectangle_sheet(it.number("width"), it.number("height")), it);
}
Shape made_circle(const Arguments& it) {
  return by_recipe(geometry::circle_sheet(it.number("radius"), int(it.count("segments"))), it);
}
Shape made_polygon(const Arguments& it) {
  return by_recipe(geometry::polygon_sheet(sides_of(it, 6), it.number("radius")), it);
}
Shape made_pyramid(const Arguments& it) {
  auto mesh = geometry::pyramid(sides_of(it, 4), it.number("radius"), it.number("height"));
  if (!mesh) return tl::unexpected(mesh.error());
  // Its tip is up, as that of a cone.
  for (Vector3& position : mesh->positions) position = Vector3(position.x(), position.z(), -position.y());
  return by_recipe(std::move(mesh), it);
}

Shape made_text(const Arguments& it) {
  return by_recipe(
      fonts::text_shape(it.text("text"), it.number("height"), it.number("depth"), it.text("font")), it);
}

Shape made_implicit(const Arguments& it) {
  const std::vector<Vector3> corners = it.points3("bounds");
  if (corners.size() != 2)
    return fail(fmt::format(
        "'bounds' must be two corners of a box, such as [[-1, -1, -1], [1, 1, 1]], not {}", corners.size()));
  const base::Bounds box(corners[0].cwiseMin(corners[1]), corners[0].cwiseMax(corners[1]));
  auto shape = world::ImplicitGeometry::create(it.text("formula"), box);
  if (!shape) return tl::unexpected(shape.error());
  return GeometryPointer(std::move(*shape));
}

Shape made_mesh(const Arguments& it) {
  TriangleMesh mesh{it.points3("points"), {}};
  const std::vector<Vector3> triangles = it.points3("triangles");
  mesh.triangles.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Vector3& corners = triangles[i];
    if (corners.array().floor().matrix() != corners)
      return fail(fmt::format("triangle {} must have three whole numbers, those of its corners from 0", i));
    if (corners.x() == corners.y() || corners.y() == corners.z() || corners.z() == corners.x())
      return fail(fmt::format("triangle {} has a corner twice; give three different ones", i));
    mesh.triangles.push_back(
        {std::uint32_t(corners.x()), std::uint32_t(corners.y()), std::uint32_t(corners.z())});
  }
  if (mesh.triangles.empty()) return fail("there is no triangle to make a mesh of; give at least one");
  if (const auto good = geometry::check_mesh(mesh); !good) return tl::unexpected(good.error());
  return std::make_shared<world::MeshGeometry>(std::move(mesh));
}

Shape made_group(const Arguments&) { return GeometryPointer(); }

struct ShapeKind {
  const char* name;
  Shape (*make)(const Arguments& arguments);
};

constexpr std::array kShapeKinds = {
    ShapeKind{"box", made_box},         ShapeKind{"cube", made_cube},
    ShapeKind{"sphere", made_sphere},   ShapeKind{"cylinder", made_cylinder},
    ShapeKind{"cone", made_cone},       ShapeKind{"torus", made_torus},
    ShapeKind{"capsule", made_capsule}, ShapeKind{"pyramid", made_pyramid},
    ShapeKind{"plane", made_plane},     ShapeKind{"triangle", made_triangle},
    ShapeKind{"square", made_square},   ShapeKind{"rectangle", made_rectangle},
    ShapeKind{"circle", made_circle},   ShapeKind{"polygon", made_polygon},
    ShapeKind{"text", made_text},       ShapeKind{"implicit", made_implicit},
    ShapeKind{"mesh", made_mesh},       ShapeKind{"group", made_group}};

/// The parameter of a length that shapes of these kinds have.
Parameter length(std::string name, std::string meaning, double fallback, std::vector<std::string> only_for) {
  return {.name = std::move(name),
          .kind = ParameterKind::Number,
          .meaning = std::move(meaning),
          .fallback = fallback,
          .least = kSmallestSize,
          .most = kLargestSize,
          .only_for = std::move(only_for)};
}

Parameter corners(std::string name, std::string meaning, int fallback, std::vector<std::string> only_for) {
  return {.name = std::move(name),
          .kind = ParameterKind::Count,
          .meaning = std::move(meaning),
          .fallback = fallback > 0 ? Value(fallback) : Value(),
          .least = 3,
          .most = double(geometry::kMaximumPolygonCorners),
          .only_for = std::move(only_for)};
}

std::vector<Parameter> all_shape_parameters() {
  std::vector<std::string> shapes;
  for (const ShapeKind& kind : kShapeKinds) shapes.emplace_back(kind.name);
  Parameter top = length("top_radius", "its radius at the top, m; 0 is a tip", 0.0, {"cone"});
  top.least = 0;
  Parameter depth = length("depth", "how thick its letters are, m; 0 is a sheet", 0.02, {"text"});
  depth.least = 0;
  return {
      {.name = "shape",
       .kind = ParameterKind::Choice,
       .meaning = "what it is",
       .required = true,
       .choices = shapes},
      {.name = "size",
       .kind = ParameterKind::Vector,
       .meaning = "its width, height and depth, m",
       .fallback = Value::List{0.1, 0.1, 0.1},
       .least = kSmallestSize,
       .most = kLargestSize,
       .only_for = {"box"}},
      length("side", "how long each of its sides is, m", 0.1, {"cube", "triangle", "square"}),
      length("radius", "m; of a torus that of the circle in its middle, of sheets to their corners", 0.05,
             {"sphere", "cylinder", "cone", "torus", "capsule", "pyramid", "circle", "polygon"}),
      std::move(top),
      length("tube", "the radius of the ring's own thickness, m", 0.02, {"torus"}),
      length("width", "m", 0.1, {"rectangle"}),
      length("height", "m; of a capsule without its round ends, of text that of its capitals", 0.1,
             {"cylinder", "cone", "capsule", "pyramid", "rectangle", "text"}),
      std::move(depth),
      corners("sides", "how many; else 6 of a polygon and 4 of a pyramid", 0, {"polygon", "pyramid"}),
      corners("segments", "how many straight sides stand for it", 64, {"circle"}),
      {.name = "text",
       .kind = ParameterKind::Text,
       .meaning = "what it says, in lines",
       .required = true,
       .only_for = {"text"}},
      {.name = "font",
       .kind = ParameterKind::Text,
       .meaning = "a family that is installed, perhaps with a style, such as \"DejaVu Serif:bold\"",
       .fallback = fonts::kUsualFont,
       .only_for = {"text"}},
      {.name = "formula",
       .kind = ParameterKind::Text,
       .meaning = "of x, y, z (m) and t (s), below 0 inside: \"x^2 + y^2 + z^2 - 0.01\"",
       .required = true,
       .only_for = {"implicit"}},
      {.name = "bounds",
       .kind = ParameterKind::Points,
       .meaning = "two corners of the box that cuts it off, m",
       .fallback = Value::List{Value::List{-1, -1, -1}, Value::List{1, 1, 1}},
       .least = -kLargestSize,
       .most = kLargestSize,
       .only_for = {"implicit"}},
      {.name = "points",
       .kind = ParameterKind::Points,
       .meaning = "its vertices, m",
       .required = true,
       .least = -kFarthestPlace,
       .most = kFarthestPlace,
       .only_for = {"mesh"}},
      {.name = "triangles",
       .kind = ParameterKind::Points,
       .meaning = "three vertices each, counted from 0, counter-clockwise seen from the front",
       .required = true,
       .least = 0,
       .most = double(std::numeric_limits<std::uint32_t>::max()),
       .only_for = {"mesh"}},
  };
}

Value listed(const Vector3& vector) { return Value::List{vector.x(), vector.y(), vector.z()}; }

struct WordsOfPrimitive {
  Value::Fields operator()(const geometry::Plane&) const { return {{"shape", "plane"}}; }
  Value::Fields operator()(const geometry::Box& it) const {
    return {{"shape", "box"}, {"size", listed(2 * it.half)}};
  }
  Value::Fields operator()(const geometry::Sphere& it) const {
    return {{"shape", "sphere"}, {"radius", it.radius}};
  }
  Value::Fields operator()(const geometry::Cylinder& it) const {
    return {{"shape", "cylinder"}, {"radius", it.radius}, {"height", it.height}};
  }
  Value::Fields operator()(const geometry::Cone& it) const {
    return {{"shape", "cone"},
            {"radius", it.bottom_radius},
            {"top_radius", it.top_radius},
            {"height", it.height}};
  }
  Value::Fields operator()(const geometry::Torus& it) const {
    return {{"shape", "torus"}, {"radius", it.major_radius}, {"tube", it.minor_radius}};
  }
  Value::Fields operator()(const geometry::Capsule& it) const {
    return {{"shape", "capsule"}, {"radius", it.radius}, {"height", it.height}};
  }
};

Result<Value::Fields> making_of_recipe(std::string_view recipe) {
  if (recipe.empty() || tells_projector_only(recipe))
    return fail("its shape was made or bent by hand and has no sizes; move its vertices, or scale it");
  const auto value = value_from_json(recipe);
  if (!value || !value->fields())
    return fail("how its shape was made cannot be read; move its vertices, or make it anew");
  return *value->fields();
}

/// The box as a cube where `changes` speak of its side, as it may have been made with one.
Value::Fields as_cube(const Value::Fields& box, const Value::Fields& changes) {
  const Value* size = field(box, "size");
  if (!size || !field(changes, "side") || field(changes, "size")) return box;
  const Value::List& sizes = *size->list();
  if (sizes[0] != sizes[1] || sizes[1] != sizes[2]) return box;
  return {{"shape", "cube"}, {"side", sizes[0]}};
}

/// The primitive along the axis of the one before it. A box needs no turn: its size says how it stands.
GeometryPointer along(world::Axis axis, const GeometryPointer& shape) {
  const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(shape.get());
  if (!primitive || std::holds_alternative<geometry::Box>(primitive->primitive)) return shape;
  return std::make_shared<world::PrimitiveGeometry>(primitive->primitive, axis);
}

/// The primitive; a box that a file stood along y gets its sizes in the frame of its shape.
geometry::Primitive laid(const world::PrimitiveGeometry& shape) {
  const auto* box = std::get_if<geometry::Box>(&shape.primitive);
  if (!box || shape.axis == world::Axis::Z) return shape.primitive;
  return geometry::Box{Vector3(box->half.x(), box->half.z(), box->half.y())};
}

}  // namespace

const std::vector<Parameter>& shape_parameters() {
  static const std::vector<Parameter> kAll = all_shape_parameters();
  return kAll;
}

Shape make_shape(const Arguments& arguments) {
  const auto kind = std::ranges::find(kShapeKinds, arguments.text("shape"), &ShapeKind::name);
  return kind->make(arguments);
}

Result<Value::Fields> making_of(const world::Geometry& shape) {
  using Making = Result<Value::Fields>;
  return world::visit_geometry(
      shape,
      [](const world::PrimitiveGeometry& it) -> Making { return std::visit(WordsOfPrimitive(), laid(it)); },
      [](const world::ImplicitGeometry& it) -> Making {
        const base::Bounds& box = it.surface()->box();
        return Value::Fields{{"shape", "implicit"},
                             {"formula", it.formula()},
                             {"bounds", Value::List{listed(box.min()), listed(box.max())}}};
      },
      [](const world::CsgGeometry&) -> Making {
        return fail("it is combined of several shapes; take it apart and reshape those");
      },
      [](const world::Geometry& it) -> Making { return making_of_recipe(world::recipe_of(it)); });
}

Shape remade(const world::World& world, const world::Geometry& shape, const Value::Fields& changes) {
  auto making = making_of(shape);
  if (!making) return tl::unexpected(making.error());
  Value::Fields fields = as_cube(*making, changes);
  for (const auto& [name, value] : changes) {
    const auto known = std::ranges::find(fields, name, &std::pair<std::string, Value>::first);
    if (known == fields.end())
      fields.emplace_back(name, value);
    else
      known->second = value;
  }
  const bool extruded = std::erase_if(fields, [](const auto& it) { return it.first == "op"; }) > 0;
  const auto arguments =
      Arguments::check(extruded ? extrusion_parameters() : shape_parameters(), fields, world);
  if (!arguments) return tl::unexpected(arguments.error());
  const auto made = extruded ? make_extrusion(*arguments) : make_shape(*arguments);
  const auto* before = dynamic_cast<const world::PrimitiveGeometry*>(&shape);
  return made && before ? along(before->axis, *made) : made;
}

Value::Fields said_of(const std::vector<Parameter>& parameters, const Arguments& arguments,
                      const std::string& choice) {
  Value::Fields fields;
  for (const Parameter& parameter : parameters) {
    const bool is_for =
        choice.empty() || parameter.only_for.empty() || std::ranges::count(parameter.only_for, choice) > 0;
    const Value* given = field(arguments.given(), parameter.name);
    if (is_for && (given || !parameter.fallback.is_null()))
      fields.emplace_back(parameter.name, given ? *given : parameter.fallback);
  }
  return fields;
}

}  // namespace icome::interaction
