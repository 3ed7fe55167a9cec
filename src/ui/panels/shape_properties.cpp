#include "ui/panels/shape_properties.h"

#include "charts/length_text.h"
#include "world/shape/geometry_check.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/visit_geometry.h"

namespace icome::ui {

using base::Result;
using world::ObjectId;
using world::World;

namespace {

const world::Geometry* shape_of(const World& world, ObjectId id) {
  const world::GeometryObject* shape = world.find(world.find(id)->geometry);
  return shape ? shape->shape.get() : nullptr;
}

template <typename Kind>
const Kind* shape_as(const World& world, ObjectId id) {
  return dynamic_cast<const Kind*>(shape_of(world, id));
}

/// A size of one kind of primitive. `number` reads it, and first sets it where a value is given.
template <typename Kind, typename Number>
Property<double> size_property(const Number& number) {
  return {[number](const World& world, ObjectId id) -> std::optional<double> {
            const auto* shape = shape_as<world::PrimitiveGeometry>(world, id);
            const Kind* sizes = shape ? std::get_if<Kind>(&shape->primitive) : nullptr;
            if (!sizes) return std::nullopt;
            Kind copy = *sizes;
            return number(copy, shape->axis, std::nullopt);
          },
          [number](const World& world, ObjectId id, double value) -> Result<world::Edit> {
            const auto* shape = shape_as<world::PrimitiveGeometry>(world, id);
            Kind sizes = std::get<Kind>(shape->primitive);
            number(sizes, shape->axis, value);
            const std::string complaint = world::complaint(geometry::Primitive(sizes));
            if (!complaint.empty())
              return base::fail(
                  "Sizes go from 0.000001 mm to 1,000 km; a ring is wider than its tube is thick, and of a "
                  "cone's "
                  "radii one may be 0.");
            return world::Edit(world::ReplaceGeometry{
                world.find(id)->geometry, std::make_shared<world::PrimitiveGeometry>(sizes, shape->axis)});
          }};
}

template <typename Kind>
ShapeSize size_of(const char* label, double Kind::*member) {
  return {label, size_property<Kind>([member](Kind& it, world::Axis, std::optional<double> value) {
            if (value) it.*member = *value;
            return it.*member;
          })};
}

/// A box stands along z or y, as other primitives do; `axis` is an axis of the object.
ShapeSize box_size(const char* label, int axis) {
  return {label, size_property<geometry::Box>(
                     [axis](geometry::Box& it, world::Axis stands, std::optional<double> value) {
                       const int own = stands == world::Axis::Z || axis == 0 ? axis : 3 - axis;
                       if (value) it.half[own] = 0.5 * *value;
                       return 2.0 * it.half[own];
                     })};
}

QString counted(std::size_t number, const char* one, const char* many) {
  return QString("%1 %2").arg(QString::fromStdString(charts::grouped(number)), number == 1 ? one : many);
}

}  // namespace

std::vector<ShapeSize> shape_sizes() {
  using geometry::Capsule, geometry::Cone, geometry::Cylinder, geometry::Sphere, geometry::Torus;
  return {box_size("Along x", 0),
          box_size("Along y", 1),
          box_size("Along z", 2),
          size_of("Radius", &Sphere::radius),
          size_of("Radius", &Cylinder::radius),
          size_of("Height", &Cylinder::height),
          size_of("Bottom radius", &Cone::bottom_radius),
          size_of("Top radius", &Cone::top_radius),
          size_of("Height", &Cone::height),
          size_of("Ring radius", &Torus::major_radius),
          size_of("Tube radius", &Torus::minor_radius),
          size_of("Radius", &Capsule::radius),
          size_of("Height", &Capsule::height)};
}

Property<std::string> formula_property() {
  return {[](const World& world, ObjectId id) -> std::optional<std::string> {
            const auto* shape = shape_as<world::ImplicitGeometry>(world, id);
            return shape ? std::optional(shape->formula()) : std::nullopt;
          },
          [](const World& world, ObjectId id, const std::string& formula) -> Result<world::Edit> {
            const auto* shape = shape_as<world::ImplicitGeometry>(world, id);
            auto made = world::ImplicitGeometry::create(formula, shape->bounds());
            if (!made) return tl::unexpected(made.error());
            return world::Edit(world::ReplaceGeometry{world.find(id)->geometry, *made});
          }};
}

QString figures_of(const world::Geometry& shape) {
  return world::visit_geometry(
      shape,
      [](const world::MeshGeometry& it) {
        return counted(it.mesh.triangles.size(), "triangle", "triangles") + ", " +
               counted(it.mesh.positions.size(), "vertex", "vertices");
      },
      [](const world::LoopGeometry& it) {
        return counted(it.control.mesh.triangles.size(), "control triangle", "control triangles") + ", " +
               counted(it.control.creases.size(), "crease", "creases");
      },
      [](const world::CsgGeometry& it) {
        const geometry::CsgCount count = geometry::count(it.tree);
        return counted(count.primitives, "operand", "operands") + ", " +
               counted(count.nodes - count.primitives, "operation", "operations");
      },
      [](const world::Geometry&) { return QString(); });
}

}  // namespace icome::ui
