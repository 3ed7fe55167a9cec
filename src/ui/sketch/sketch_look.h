#pragma once
#include "drawing/drawing.h"
#include "sketch/fit/stroke_fit.h"
#include "sketch/pen/pressure_curve.h"

namespace icome::ui {

// What panels take, m.
inline constexpr double kWidestTip = 0.1;
inline constexpr double kLeastEraser = 0.0001;

/// A person's choices in the window: the look of the pen's lines, and what is shown beside the drawing.
struct SketchLook {
  drawing::Colour colour = {0.11F, 0.13F, 0.16F};
  drawing::Colour fill = {0.98F, 0.80F, 0.36F};  // of the fill tool
  double opacity = 1.0;
  sketch::PenTip tip = {.thinnest = 0.0003, .widest = 0.0015};
  sketch::PressureCurve pressure;
  drawing::CurveEnds ends = drawing::CurveEnds::Round;
  double eraser_radius = 0.003;  // m
  bool whole_strokes = false;    // the eraser takes all of what it touches
  bool constant_width = false;   // for a mouse; else by its speed
  bool predict = true;           // the running stroke a frame ahead, on the display only
  bool onion = false;            // what was before the last change, faintly
  bool attract = false;          // what is dragged, to a grid and to angles
  bool force = false;            // an arrow for the force that resists the tool
};

}  // namespace icome::ui
