#include "drawing/shape/drawing_shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "drawing/shape/drawing_bytes.h"
#include "drawing/shape/every_kind.h"
#include "world/hasher.h"
#include "world/shape/flat_curves.h"
#include "world/shape/mesh_geometry.h"

namespace icome::drawing {
namespace {

constexpr double kMostSheet = 1.0;  // m
constexpr Colour kPaperColour = {1.0F, 1.0F, 1.0F};

std::string complaint(const DrawingBody& body) {
  if (!(body.sheet >= 0.0 && body.sheet <= kMostSheet))
    return fmt::format("the sheet of a drawing is 0 to {} m thick", kMostSheet);
  return complaint(body.heights);
}

/// A colour as it is seen on paper through which one sees so much of it. Colours are mixed as in pictures of
/// drawings.
Colour on_paper(const Colour& colour, double opacity) {
  Colour seen;
  for (std::size_t i = 0; i < seen.size(); ++i)
    seen[i] = float(opacity * double(colour[i]) + (1.0 - opacity) * double(kPaperColour[i]));
  return seen;
}

/// Puts parts in colours of their own into one mesh.
class PartsMesh {
 public:
  void add_box(const base::Bounds& box) {
    // Corners by bits: 1 is the greater x, 2 the greater y, 4 the greater z.
    static constexpr std::array<geometry::TriangleMesh::Triangle, 12> kFaces = {{{0, 4, 6},
                                                                                 {0, 6, 2},
                                                                                 {1, 3, 7},
                                                                                 {1, 7, 5},
                                                                                 {0, 1, 5},
                                                                                 {0, 5, 4},
                                                                                 {2, 6, 7},
                                                                                 {2, 7, 3},
                                                                                 {0, 2, 3},
                                                                                 {0, 3, 1},
                                                                                 {4, 5, 7},
                                                                                 {4, 7, 6}}};
    geometry::TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner)
      mesh.positions.push_back(box.corner(base::Bounds::CornerType(corner)));
    mesh.triangles.assign(kFaces.begin(), kFaces.end());
    add(mesh, 1.0, kPaperColour);
  }

  /// Adds the mesh with its z stretched.
  void add(const geometry::TriangleMesh& mesh, double stretch, const Colour& colour) {
    const std::size_t first = all_->mesh.positions.size();
    geometry::append(all_->mesh, mesh);
    for (std::size_t i = first; i < all_->mesh.positions.size(); ++i) all_->mesh.positions[i].z() *= stretch;
    all_->colours.insert(all_->colours.end(), mesh.triangles.size(), {colour, colour, colour});
  }

  std::size_t triangles() const { return all_->mesh.triangles.size(); }
  std::shared_ptr<const world::MeshGeometry> take() { return std::move(all_); }

 private:
  std::shared_ptr<world::MeshGeometry> all_ = std::make_shared<world::MeshGeometry>(geometry::TriangleMesh{});
};

base::Bounds sheet_box(const Vector2& paper, double thickness) {
  return {base::Vector3(-0.5 * paper.x(), -0.5 * paper.y(), -thickness),
          base::Vector3(0.5 * paper.x(), 0.5 * paper.y(), 0.0)};
}

}  // namespace

base::Result<std::shared_ptr<const DrawingShape>> DrawingShape::create(Drawing drawing,
                                                                       const DrawingBody& body) {
  if (const std::string why = complaint(body); !why.empty()) return base::fail(why);
  if (const auto sound = check_drawing(drawing); !sound) return tl::unexpected(sound.error());
  return std::shared_ptr<const DrawingShape>(new DrawingShape(std::move(drawing), body, {}));
}

base::Bounds DrawingShape::bounds() const {
  base::Bounds box;
  if (body_.sheet > 0.0) box.extend(sheet_box(drawing_.size, body_.sheet));
  for (const Layer& layer : drawing_.layers) {
    if (!layer.visible) continue;
    for (const StrokePointer& stroke : layer.strokes) {
      const double width = stroke->curve.widest();
      const double height = body_.heights.height + body_.heights.height_by_width * width;
      const Bounds2 line = stroke->curve.bounds();
      const Vector2 low = line.min().array() - 0.5 * width, high = line.max().array() + 0.5 * width;
      const Vector2 middle = 0.5 * drawing_.size;
      box.extend(base::Vector3(low.x() - middle.x(), middle.y() - high.y(), 0.0));
      box.extend(base::Vector3(high.x() - middle.x(), middle.y() - low.y(),
                               height * (1.0 + kRiseOfStroke * double(drawing_.stroke_count()))));
    }
  }
  return box;
}

