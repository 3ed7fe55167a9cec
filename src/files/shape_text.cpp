#include "files/shape_text.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "drawing/shape/drawing_shape.h"
#include "drawing/shape/drawing_text.h"
#include "files/csg/csg_text.h"
#include "geometry/primitive/primitive.h"
#include "io/number_text.h"
#include "io/text_scanner.h"
#include "world/shape/geometry_check.h"
#include "world/shape/visit_geometry.h"

namespace icome::files {
namespace {

using base::Vector3;
using world::GeometryPointer;

template <typename Number>
void append_word(std::string& text, Number number) {
  if (!text.empty()) text += ' ';
  io::append_number(text, number);
}

std::string text_of(const std::vector<Vector3>& points) {
  std::string text;
  for (const Vector3& point : points) {
    for (const double coordinate : point) append_word(text, coordinate);
  }
  return text;
}

template <std::size_t Size>
std::string text_of(const std::vector<std::array<std::uint32_t, Size>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (const std::uint32_t index : row) append_word(text, index);
  }
  return text;
}

std::string text_of(const std::vector<std::uint32_t>& indices) {
  std::string text;
  for (const std::uint32_t index : indices) append_word(text, index);
  return text;
}

/// The numbers of a text; fails unless they fill rows.
base::Result<std::vector<double>> numbers_of(const ShapeText& text, const char* key, std::size_t row) {
  std::vector<double> numbers;
  const auto found = text.find(key);
  if (found == text.end()) return numbers;
  io::TextScanner scanner(found->second, key, io::TextScanner::Lines::AreSpace, '\0');
  while (!scanner.at_end()) numbers.push_back(scanner.number("a number"));
  if (scanner.failed()) return tl::unexpected(scanner.error());
  if (numbers.size() % row != 0) return base::fail(fmt::format("{}: ends within a row of {}", key, row));
  return numbers;
}

template <std::size_t Size>
base::Result<std::vector<std::array<std::uint32_t, Size>>> rows_of(const ShapeText& text, const char* key) {
  const auto numbers = numbers_of(text, key, Size);
  if (!numbers) return tl::unexpected(numbers.error());
  std::vector<std::array<std::uint32_t, Size>> rows(numbers->size() / Size);
  for (std::size_t i = 0; i < numbers->size(); ++i) {
    const double number = (*numbers)[i];
    if (!(number >= 0.0 && number <= double(std::numeric_limits<std::uint32_t>::max())))
      return base::fail(fmt::format("{}: {} is not an index", key, number));
    rows[i / Size][i % Size] = std::uint32_t(number);
  }
  return rows;
}

base::Result<std::vector<Vector3>> points_of(const ShapeText& text, const char* key) {
  const auto numbers = numbers_of(text, key, 3);
  if (!numbers) return tl::unexpected(numbers.error());
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < numbers->size(); i += 3)
    points.emplace_back((*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2]);
  return points;
}

std::string word_of(const ShapeText& text, const char* key) {
  const auto found = text.find(key);
  return found == text.end() ? "" : found->second;
}

base::Result<GeometryPointer> primitive_of(const ShapeText& text) {
  const auto primitive = geometry::parse_primitive(word_of(text, "shape"));
  if (!primitive) return tl::unexpected(primitive.error());
  const world::Axis axis = word_of(text, "axis") == "y" ? world::Axis::Y : world::Axis::Z;
  return std::make_shared<const world::PrimitiveGeometry>(*primitive, axis);
}

base::Result<GeometryPointer> csg_of(const ShapeText& text) {
  auto tree = csg_from_text(word_of(text, "tree"));
  if (!tree) return tl::unexpected(tree.error());
  return std::make_shared<const world::CsgGeometry>(std::move(*tree));
}

base::Result<GeometryPointer> drawing_of(const ShapeText& text) {
  const auto body = numbers_of(text, "body", 3);
  if (!body) return tl::unexpected(body.error());
  return drawing::shape_of_svg(word_of(text, "svg"), *body);
}

