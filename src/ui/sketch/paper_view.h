#pragma once
#include <QPointF>
#include <QRectF>
#include <QSize>
#include <QTransform>

#include "base/vector.h"

namespace icome::ui {

/// The part of a drawing that is seen, its size and its turn. Screen lengths are device-independent
/// pixels; those of the paper m, or mm where a QTransform has them, which paths are kept in. A plain value.
class PaperView {
 public:
  /// From mm on the paper to pixels.
  QTransform screen_from_mm() const;
  QPointF to_screen(const base::Vector2& place) const;
  base::Vector2 to_paper(QPointF at) const;
  double pixels_per_mm() const { return scale_; }
  double turned() const { return turn_; }  // degrees, clockwise, within (-180, 180]
  /// A length on the screen as one on the paper, m.
  double on_paper(double pixels) const { return 0.001 * pixels / scale_; }

  /// Shows paper of this size (m) whole, upright, in the middle of a canvas.
  void fit(const base::Vector2& paper, QSize canvas);
  /// The place under the pointer stays there.
  void zoom(QPointF about, double factor);
  void turn(QPointF about, double degrees);
  void shift(QPointF by) { middle_ += by; }

  bool operator==(const PaperView&) const = default;

 private:
  QPointF middle_ = {};  // where the paper's corner is seen
  double scale_ = 4.0;   // pixels for a mm
  double turn_ = 0.0;
};

}  // namespace icome::ui
