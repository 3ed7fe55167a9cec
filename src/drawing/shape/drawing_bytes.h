#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "drawing/shape/drawing_shape.h"

namespace icome::drawing {

/// A drawing and its body as bytes (drawing.fbs).
base::Result<std::string> drawing_bytes(const Drawing& drawing, const DrawingBody& body);

struct ReadDrawing {
  Drawing drawing;
  DrawingBody body;
};
/// Fails where the bytes are damaged; whether the drawing is sound is not looked at.
base::Result<ReadDrawing> drawing_from_bytes(std::string_view bytes);

}  // namespace icome::drawing
