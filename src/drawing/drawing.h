#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drawing/curve.h"
#include "world/id.h"
#include "world/shape/fixture.h"

namespace icome::drawing {

using world::Colour;

struct Stroke;
struct Layer;
using StrokeId = world::Id<Stroke>;
using LayerId = world::Id<Layer>;

/// The shape of a line where it begins and ends.
enum class CurveEnds : std::uint8_t { Round, Flat };

/// One line of a drawing. Immutable once it is in a drawing: drawings, undo and copies share it.
struct Stroke {
  StrokeId id;
  Curve curve;
  Colour colour = {0.0F, 0.0F, 0.0F};
  double opacity = 1.0;               ///< of line and fill, 0 to 1
  std::optional<Colour> fill;         ///< what the curve encloses, by the non-zero rule
  CurveEnds ends = CurveEnds::Round;  ///< where it is not closed

  bool operator==(const Stroke&) const = default;
};
using StrokePointer = std::shared_ptr<const Stroke>;

/// Strokes that are shown, hidden and locked together; later ones lie on earlier ones.
struct Layer {
  LayerId id;
  std::string name;
  bool visible = true;
  bool locked = false;  ///< tools leave its strokes alone
  std::vector<StrokePointer> strokes;
};

/// Lines on paper: x to the right, y down, lengths in m, as files and tablets have it (in mm). A plain value
/// that copies cheaply, since strokes are shared. Ids are unique within it.
struct Drawing {
  Vector2 size = Vector2(0.297, 0.210);  ///< of the paper, m; its upper left corner is the origin
  std::vector<Layer> layers;             ///< the lowest first
  std::uint64_t next_id = 1;             ///< greater than every id that was ever given here

  StrokeId next_stroke_id() { return StrokeId{next_id++}; }
  LayerId next_layer_id() { return LayerId{next_id++}; }

  std::size_t stroke_count() const;
  /// The stroke of that id; null where there is none.
  const Stroke* find(StrokeId id) const;
  /// The box of all strokes with their widths.
  Bounds2 bounds() const;
};

/// Equal drawings have equal numbers, others almost surely different ones.
std::uint64_t hash_of(const Drawing& drawing);

}  // namespace icome::drawing
