#pragma once
#include <memory>
#include <mutex>
#include <string>

#include "base/result.h"
#include "drawing/drawing_edit.h"
#include "drawing/shape/ridges.h"
#include "world/shape/geometry.h"

namespace icome::drawing {

/// The body that a drawing gets in a world.
struct DrawingBody {
  RidgeHeights heights;
  double sheet = 0.001;  ///< m, thickness of the white sheet below the lines, up to 1; 0: none

  bool operator==(const DrawingBody&) const = default;
};

/// A drawing as a kind of shape: a sheet of paper in the plane z = 0, its middle at the origin and y up, on
/// which lines rise to +z as ridges, in their colours. Through one that is not opaque the sheet is seen, but
/// no other line; without a sheet all are opaque. It is changed by edits of its drawing, as bytes
/// (edit_bytes), so that a stroke more is all that is kept and sent.
class DrawingShape final : public world::Geometry {
 public:
  static constexpr std::string_view kKind = "drawing";

  /// Fails for drawings that apply_edit() would not make, and for a body out of range.
  static base::Result<std::shared_ptr<const DrawingShape>> create(Drawing drawing, const DrawingBody& body);

  const Drawing& drawing() const { return drawing_; }
  const DrawingBody& body() const { return body_; }

  std::string_view kind() const override { return kKind; }
  base::Bounds bounds() const override;
  std::uint64_t hash() const override;
  std::size_t bytes() const override;
  /// Off by no more than 0.02 mm, whatever the tolerance; made once, and of a changed drawing only what
  /// changed.
  base::Result<std::shared_ptr<const world::MeshGeometry>> triangles(double tolerance) const override;
  base::Result<world::FlatCurves> flat_curves(double tolerance) const override;
  base::Result<std::string> write() const override;
  base::Result<world::Amended> amended(std::string_view change) const override;

 private:
  DrawingShape(Drawing drawing, const DrawingBody& body, StrokeRidges ridges)
      : drawing_(std::move(drawing)), body_(body), ridges_(std::move(ridges)) {}

  base::Result<std::shared_ptr<const world::MeshGeometry>> made_triangles() const;
  StrokeRidges known_ridges(const Vector2& paper) const;

  Drawing drawing_;
  DrawingBody body_;
  mutable std::mutex lock_;                                       // of all below
  mutable StrokeRidges ridges_;                                   // also of strokes that are there no more
  mutable std::shared_ptr<const world::MeshGeometry> triangles_;  // null until asked for
};

/// The drawing of a shape; null for shapes of other kinds.
const DrawingShape* drawing_in(const world::Geometry& shape);

/// A shape from the bytes of its write(), which may come from a stranger.
base::Result<world::GeometryPointer> read_drawing_shape(std::string_view bytes);

/// An edit of a drawing as bytes, and back. Fails where they are damaged; what the edit asks for is checked
/// when it is applied.
std::string edit_bytes(const DrawingEdit& edit);
base::Result<DrawingEdit> edit_from_bytes(std::string_view bytes);

}  // namespace icome::drawing
