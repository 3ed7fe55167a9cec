#include "files/csg/csg_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "files/csg/csg_arguments.h"
#include "files/csg/csg_facets.h"

namespace icome::files {
namespace {

using geometry::CsgShape;
using geometry::MeshSolid;
using geometry::Primitive;
using geometry::Vector3;
using Index = CsgDocument::Index;

// With so many facets a shape is meant to be faceted; with more or none it is meant to be round.
constexpr double kFewestFacets = 3.0;
constexpr double kMostFacets = 16.0;

double metres(double millimetres) { return millimetres / kMillimetresPerMetre; }

/// Number of facets of the statement; 0 for a round shape.
int facets(CsgArguments& arguments) {
  const double wanted = arguments.number_or("$fn", 0.0);
  return wanted >= kFewestFacets && wanted <= kMostFacets ? static_cast<int>(wanted) : 0;
}

/// A radius, given directly or as the diameter, which wins as in OpenSCAD.
std::optional<double> radius_of(CsgArguments& arguments, std::string_view radius, std::string_view diameter) {
  const std::optional<double> given = arguments.number(radius);
  const std::optional<double> across = arguments.number(diameter);
  return across ? *across / 2 : given;
}

/// The error when arguments were wrong or a size is out of range. Sizes in mm.
base::Result<void> checked(const CsgArguments& arguments, const CsgDocument& document, Index statement,
                           std::initializer_list<double> sizes) {
  if (arguments.failed()) return tl::unexpected(arguments.error());
  for (const double size : sizes) {
    if (size >= kSmallestSize && size <= kLargestSize) continue;
    const CsgDocument::Statement& at = document.statements()[statement];
    return tl::unexpected(document.error_at(
        at.offset, fmt::format("{} has a size of {:.6g} mm; it must be from {:.0g} to {:.0g} mm",
                               document.name(at), size, kSmallestSize, kLargestSize)));
  }
  return {};
}

base::Result<std::array<double, 3>> cube_size(CsgArguments& arguments, const CsgDocument& document) {
  const std::optional<Index> size = arguments.find("size");
  if (!size) return std::array<double, 3>{1.0, 1.0, 1.0};
  const CsgDocument::Value& value = document.value(*size);
  if (value.kind == CsgDocument::Kind::Number)
    return std::array<double, 3>{value.number, value.number, value.number};
  if (value.kind == CsgDocument::Kind::Vector) return arguments.numbers<3>(*size, "the size of a cube");
  arguments.fail_kind(*size, "a number or a vector of 3 is expected for the size of a cube");
  return tl::unexpected(arguments.error());
}

}  // namespace

base::Result<CsgPart> CsgShapes::cube(const CsgDocument& document, Index statement) {
  CsgArguments arguments(document, statement, {"size", "center"});
  const auto size = cube_size(arguments, document);
  const bool centred = arguments.flag("center");
  if (arguments.failed()) return tl::unexpected(arguments.error());
  if (*std::min_element(size->begin(), size->end()) <= 0.0) return CsgPart{};
  const auto [x, y, z] = *size;
  if (const auto good = checked(arguments, document, statement, {x, y, z}); !good)
    return tl::unexpected(good.error());
  const Vector3 half(metres(x) / 2, metres(y) / 2, metres(z) / 2);
  return CsgPart{Primitive(geometry::Box{half}), centred ? Vector3(Vector3::Zero()) : half, {}};
}

base::Result<CsgPart> CsgShapes::sphere(const CsgDocument& document, Index statement) {
  CsgArguments arguments(document, statement, {"r", "d"});
  const double radius = radius_of(arguments, "r", "d").value_or(1.0);
  const int sides = facets(arguments);
  if (arguments.failed()) return tl::unexpected(arguments.error());
  if (radius <= 0.0) return CsgPart{};
  if (const auto good = checked(arguments, document, statement, {radius}); !good)
    return tl::unexpected(good.error());
  if (sides == 0) return CsgPart{Primitive(geometry::Sphere{metres(radius)}), Vector3::Zero(), {}};
  Facets& solid = faceted_[{radius, radius, 0.0, static_cast<double>(sides)}];
  if (!solid) solid = std::make_shared<const MeshSolid>(faceted_ball(metres(radius), sides));
  return CsgPart{solid, Vector3::Zero(), {}};
}

base::Result<CsgPart> CsgShapes::cylinder(const CsgDocument& document, Index statement) {
  CsgArguments arguments(document, statement, {"h", "r1", "r2", "center", "r", "d", "d1", "d2"});
  const double height = arguments.number_or("h", 1.0);
  const double both = radius_of(arguments, "r", "d").value_or(1.0);
  const double bottom = radius_of(arguments, "r1", "d1").value_or(both);
  const double top = radius_of(arguments, "r2", "d2").value_or(both);
  const bool centred = arguments.flag("center");
  const int sides = facets(arguments);
  if (arguments.failed()) return tl::unexpected(arguments.error());
  const double larger = std::max(bottom, top);
  const double smaller = std::min(bottom, top);
  if (height <= 0.0 || smaller < 0.0 || larger == 0.0) return CsgPart{};
  if (const auto good =
          checked(arguments, document, statement, {height, larger, smaller == 0.0 ? larger : smaller});
      !good)
    return tl::unexpected(good.error());
  CsgPart part;
  part.centre.z() = centred ? 0.0 : metres(height) / 2;
  if (sides != 0) {
    Facets& solid = faceted_[{bottom, top, height, static_cast<double>(sides)}];
    if (!solid) {
      solid = std::make_shared<const MeshSolid>(
          faceted_cylinder(metres(bottom), metres(top), metres(height), sides));
    }
    part.shape = solid;
  } else if (bottom == top) {
    part.shape = Primitive(geometry::Cylinder{metres(bottom), metres(height)});
  } else {
    part.shape = Primitive(geometry::Cone{metres(bottom), metres(top), metres(height)});
  }
  return part;
}

}  // namespace icome::files
