#pragma once
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <optional>
#include <unordered_map>
#include <vector>

#include "drawing/drawing.h"
#include "ui/sketch/paper_view.h"

namespace icome::ui {

/// The outline of a curve's line in mm; empty for one without width. `tolerance` in m.
QPainterPath line_path(const drawing::Curve& curve, drawing::CurveEnds ends, double tolerance);

/// A picture of a drawing that is kept: a stroke is outlined once for a range of zooms, and what changes is
/// drawn anew only where it changed. Strokes that come on top of all are laid over the picture; where the
/// same strokes change again and again, as in a drag, what lies below and above them is kept as pictures
/// around the place; and paper that is shifted by whole pixels takes its picture along. It looks at nothing
/// but the drawing and the view; the paper is drawn, too.
class StrokePicture {
 public:
  /// Makes the picture show the drawing, in this size (device-independent pixels). Returns where it has
  /// changed; an empty rectangle where it has not.
  QRect show(const drawing::Drawing& drawing, const PaperView& view, QSize size, double pixel_ratio);

  /// Is it the same view but shifted by whole pixels, so that the picture can mostly be kept?
  bool can_shift_to(const PaperView& view) const { return whole_shift(view).has_value(); }

  /// The picture as it was last made, with its pixel ratio.
  const QImage& image() const { return image_; }
  const PaperView& view() const { return view_; }

  /// Draws a stroke onto something else in the same view, such as one that was there before.
  void paint(QPainter& painter, const drawing::StrokePointer& stroke);

 private:
  struct Painted {
    drawing::StrokePointer stroke;  // keeps the address, by which it is found, from being used again
    QPainterPath line;
    QPainterPath inside;     // only with a fill
    double tolerance = 0.0;  // m, of the line; 0: it was not outlined yet
    QRectF box;              // mm
    bool is_used = false;
  };
  /// The strokes in which two lists differ: all but so many in front and behind.
  struct Difference {
    std::size_t front = 0, back = 0;
    QRectF box;  // mm; empty where there is none
  };
  /// Strokes that lie on each other without others between, and their picture, which is clear elsewhere.
  struct Sheet {
    std::size_t count = 0;
    QImage picture;
  };

  Painted& painted(const drawing::StrokePointer& stroke);
  void outline(Painted& stroke) const;
  void paint(QPainter& painter, Painted& stroke);
  void paint_range(QPainter& painter, std::size_t from, std::size_t to, const QRect& part);
  Difference difference_to(const std::vector<drawing::StrokePointer>& now);
  void take(std::vector<drawing::StrokePointer> now, std::size_t same_in_front, std::size_t same_behind);
  std::optional<QPoint> whole_shift(const PaperView& view) const;
  QRect whole() const;
  void shift_to(const PaperView& view, QPoint by);
  QRect change(std::vector<drawing::StrokePointer> now);
  void lay_on_top(std::size_t first);
  void share_out();
  void change_counts(const Difference& change, std::size_t before, std::size_t& from, std::size_t& to);
  void draw_sheets(const QRect& part, std::size_t from, std::size_t to);
  void draw_sheet(Sheet& sheet, std::size_t first, const QRect& part);
  void put_together(const QRect& part);
  void draw_all();
  void draw_paper(QPainter& painter) const;
  void forget_unused();

  QImage image_;
  PaperView view_;
  drawing::Vector2 paper_ = drawing::Vector2::Zero();
  QColor desk_;
  std::vector<drawing::StrokePointer> strokes_;  // that are seen, the lowest first
  std::vector<Painted*> shown_;                  // the same
  std::unordered_map<const drawing::Stroke*, Painted> painted_;
  std::vector<Sheet> sheets_;  // the lowest first; all strokes are in one
  double tolerance_ = 0.0;     // m, of the outlines
};

}  // namespace icome::ui
