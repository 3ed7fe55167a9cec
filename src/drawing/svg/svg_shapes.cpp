#include "drawing/svg/svg_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "drawing/svg/svg_frame.h"
#include "drawing/svg/svg_scanner.h"
#include "drawing/svg/xml_text.h"

namespace icome::drawing {
namespace {

using base::Vector2;

/// Reads the lengths of an element; the last fault sticks.
class ShapeLengths {
 public:
  ShapeLengths(const XmlNode& node, const Vector2& whole) : node_(node), whole_(whole) {}

  double x(const char* name) { return length(name, whole_.x()).value_or(0.0); }
  double y(const char* name) { return length(name, whole_.y()).value_or(0.0); }
  // Sizes and radii: nothing where they are missing, "auto" or negative.
  std::optional<double> width(const char* name) { return size(name, whole_.x()); }
  std::optional<double> height(const char* name) { return size(name, whole_.y()); }
  /// May be given in percent of the whole's mean side.
  std::optional<double> radius(const char* name) { return size(name, whole_.norm() / std::sqrt(2.0)); }
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

  std::optional<double> size(const char* name, double whole) {
    const auto value = length(name, whole);
    if (!value || *value >= 0.0) return value;
    fault_ = fmt::format("{} of <{}> is negative", name, node_.name());
    return std::nullopt;
  }

  XmlNode node_;
  Vector2 whole_;
  std::string fault_;
};

SvgShape built_shape(SvgPathBuilder& builder, const ShapeLengths& lengths) {
  return {builder.take(), lengths.fault()};
}

SvgShape line_shape(ShapeLengths lengths) {
  SvgPathBuilder builder;
  builder.move_to({lengths.x("x1"), lengths.y("y1")});
  builder.line_to({lengths.x("x2"), lengths.y("y2")});
  return built_shape(builder, lengths);
}

SvgShape polygon_shape(std::string_view points, bool is_closed) {
  SvgPathBuilder builder;
  SvgScanner scanner(points);
  std::string fault;
  for (bool is_first = true; !scanner.at_end(); is_first = false) {
    const std::string_view begin = scanner.rest();
    const auto x = scanner.number(), y = scanner.number();
    if (!x || !y) {
      fault = fmt::format("{} in the points is no pair of numbers", quoted_value(begin));
      break;
    }
    if (is_first) builder.move_to({*x, *y});
    if (!is_first) builder.line_to({*x, *y});
  }
  if (is_closed) builder.close();
  return {builder.take(), std::move(fault)};
}

void add_ellipse(SvgPathBuilder& builder, const Vector2& centre, const Vector2& radii) {
  if (!(radii.minCoeff() > 0.0)) return;
  builder.move_to({centre.x() + radii.x(), centre.y()});
  builder.arc_to(radii, 0.0, false, true, {centre.x() - radii.x(), centre.y()});
  builder.arc_to(radii, 0.0, false, true, {centre.x() + radii.x(), centre.y()});
  builder.close();
}

SvgShape ellipse_shape(ShapeLengths lengths, bool is_circle) {
  SvgPathBuilder builder;
  const Vector2 centre(lengths.x("cx"), lengths.y("cy"));
  const auto rx = is_circle ? lengths.radius("r") : lengths.width("rx");
  const auto ry = is_circle ? rx : lengths.height("ry");
  const Vector2 radii(rx.value_or(ry.value_or(0.0)), ry.value_or(rx.value_or(0.0)));
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

SvgShape rectangle_shape(ShapeLengths lengths) {
  SvgPathBuilder builder;
  const Vector2 corner(lengths.x("x"), lengths.y("y"));
  const Vector2 size(lengths.width("width").value_or(0.0), lengths.height("height").value_or(0.0));
  const auto rx = lengths.width("rx"), ry = lengths.height("ry");
  const Vector2 radii(rx.value_or(ry.value_or(0.0)), ry.value_or(rx.value_or(0.0)));
  if (size.minCoeff() > 0.0) add_rectangle(builder, corner, size, radii.cwiseMin(0.5 * size));
  return built_shape(builder, lengths);
}

constexpr std::array<std::string_view, 7> kShapeNames = {"path", "line",   "polyline", "polygon",
                                                         "rect", "circle", "ellipse"};

}  // namespace

bool is_svg_shape(std::string_view name) { return std::ranges::count(kShapeNames, name) > 0; }

SvgShape svg_shape_of(const XmlNode& node, const Vector2& whole) {
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