base::Result<GeometryPointer> implicit_of(const ShapeText& text) {
  const auto corners = points_of(text, "box");
  if (!corners) return tl::unexpected(corners.error());
  if (corners->size() != 2) return base::fail("box: needs two corners");
  auto shape =
      world::ImplicitGeometry::create(word_of(text, "formula"), base::Bounds((*corners)[0], (*corners)[1]));
  if (!shape) return tl::unexpected(shape.error());
  return GeometryPointer(std::move(*shape));
}

base::Result<GeometryPointer> loop_of(const ShapeText& text) {
  auto points = points_of(text, "points");
  if (!points) return tl::unexpected(points.error());
  auto triangles = rows_of<3>(text, "triangles");
  if (!triangles) return tl::unexpected(triangles.error());
  auto creases = rows_of<2>(text, "creases");
  if (!creases) return tl::unexpected(creases.error());
  const auto corners = rows_of<1>(text, "corners");
  if (!corners) return tl::unexpected(corners.error());
  geometry::ControlMesh control;
  control.mesh.positions = std::move(*points);
  control.mesh.triangles = std::move(*triangles);
  control.creases = std::move(*creases);
  for (const auto& [corner] : *corners) control.corners.push_back(corner);
  auto shape = std::make_shared<world::LoopGeometry>(std::move(control));
  if (const std::string wrong = world::complaint(*shape); !wrong.empty()) return base::fail(wrong);
  return GeometryPointer(std::move(shape));
}

}  // namespace

base::Result<std::optional<ShapeText>> shape_text(const world::Geometry& shape) {
  using Text = base::Result<std::optional<ShapeText>>;
  const std::string kind(shape.kind());
  return world::visit_geometry(
      shape, [](const world::MeshGeometry&) -> Text { return std::optional<ShapeText>(); },
      [&](const world::PrimitiveGeometry& it) -> Text {
        return ShapeText{{"kind", kind},
                         {"shape", geometry::name(it.primitive)},
                         {"axis", it.axis == world::Axis::Y ? "y" : "z"}};
      },
      [&](const world::CsgGeometry& it) -> Text {
        auto tree = csg_text(it.tree);
        if (!tree) return tl::unexpected(tree.error());
        return ShapeText{{"kind", kind}, {"tree", std::move(*tree)}};
      },
      [&](const world::ImplicitGeometry& it) -> Text {
        const base::Bounds& box = it.surface()->box();
        return ShapeText{{"kind", kind}, {"formula", it.formula()}, {"box", text_of({box.min(), box.max()})}};
      },
      [&](const world::LoopGeometry& it) -> Text {
        return ShapeText{{"kind", kind},
                         {"points", text_of(it.control.mesh.positions)},
                         {"triangles", text_of(it.control.mesh.triangles)},
                         {"creases", text_of(it.control.creases)},
                         {"corners", text_of(it.control.corners)}};
      },
      [&](const world::Geometry& it) -> Text {
        if (const auto* const drawn = drawing::drawing_in(it)) {
          return ShapeText{
              {"kind", kind}, {"svg", drawing::svg_of(*drawn)}, {"body", drawing::text_of(drawn->body())}};
        }
        return base::fail(fmt::format("Shapes of the kind \"{}\" have no text.", kind));
      });
}

base::Result<GeometryPointer> shape_from_text(const ShapeText& text) {
  const std::string kind = word_of(text, "kind");
  if (kind == "primitive") return primitive_of(text);
  if (kind == "csg") return csg_of(text);
  if (kind == "implicit") return implicit_of(text);
  if (kind == "loop") return loop_of(text);
  if (kind == "drawing") return drawing_of(text);
  return base::fail(fmt::format("{} is not a kind of shape", io::quoted(kind)));
}

}  // namespace icome::files
