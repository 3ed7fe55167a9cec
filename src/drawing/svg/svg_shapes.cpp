#include "drawing/svg/svg_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "drawing/svg/svg_frame.h"
#include "drawing/svg/svg_scanner.h"
#include "drawing/svg/xml_text.h"

namespace icome::drawing {
namespace {

using base::Vector2;
using Subpaths = base::Result<std::vector<SvgSubpath>>;

/// Reads the lengths of an element; the first fault sticks.
class ShapeLengths {
 public:
  ShapeLengths(const XmlNode& node, const Vector2& whole) : node_(node), whole_(whole) {}

  double x(const char* name) { return length(name, whole_.x()).value_or(0.0); }
  double y(const char* name) { return length(name, whole_.y()).value_or(0.0); }
  /// A radius, which may be given in percent of the whole's mean side.
  double radius(const char* name) { return length(name, whole_.norm() / std::sqrt(2.0)).value_or(0.0); }
  /// Nothing where it is missing or "auto".
  std::optional<double> x_or_none(const char* name) { return length(name, whole_.x()); }
  std::optional<double> y_or_none(const char* name) { return length(name, whole_.y()); }
  void refuse_negative(const char* name, double value) {
    if (value < 0.0) fault_ = fmt::format("{} of <{}> is negative", name, node_.name());
  }
  const std::string& fault() const { return fault_; }

 private:
  std::optional<double> length(const char* name, double whole) {
    const XmlAttribute attribute = node_.attribute(name);
    if (!attribute || std::string_view(attribute.value()) == "auto") return std::nullopt;
    const auto value = parse_svg_length(attribute.value(), whole);
    if (!value)
      fault_ = fmt::format("{}={} of <{}> is no length", name, quoted_value(attribute.value()), node_.name());
    return value;
  }

  XmlNode node_;
  Vector2 whole_;
  std::string fault_;
};

Subpaths built_shape(SvgPathBuilder& builder, const ShapeLengths& lengths) {
  if (!lengths.fault().empty()) return base::fail(lengths.fault());
  return builder.take();
}

Subpaths line_shape(ShapeLengths lengths) {
  SvgPathBuilder builder;
  builder.move_to({lengths.x("x1"), lengths.y("y1")});
  builder.line_to({lengths.x("x2"), lengths.y("y2")});
  return built_shape(builder, lengths);
}

Subpaths polygon_shape(std::string_view points, bool is_closed) {
  SvgPathBuilder builder;
  SvgScanner scanner(points);
  for (bool is_first = true; !scanner.at_end(); is_first = false) {
    const std::string_view begin = scanner.rest();
    const auto x = scanner.number(), y = scanner.number();
    if (!x || !y)
      return base::fail(fmt::format("{} in the points is no pair of numbers", quoted_value(begin)));
    if (is_first) builder.move_to({*x, *y});
    if (!is_first) builder.line_to({*x, *y});
  }
  if (is_closed) builder.close();
  return builder.take();
}

void add_ellipse(SvgPathBuilder& builder, const Vector2& centre, const Vector2& radii) {
  if (!(radii.minCoeff() > 0.0)) return;
  builder.move_to({centre.x() + radii.x(), centre.y()});
  builder.arc_to(radii, 0.0, false, true, {centre.x() - radii.x(), centre.y()});
  builder.arc_to(radii, 0.0, false, true, {centre.x() + radii.x(), centre.y()});
  builder.close();
}

Subpaths ellipse_shape(ShapeLengths lengths, bool is_circle) {
  SvgPathBuilder builder;
  const Vector2 centre(lengths.x("cx"), lengths.y("cy"));
  const auto rx = is_circle ? lengths.radius("r") : lengths.x_or_none("rx");
  const auto ry = is_circle ? rx : lengths.y_or_none("ry");
  const Vector2 radii(rx.value_or(ry.value_or(0.0)), ry.value_or(rx.value_or(0.0)));
  lengths.refuse_negative("a radius", radii.minCoeff());
  add_ellipse(builder, centre, radii);
  return built_shape(builder, lengths);
}

/// Clockwise from the upper side's start, as SVG 2, 10.2, has it.
void add_rectangle(SvgPathBuilder& builder, const Vector2& corner, const Vector2& size,
                   const Vector2& radii) {
  const Vector2 end = corner + size;
  const bool is_round = radii.minCoeff() > 0.0;
  const double rx = is_round ? radii.x() : 0.0, ry = is_round ? radii.y() : 0.0;
  const auto side_and_arc = [&](const Vector2& side_end, const Vector2& arc_end) {
    if (builder.current() != side_end) builder.line_to(side_end);
    if (is_round) builder.arc_to(radii, 0.0, false, true, arc_end);
  };
  builder.move_to({corner.x() + rx, corner.y()});
  side_and_arc({end.x() - rx, corner.y()}, {end.x(), corner.y() + ry});
  side_and_arc({end.x(), end.y() - ry}, {end.x() - rx, end.y()});
  side_and_arc({corner.x() + rx, end.y()}, {corner.x(), end.y() - ry});
  side_and_arc({corner.x(), corner.y() + ry}, {corner.x() + rx, corner.y()});
  builder.close();
}

Subpaths rectangle_shape(ShapeLengths lengths) {
  SvgPathBuilder builder;
  const Vector2 corner(lengths.x("x"), lengths.y("y"));
  const Vector2 size(lengths.x("width"), lengths.y("height"));
  lengths.refuse_negative("width or height", size.minCoeff());
  const auto rx = lengths.x_or_none("rx"), ry = lengths.y_or_none("ry");
  const Vector2 radii(rx.value_or(ry.value_or(0.0)), ry.value_or(rx.value_or(0.0)));
  lengths.refuse_negative("a radius", radii.minCoeff());
  if (size.minCoeff() > 0.0) add_rectangle(builder, corner, size, radii.cwiseMin(0.5 * size));
  return built_shape(builder, lengths);
}

constexpr std::array<std::string_view, 7> kShapeNames = {"path", "line",   "polyline", "polygon",
                                                         "rect", "circle", "ellipse"};

}  // namespace

bool is_svg_shape(std::string_view name) { return std::ranges::count(kShapeNames, name) > 0; }

Subpaths svg_shape_of(const XmlNode& node, const Vector2& whole) {
  const std::string_view name = local_name(node.name());
  if (name == "path") return parse_svg_path(node.attribute("d").value());
  if (name == "polyline" || name == "polygon")
    return polygon_shape(node.attribute("points").value(), name == "polygon");
  ShapeLengths lengths(node, whole);
  if (name == "line") return line_shape(lengths);
  if (name == "rect") return rectangle_shape(lengths);
  return ellipse_shape(lengths, name == "circle");
}

}  // namespace icome::drawing
