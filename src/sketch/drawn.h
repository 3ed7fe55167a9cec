#pragma once
#include "drawing/curve.h"
#include "drawing/drawing.h"
#include "drawing/drawing_edit.h"

namespace icome::sketch {

// Drawings are what everything here works on, so that their names are used as if they were this folder's own.
using drawing::Bounds2;
using drawing::ChangeLayer;
using drawing::Colour;
using drawing::CubicBezier;
using drawing::Curve;
using drawing::CurveEnds;
using drawing::Drawing;
using drawing::DrawingChange;
using drawing::DrawingEdit;
using drawing::DrawingHistory;
using drawing::Layer;
using drawing::LayerId;
using drawing::LayerLook;
using drawing::MoveLayer;
using drawing::PutLayer;
using drawing::PutStroke;
using drawing::ReplaceStroke;
using drawing::ResizePaper;
using drawing::Stroke;
using drawing::StrokeId;
using drawing::StrokePointer;
using drawing::TakeLayer;
using drawing::TakeStroke;
using drawing::Vector2;
using drawing::WidthSegment;

}  // namespace icome::sketch
