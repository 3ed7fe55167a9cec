#pragma once
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <unordered_map>
#include <vector>

#include "drawing/drawing.h"
#include "ui/sketch/paper_view.h"

namespace icome::ui {

/// The outline of a curve's line in mm; empty for one without width. `tolerance` in m.
QPainterPath line_path(const drawing::Curve& curve, drawing::CurveEnds ends, double tolerance);

/// A picture of a drawing that is kept: a stroke is drawn once, and what changes is drawn anew only where it
/// changed. It looks at nothing but the drawing and the view; the paper is drawn, too.
class StrokePicture {
 public:
  /// Makes the picture show the drawing, in this size (device-independent pixels). Returns where it has
  /// changed; an empty rectangle where it has not.
  QRect show(const drawing::Drawing& drawing, const PaperView& view, QSize size, double pixel_ratio);

  /// The picture as it was last made, with its pixel ratio.
  const QImage& image() const { return image_; }
  const PaperView& view() const { return view_; }

  /// Draws a stroke onto something else in the same view, such as one that was there before.
  void paint(QPainter& painter, const drawing::StrokePointer& stroke);

 private:
  struct Painted {
    drawing::StrokePointer stroke;  // keeps the address, by which it is found, from being used again
    QPainterPath line;
    QPainterPath inside;  // only with a fill
    QRectF box;           // mm
  };

  const Painted& painted(const drawing::StrokePointer& stroke);
  void paint(QPainter& painter, const Painted& stroke);
  QRectF changed_box(const std::vector<drawing::StrokePointer>& now);
  void draw(const QRect& part);
  void draw_paper(QPainter& painter) const;
  void forget_unused();

  QImage image_;
  PaperView view_;
  drawing::Vector2 paper_ = drawing::Vector2::Zero();
  QColor desk_;
  std::vector<drawing::StrokePointer> strokes_;  // that are seen, the lowest first
  std::unordered_map<const drawing::Stroke*, Painted> painted_;
  double tolerance_ = 0.0;  // m, of the outlines
};

}  // namespace icome::ui
