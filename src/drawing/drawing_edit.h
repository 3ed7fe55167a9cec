#pragma once
#include <string>
#include <variant>
#include <vector>

#include "base/edit_history.h"
#include "base/result.h"
#include "drawing/drawing.h"

namespace icome::drawing {

/// Puts a new stroke into a layer, before the one that is at `place`.
struct PutStroke {
  LayerId layer;
  std::size_t place = 0;
  StrokePointer stroke;
};
struct TakeStroke {
  StrokeId id;
};
/// Another stroke for the one of the same id.
struct ReplaceStroke {
  StrokePointer stroke;
};

/// Name and state of a layer, without its strokes.
struct LayerLook {
  std::string name;
  bool visible = true;
  bool locked = false;
};
/// Puts a layer without strokes among the others.
struct PutLayer {
  LayerId id;
  std::size_t place = 0;
  LayerLook look;
};
/// Takes a layer away that has no strokes.
struct TakeLayer {
  LayerId id;
};
struct ChangeLayer {
  LayerId id;
  LayerLook look;
};
struct MoveLayer {
  LayerId id;
  std::size_t place = 0;  ///< among the layers-to-be
};
struct ResizePaper {
  Vector2 size = Vector2::Zero();  ///< m
};

/// A part of an edit. A plain value.
using DrawingChange = std::variant<PutStroke, TakeStroke, ReplaceStroke, PutLayer, TakeLayer, ChangeLayer,
                                   MoveLayer, ResizePaper>;

/// A change of a drawing, the only way in which one changes: a plain value that can be applied and taken
/// back. Its parts are applied in order, all or none.
using DrawingEdit = std::vector<DrawingChange>;

/// The largest coordinate and width in a drawing, m. Files are read as far, too.
inline constexpr double kLargestDrawing = 1e4;

/// The edit that does one thing.
DrawingEdit edit_of(DrawingChange change);

/// Fails, saying why, for a drawing that edits could not have made: of what apply_edit() refuses, or numbers
/// beyond next_id.
base::Result<void> check_drawing(const Drawing& drawing);

/// Changes the drawing and gives the edit that takes it back. A refused edit changes nothing, and the error
/// says why: an id that is not there or is there twice, a place beyond the end, a layer that has strokes, a
/// stroke without a segment, whose segments or widths do not join, or with numbers that are not finite or
/// longer than kLargestDrawing.
base::Result<DrawingEdit> apply_edit(Drawing& drawing, const DrawingEdit& edit);

/// A drawing with the edits that were done to it.
using DrawingHistory = base::EditHistory<Drawing, DrawingEdit>;

}  // namespace icome::drawing