std::uint64_t DrawingShape::hash() const {
  world::Hasher hasher;
  hasher.add(hash_of(drawing_));
  for (const double number : {body_.heights.height, body_.heights.height_by_width, body_.sheet})
    hasher.add(number);
  return hasher.value();
}

std::size_t DrawingShape::bytes() const {
  std::size_t bytes = sizeof(*this);
  for (const Layer& layer : drawing_.layers) {
    bytes += sizeof(layer) + layer.name.size();
    for (const StrokePointer& stroke : layer.strokes) {
      bytes += sizeof(Stroke) + stroke->curve.segments.size() * sizeof(CubicBezier) +
               stroke->curve.widths.size() * sizeof(WidthSegment);
    }
  }
  return bytes;
}

base::Result<std::shared_ptr<const world::MeshGeometry>> DrawingShape::triangles(double /*tolerance*/) const {
  const std::scoped_lock hold(lock_);
  if (triangles_) return triangles_;
  auto made = made_triangles();
  if (made) triangles_ = *made;
  return made;
}

base::Result<std::shared_ptr<const world::MeshGeometry>> DrawingShape::made_triangles() const {
  const auto ridges = ridges_of(drawing_, body_.heights, ridges_);
  if (!ridges) return tl::unexpected(ridges.error());
  PartsMesh parts;
  if (body_.sheet > 0.0) parts.add_box(sheet_box(drawing_.size, body_.sheet));
  for (const Ridge& ridge : *ridges) {
    const double opacity = body_.sheet > 0.0 ? ridge.stroke->opacity : 1.0;
    if (ridge.stroke->fill)
      parts.add(ridge.areas->fill, ridge.fill_height, on_paper(*ridge.stroke->fill, opacity));
    parts.add(ridge.areas->line, ridge.height, on_paper(ridge.stroke->colour, opacity));
    if (parts.triangles() > kMostTriangles)
      return base::fail(fmt::format("a drawing of more than {} triangles", kMostTriangles));
  }
  return parts.take();
}

base::Result<world::FlatCurves> DrawingShape::flat_curves(double tolerance) const {
  auto areas = enclosed_areas(drawing_, tolerance);
  if (!areas) return tl::unexpected(areas.error());
  return world::FlatCurves{std::move(*areas), open_lines(drawing_, tolerance)};
}

base::Result<std::string> DrawingShape::write() const { return drawing_bytes(drawing_, body_); }

base::Result<world::Amended> DrawingShape::amended(std::string_view change) const {
  const auto edit = edit_from_bytes(change);
  if (!edit) return tl::unexpected(edit.error());
  Drawing drawing = drawing_;
  const auto back = apply_edit(drawing, *edit);
  if (!back) return tl::unexpected(back.error());
  StrokeRidges known = known_ridges(drawing.size);
  const auto shape =
      std::shared_ptr<const DrawingShape>(new DrawingShape(std::move(drawing), body_, std::move(known)));
  return world::Amended{shape, edit_bytes(*back)};
}

StrokeRidges DrawingShape::known_ridges(const Vector2& paper) const {
  const std::scoped_lock hold(lock_);
  return paper == drawing_.size ? ridges_ : StrokeRidges{};
}

const DrawingShape* drawing_in(const world::Geometry& shape) {
  return dynamic_cast<const DrawingShape*>(&shape);
}

base::Result<world::GeometryPointer> read_drawing_shape(std::string_view bytes) {
  auto read = drawing_from_bytes(bytes);
  if (!read) return tl::unexpected(read.error());
  auto shape = DrawingShape::create(std::move(read->drawing), read->body);
  if (!shape) return tl::unexpected(shape.error());
  return world::GeometryPointer(std::move(*shape));
}

world::GeometryFactory every_kind_of_shape() {
  world::GeometryFactory factory;
  // Cannot fail: the world has no kind of this name.
  (void)factory.add(std::string(DrawingShape::kKind), read_drawing_shape);
  return factory;
}

}  // namespace icome::drawing
